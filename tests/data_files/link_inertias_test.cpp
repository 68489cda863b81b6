// links[].inertia_kgm2 of ROBOT.yaml: read, written, refused where no body has it; and the robot is the same without
// it.
#include "data_files/link_inertias.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../config/temporary_folder.hpp"
#include "data_files/robot_file.hpp"
#include "errors/input_error.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Two joints, whose second link states `more`.
std::string two_links(const std::string& more, const std::string& mass = "1.5") {
  return "demecal_robot: 1\nname: Two\nconvention: standard_dh\njoints:\n"
         "  - {type: revolute, alpha_deg: -90, a_mm: 400, d_mm: 0, limits_deg: [-170, 170]}\n"
         "  - {type: revolute, alpha_deg: 0, a_mm: 300, d_mm: 10, limits_deg: [-170, 170]}\n"
         "tool_mm: [0, 0, 50]\nlinks:\n  - {mass_kg: 3, com_mm: [-200, 0, 0]}\n  - {mass_kg: " +
         mass + ", com_mm: [-150, 0, 0]" + more + "}\n";
}

std::string refusal_of(const std::string& more, const std::string& mass = "1.5") {
  try {
    read_robot(parse_yaml(two_links(more, mass), "robot.yaml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LinkInertias, AreReadAndWrittenAsTheyStandAndChangeNothingOfTheRobot) {
  TemporaryFolder folder;
  folder.write("robot.yaml", two_links(", inertia_kgm2: [0.02, 0.001, -0.002, 0.03, 0.005, 0.025]"));
  const std::filesystem::path path = folder.path() / "robot.yaml";
  const LinkInertias inertias = load_link_inertias(path);
  ASSERT_EQ(inertias.size(), 2u);
  EXPECT_FALSE(inertias[0]);
  EXPECT_EQ((*inertias[1])(0, 2), -0.002);
  EXPECT_EQ((*inertias[1])(2, 1), 0.005);
  const Robot robot = load_robot(path);
  const std::string text = robot_text(robot, inertias);
  EXPECT_THAT(text, HasSubstr("inertia_kgm2: [0.02, 0.001, -0.002, 0.03, 0.005, 0.025]}"));
  folder.write("again.yaml", "demecal_robot: 1\n" + text);
  const LinkInertias again = load_link_inertias(folder.path() / "again.yaml");
  ASSERT_EQ(again.size(), 2u);
  EXPECT_EQ(*again[1], *inertias[1]);
  EXPECT_EQ(robot_text(robot), robot_text(read_robot(parse_yaml(two_links(""), "plain.yaml"))));
  folder.write("plain.yaml", two_links(""));
  EXPECT_TRUE(load_link_inertias(folder.path() / "plain.yaml").empty());
}

TEST(LinkInertias, ThatNoBodyHasAreRefusedWithTheirLine) {
  EXPECT_EQ(refusal_of(", inertia_kgm2: [1, 0, 0, 2, 0, 3]"), "accepted");
  EXPECT_THAT(refusal_of(", inertia_kgm2: [1, 0, 0, 1, 0, 3]"),
              AllOf(HasSubstr("robot.yaml:10"), HasSubstr("links[2].inertia_kgm2"), HasSubstr("1, 1 and 3 kg m^2")));
  EXPECT_THAT(refusal_of(", inertia_kgm2: [1, 2, 0, 1, 0, 1]"), HasSubstr("no negative principal moment"));
  EXPECT_THAT(refusal_of(", inertia_kgm2: [1, 1, 1]"), HasSubstr("must be 6 numbers"));
  EXPECT_THAT(refusal_of(", inertia_kgm2: 1"), HasSubstr("must be 6 numbers"));
  EXPECT_THAT(refusal_of(", inertia_kgm2: [1, 0, 0, 2, 0, 2]", "0"), HasSubstr("whose mass_kg is 0"));
  EXPECT_THAT(refusal_of(", inertia_kgm2: [2e6, 0, 0, 2e6, 0, 2e6]"), HasSubstr("it is in kg m^2"));
}

}  // namespace
}  // namespace demecal
