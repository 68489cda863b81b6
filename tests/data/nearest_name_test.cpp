// The nearest name to a mistyped one.
#include "data/text.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace demecal {
namespace {

TEST(NearestName, CountsTheFewestEdits) {
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("abdc", "abcd"), 1u);
}

TEST(NearestName, MeasuresLikeADistance) {
  std::mt19937_64 bits(3);
  const auto word = [&] {
    std::string letters;
    for (std::uint64_t i = bits() % 6; i > 0; --i) letters += static_cast<char>('a' + bits() % 3);
    return letters;
  };
  for (int i = 0; i < 500; ++i) {
    const std::string a = word(), b = word();
    EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
    EXPECT_EQ(edit_distance(a, b) == 0, a == b);
    EXPECT_LE(edit_distance(a, b), std::max(a.size(), b.size()));
  }
}

TEST(NearestName, IgnoresCaseAndTakesTheFirstOfEquals) {
  const std::vector<std::string> names{"q1_deg", "q2_deg", "x_mm"};
  EXPECT_EQ(nearest_name("X_MM", names), "x_mm");
  EXPECT_EQ(nearest_name("q7_deg", names), "q1_deg");
  EXPECT_EQ(nearest_name("q7_deg", {}), "");
}

}  // namespace
}  // namespace demecal
