// How sentences name poses: by their own names and lines, or by their lines alone.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "data/data_set.hpp"

namespace demecal {
namespace {

TEST(NamesWithLines, AreThoseOfTheFileOrLinesAlone) {
  DataSet data;
  for (const auto& [name, line] : {std::pair<std::string, std::size_t>("P7", 12), {line_name(14), 14}, {"P7", 16}}) {
    MeasuredPose pose;
    pose.pose_id = name;
    pose.line = line;
    data.poses.push_back(pose);
  }
  EXPECT_EQ(names_with_lines(data, {0, 1, 2}), "P7 (line 12), line 14, P7 (line 16)");
  EXPECT_EQ(names_with_lines(data, {}), "");
}

}  // namespace
}  // namespace demecal
