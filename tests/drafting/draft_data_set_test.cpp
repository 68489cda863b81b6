// What a draft of a data set takes for granted, it says; its name is its folder's.
#include "drafting/draft_data_set.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "../config/temporary_folder.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kHeadings[] = "q1_deg,q2_deg,x_mm,y_mm,z_mm,target\n";

DataSetDraft draft_of(const TemporaryFolder& folder, const std::filesystem::path& into, const std::string& rows) {
  const auto table = folder.write("points.csv", kHeadings + rows);
  return draft_data_sets(read_given_tables({table}, 2, {}), into, "robot.yaml", 2, {}).front();
}

TEST(Drafts, SayThatTargetsAreTakenForOne) {
  const TemporaryFolder folder;
  const auto two = draft_of(folder, folder.path(), "1,2,3,4,5,left\n2,3,4,5,6,right\n");
  EXPECT_THAT(two.assumed, Contains(HasSubstr("all points are taken to be of one target: if target of ")));
  EXPECT_THAT(two.text, Not(HasSubstr("target:")));
  const auto one = draft_of(folder, folder.path(), "1,2,3,4,5,left\n2,3,4,5,6,left\n");
  EXPECT_THAT(one.assumed, Not(Contains(HasSubstr("of one target"))));
}

TEST(Drafts, AreCalledAsTheirFolder) {
  const TemporaryFolder folder;
  const std::string rows = "1,2,3,4,5,a\n2,3,4,5,6,a\n";
  const auto cell = folder.path() / "cell";
  std::filesystem::create_directory(cell);
  for (const auto& into : {cell, cell / "", cell / ".", cell / "jobs" / ".."})
    EXPECT_THAT(draft_of(folder, into, rows).text, HasSubstr("\nname: cell\n")) << into;
}

}  // namespace
}  // namespace demecal
