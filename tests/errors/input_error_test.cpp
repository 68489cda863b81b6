// The sentence an input error says.
#include "errors/input_error.hpp"

#include <gtest/gtest.h>

namespace demecal {
namespace {

TEST(InputError, NamesFileLineValueAndRule) {
  const InputError error({"poses.csv", 7}, "abc", "is not a number");
  EXPECT_STREQ(error.what(), "poses.csv:7: 'abc': is not a number");
}

TEST(InputError, LeavesOutWhatIsUnknown) {
  EXPECT_STREQ(InputError({"job.yaml", 0}, "", "is empty").what(), "job.yaml: is empty");
  EXPECT_STREQ(InputError({"", 3}, "x", "is wrong").what(), "line 3: 'x': is wrong");
  EXPECT_STREQ(InputError({}, "", "nothing was given").what(), "nothing was given");
}

}  // namespace
}  // namespace demecal
