// Limits in radians and lengths in metres in a robot file are told by line and value; arms as they are drawn are not.
#include "data_files/doubtful_units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "../config/temporary_folder.hpp"
#include "data_files/robot_file.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> doubts_of(const std::string& limits, const std::string& length, const std::string& tool) {
  const TemporaryFolder folder;
  const std::filesystem::path file =
      folder.write("arm.yaml",
                   "demecal_robot: 1\nname: Two\nconvention: standard_dh\njoints:\n"
                   "  - {type: revolute, alpha_deg: -90, a_mm: " +
                       length +
                       ", d_mm: 0, limits_deg: [-170, 170]}\n"
                       "  - {type: revolute, alpha_deg: 0, a_mm: 300, d_mm: 3, limits_deg: " +
                       limits + "}\ntool_mm: " + tool + "\n");
  load_robot(file);  // none of it is refused
  return doubtful_units(file);
}

TEST(DoubtfulUnits, NamesWhatLooksLikeRadiansOrMetres) {
  EXPECT_THAT(doubts_of("[-2.79, 2.79]", "400", "[0, 0, 50]"),
              ElementsAre(HasSubstr("arm.yaml:6: '[-2.79, 2.79]': joints[2].limits_deg looks like radians")));
  EXPECT_THAT(doubts_of("[-170, 170]", "0.65", "[0.15025, 0.00163, 0.05569]"),
              ElementsAre(HasSubstr("arm.yaml:5: '0.65': joints[1].a_mm looks like metres"),
                          HasSubstr("arm.yaml:7: '[0.15025, 0.00163, 0.05569]': tool_mm looks like metres")));
}

TEST(DoubtfulUnits, LeavesSmallArmsAlone) {
  EXPECT_THAT(doubts_of("[-30, 4]", "4", "[1.63, 0, 3]"), IsEmpty());
  EXPECT_THAT(doubts_of("[-10, 170]", "0", "[0, 0, 0]"), IsEmpty());
}

TEST(DoubtfulUnits, AreInNoArmOfTheLibrary) {
  for (const auto& entry : std::filesystem::directory_iterator(DEMECAL_SOURCE_DIR "/configs/robots")) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_THAT(doubtful_units(entry.path()), IsEmpty()) << entry.path();
  }
}

}  // namespace
}  // namespace demecal
