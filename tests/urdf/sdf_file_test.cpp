// What of an SDF is taken, and what is refused with a sentence and its line.
#include "urdf/sdf_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "small_sdf.hpp"
#include "small_urdf.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::string replaced(std::string text, const std::string& old_words, const std::string& words) {
  const std::size_t at = text.find(old_words);
  EXPECT_NE(at, std::string::npos) << old_words;
  return at == std::string::npos ? text : text.replace(at, old_words.size(), words);
}

TEST(SdfFile, TakesNumbersAsTheyStandWhereLinksAreStatedInTheLinkBefore) {
  const std::string text =
      sdf_xml(sdf_link("base") + sdf_link("a", "<pose relative_to=\"j1\"/>") +
              sdf_link("b", "<pose relative_to=\"a\"><!-- mm? -->0.4 0 0 1.5707963 0 0</pose>") +
              sdf_joint("j1", "revolute", "base", "a", "<pose relative_to=\"base\">0 0 .5 0 0 3</pose>" + sdf_axis()) +
              sdf_joint("j2", "continuous", "a", "b", "<axis/>") +
              "<frame name=\"tool0\" attached_to=\"b\"><pose degrees=\"1\">0 0.1 0 0 0 180</pose></frame>\n");
  const UrdfFile sdf = parse_urdf_or_sdf(text, "arm.sdf");
  const UrdfArm arm = arm_between(sdf, {}, {});
  EXPECT_TRUE(sdf.is_sdf);
  EXPECT_EQ(sdf.robot, "made up");
  EXPECT_EQ(arm.base, "base");
  EXPECT_EQ(arm.tip, "tool0");
  ASSERT_EQ(arm.drawing.joints.size(), 2u);
  EXPECT_EQ(arm.drawing.joints[0].origin, (Origin{{0, 0, 0.5}, {0, 0, 3}}));
  EXPECT_EQ(arm.drawing.joints[0].row.lower, -2.0);
  EXPECT_EQ(arm.drawing.joints[1].origin, (Origin{{0.4, 0, 0}, {1.5707963, 0, 0}}));
  EXPECT_EQ(arm.drawing.joints[1].axis, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(arm.drawing.joints[1].row.endless);
  EXPECT_DOUBLE_EQ(arm.drawing.flange.rpy_rad.z(), 3.14159265358979323846);
  EXPECT_THAT(arm.notes, IsEmpty());
}

TEST(SdfFile, HasNoLimitsWhereTheyAreMissingOrEndless) {
  const auto joint = [](const std::string& type, const std::string& lower, const std::string& upper) {
    const std::string text = replaced(small_sdf(), sdf_joint("j2", "revolute", "a", "b", sdf_axis("<xyz>0 1 0</xyz>")),
                                      sdf_joint("j2", type, "a", "b", sdf_axis("<xyz>0 1 0</xyz>", lower, upper)));
    const UrdfFile sdf = parse_urdf_or_sdf(text, "arm.sdf");
    const UrdfArm arm = arm_between(sdf, {}, {});
    return std::pair{arm.drawing.joints[1].row, arm.notes};
  };
  EXPECT_TRUE(joint("revolute", "-1e16", "1e16").first.endless);
  EXPECT_TRUE(joint("revolute", "-inf", "inf").first.endless);
  EXPECT_THAT(joint("revolute", "-inf", "inf").second, IsEmpty());
  EXPECT_THAT(joint("revolute", "-1", "inf").second, ElementsAre(HasSubstr("states no limits")));
  EXPECT_FALSE(joint("revolute", "-1", "1").first.endless);
  EXPECT_THAT(joint("revolute", "-1", "1").second, IsEmpty());
  EXPECT_EQ(joint("prismatic", "-0.1", "0.2").first.upper, 0.2);
  EXPECT_THAT(joint("prismatic", "-1e16", "1e16").second, ElementsAre(HasSubstr("states no limits")));
}

TEST(SdfFile, SuspectsPosesInDegreesThatDoNotSaySo) {
  const auto notes_of = [](const std::string& pose) {
    return arm_between(parse_urdf_or_sdf(replaced(small_sdf(), "<pose>0.4 0 0.5 0 0 0", pose), "arm.sdf"), {}, {})
        .notes;
  };
  EXPECT_THAT(notes_of("<pose>0.4 0 0.5 90 0 0"), ElementsAre(HasSubstr("turned by an angle of 90")));
  EXPECT_THAT(notes_of("<pose degrees=\"true\">0.4 0 0.5 90 0 0"), IsEmpty());
  EXPECT_THAT(sdf_complaint(replaced(small_sdf(), "<pose>0.4 0 0.5", "<pose>400 0 0.5")),
              AllOf(HasSubstr("arm.sdf:7: 'j2': stands 400 m from link a"), HasSubstr("divide all by 1000")));
}

TEST(SdfFile, TakesAJointThatItsLimitsHoldAsFixedThere) {
  const std::string held = sdf_link("c", "<pose>0.4 0 0.5 0 0 0</pose>") +
                           sdf_joint("j3", "revolute", "b", "c", sdf_axis("<xyz>0 0 1</xyz>", "0.5", "0.5")) +
                           sdf_link("d", "<pose>0.5 0 0.5 0 0 0</pose>") +
                           sdf_joint("j4", "prismatic", "c", "d", sdf_axis("<xyz>1 0 0</xyz>", "0", "0"));
  const UrdfFile sdf = parse_urdf_or_sdf(small_sdf(held), "arm.sdf");
  const UrdfArm arm = arm_between(sdf, {}, {});
  EXPECT_EQ(arm.joints.size(), 2u);
  EXPECT_EQ(arm.tip, "d");
  EXPECT_DOUBLE_EQ(arm.drawing.flange.rpy_rad.z(), 0.5);
  EXPECT_NEAR(arm.drawing.flange.xyz_m.y(), 0.1 * std::sin(0.5), 1e-15);
}

TEST(SdfFile, AddsUpMassesWithTheirPlaces) {
  const std::string inertial = "<inertial><mass>3</mass><pose>0 0.2 0 1 1 1</pose></inertial>";
  const std::string joint = "<pose>0 0 0.1 0 0 0</pose>";
  const std::string unknown = "<inertial auto=\"true\"><mass>7</mass></inertial>";
  std::string text = replaced(small_sdf(), "0.4 0 0.5 0 0 0</pose>", "0.4 0 0.5 0 0 0</pose>" + inertial);
  text = replaced(text, "<child>b</child>", "<child>b</child>" + joint);
  text = replaced(text, "0 0 0.5 0 0 0</pose>", "0 0 0.5 0 0 0</pose>" + unknown);
  const UrdfFile sdf = parse_urdf_or_sdf(text, "arm.sdf");
  const UrdfArm arm = arm_between(sdf, {}, {});
  ASSERT_EQ(arm.masses.size(), 2u);
  EXPECT_EQ(arm.masses[0].mass_kg, 0.0);
  EXPECT_EQ(arm.masses[1].mass_kg, 3.0);
  EXPECT_LT((arm.masses[1].centre_m - Eigen::Vector3d(0, 0.2, -0.1)).norm(), 1e-15);  // in the joint's frame
  EXPECT_LT((arm.drawing.flange.xyz_m - Eigen::Vector3d(0, 0, -0.1)).norm(), 1e-15);
}

TEST(SdfFile, StandsOnTheWorldByTheModelsPose) {
  const std::string stand = sdf_joint("stand", "fixed", "world", "base");
  const std::string in_world = replaced(small_sdf(stand), "made up\">", "made up\"><pose>1 2 3 0 0 0</pose>");
  const UrdfFile sdf = parse_urdf_or_sdf(in_world, "arm.sdf");
  const UrdfArm arm = arm_between(sdf, {}, {});
  EXPECT_EQ(arm.base, "world");
  EXPECT_LT((arm.drawing.joints[0].origin.xyz_m - Eigen::Vector3d(1, 2, 3.5)).norm(), 1e-15);
  EXPECT_EQ(arm_between(sdf, "base", {}).drawing.joints[0].origin, Origin{.xyz_m = Eigen::Vector3d(0, 0, 0.5)});
  const UrdfFile placed = parse_urdf_or_sdf(replaced(in_world, "made up\"", "made up\" placement_frame=\"a\""), "a");
  const UrdfArm on_link = arm_between(placed, {}, {});
  EXPECT_LT((on_link.drawing.joints[0].origin.xyz_m - Eigen::Vector3d(1, 2, 3)).norm(), 1e-15);
}

TEST(SdfFile, HasAxesInTheModelsFrameWhereOldVersionsDo) {
  const auto axis_of = [](const std::string& version, const std::string& more) {
    std::string text = replaced(small_sdf("", version), "0.4 0 0.5 0 0 0", "0.4 0 0.5 0 0 1.5707963267948966");
    text = replaced(text, "<xyz>0 1 0</xyz>", "<xyz>0 1 0</xyz>" + more);
    const UrdfFile sdf = parse_urdf_or_sdf(text, "arm.sdf");
    return arm_between(sdf, {}, {}).drawing.joints[1].axis;
  };
  const std::string in_model = "<use_parent_model_frame>1</use_parent_model_frame>";
  const std::string in_joint = "<use_parent_model_frame>false</use_parent_model_frame>";
  for (const char* version : {"1.4", "1.5", "1.6"}) {
    EXPECT_LT((axis_of(version, in_model) - Eigen::Vector3d::UnitX()).norm(), 1e-15) << version;
    EXPECT_EQ(axis_of(version, in_joint), Eigen::Vector3d::UnitY()) << version;
  }
  EXPECT_LT((axis_of("1.4", "") - Eigen::Vector3d::UnitX()).norm(), 1e-15);
  for (const char* version : {"1.5", "1.6", "1.7", "1.8", "1.11", "1.12"})
    EXPECT_EQ(axis_of(version, ""), Eigen::Vector3d::UnitY()) << version;
}

TEST(SdfFile, IsToldFromAUrdfByItsFirstElement) {
  EXPECT_EQ(sdf_complaint(small_sdf()), "accepted");
  EXPECT_EQ(sdf_complaint("<?xml version=\"1.0\"?><!-- <robot/> -->" + small_sdf()), "accepted");
  EXPECT_EQ(sdf_complaint(two_joints()), "accepted");
  EXPECT_FALSE(parse_urdf_or_sdf(two_joints(), "arm.sdf").is_sdf);
  EXPECT_THAT(sdf_complaint("<mesh/>"), HasSubstr("first element"));
}

TEST(SdfFile, MayStandInAWorldAndHoldWhatIsNoPartOfTheArm) {
  const std::string world = "<sdf version=\"1.9\"><world name=\"hall\"><light name=\"sun\" type=\"directional\"/>" +
                            small_sdf("<plugin name=\"p\"><include/></plugin><static>true</static>");
  std::string text = replaced(world, "<sdf version=\"1.9\">\n<model", "<model");
  text = replaced(text, "</model>", "</model></world>");
  EXPECT_EQ(sdf_complaint(text), "accepted");
  const std::string wheel = sdf_link("wheel") + sdf_joint("ball", "ball", "base", "wheel") +
                            sdf_joint("screw", "screw", "a", "nut") + sdf_link("nut");
  EXPECT_EQ(sdf_complaint(small_sdf(wheel), "b"), "accepted");
  EXPECT_EQ(sdf_complaint(replaced(small_sdf("", "1.6"), "name=\"j1\"", "name=\"a\"")), "accepted");
}

TEST(SdfFile, IsRefusedWhereItIsNoSingleModel) {
  EXPECT_THAT(sdf_complaint(small_sdf("\n<include><uri>model://arm</uri></include>")),
              AllOf(StartsWith("arm.sdf:9: '<include>'"), HasSubstr("gz sdf -p")));
  EXPECT_THAT(sdf_complaint(small_sdf("<model name=\"gripper\"/>")),
              AllOf(StartsWith("arm.sdf:8: 'gripper'"), HasSubstr("model in a model"), HasSubstr("gz sdf -p")));
  EXPECT_THAT(sdf_complaint(replaced(small_sdf(), "</model>", "</model>\n<model name=\"box\"/>")),
              AllOf(StartsWith("arm.sdf:9: 'box'"), HasSubstr("second model")));
  EXPECT_THAT(sdf_complaint("<sdf version='1.9'><world name='w'>\n<include/></world></sdf>"), StartsWith("arm.sdf:2"));
  EXPECT_THAT(sdf_complaint("<sdf version='1.9'></sdf>"), HasSubstr("no <model>"));
  EXPECT_THAT(sdf_complaint(sdf_xml("")), AllOf(StartsWith("arm.sdf:2"), HasSubstr("has no links")));
  EXPECT_THAT(sdf_complaint(small_sdf("", "1.3")), AllOf(StartsWith("arm.sdf:1: '1.3'"), HasSubstr("gz sdf -p")));
  EXPECT_THAT(sdf_complaint(small_sdf("", "2.0")), HasSubstr("1.4 to 1.12"));
  EXPECT_THAT(sdf_complaint(small_sdf("<xacro:arm/>")), AllOf(StartsWith("arm.sdf:8"), HasSubstr("is xacro")));
}

TEST(SdfFile, IsRefusedWhereFramesStandNowhere) {
  const auto in = [](const std::string& frame) { return "<pose relative_to=\"" + frame + "\">0 0 0 0 0 0</pose>"; };
  const std::string ring = "<frame name=\"f\">" + in("g") + "</frame>\n<frame name=\"g\">" + in("f") + "</frame>";
  EXPECT_THAT(sdf_complaint(small_sdf(ring)), AllOf(StartsWith("arm.sdf:8: 'f -> g -> f'"), HasSubstr("a ring")));
  EXPECT_THAT(sdf_complaint(small_sdf("<frame name=\"f\" attached_to=\"f\">" + in("a") + "</frame>")),
              AllOf(StartsWith("arm.sdf:8: 'f -> f'"), HasSubstr("attached to each other")));
  EXPECT_THAT(sdf_complaint(small_sdf("<frame name=\"f\">" + in("bas") + "</frame>")),
              AllOf(StartsWith("arm.sdf:8: 'bas'"), HasSubstr("nearest is base")));
  EXPECT_THAT(sdf_complaint(small_sdf("<frame name=\"f\">" + in("arm::base") + "</frame>")), HasSubstr("arm::base"));
  EXPECT_THAT(sdf_complaint(small_sdf("<frame name=\"a\"/>")),
              AllOf(StartsWith("arm.sdf:8"), HasSubstr("second link")));
  EXPECT_THAT(sdf_complaint(replaced(small_sdf(), "<pose>0 0 0.5", "<pose relative_to=\"j1\">0 0 0.5")),
              AllOf(StartsWith("arm.sdf:4: 'a -> j1 -> a'"), HasSubstr("a ring")));
  EXPECT_THAT(sdf_complaint(replaced(small_sdf(), "<xyz>0 1 0", "<xyz expressed_in=\"q\">0 1 0")),
              StartsWith("arm.sdf:7: 'q'"));
  EXPECT_THAT(sdf_complaint(small_sdf(sdf_joint("j3", "fixed", "b", "nothing"))), StartsWith("arm.sdf:8: 'nothing'"));
  EXPECT_THAT(sdf_complaint(small_sdf(sdf_joint("j3", "fixed", "nothing", "b"))), StartsWith("arm.sdf:8: 'nothing'"));
  EXPECT_THAT(sdf_complaint(small_sdf(sdf_joint("j3", "fixed", "b", "world"))), HasSubstr("child is the world"));
  EXPECT_THAT(sdf_complaint(small_sdf(sdf_joint("j3", "fixed", "b", "a"))), HasSubstr("second joint"));
  EXPECT_THAT(sdf_complaint(small_sdf(sdf_joint("j3", "fixed", "b", "base"))), HasSubstr("ring of joints"));
  const std::string stand = sdf_joint("stand", "fixed", "world", "base");
  EXPECT_THAT(sdf_complaint(replaced(small_sdf(stand), "made up\">", "made up\">" + in("table"))),
              AllOf(StartsWith("arm.sdf:2: 'table'"), HasSubstr("frame of the world")));
}

TEST(SdfFile, IsRefusedWhereNumbersOrTypesAreWrong) {
  const auto pose = [](const std::string& tag) { return sdf_complaint(replaced(small_sdf(), "<pose>0 0 0.5", tag)); };
  EXPECT_THAT(pose("<pose>0 0"), AllOf(StartsWith("arm.sdf:4: '0 0 0 0 0'"), HasSubstr("must be 6 numbers")));
  EXPECT_THAT(pose("<pose>0 0 nan"), HasSubstr("must be 6 numbers"));
  EXPECT_THAT(pose("<pose rotation_format=\"quat_xyzw\">0 0 0.5"), HasSubstr("must be 7 numbers"));
  EXPECT_THAT(pose("<pose rotation_format=\"quat_xyzw\">2 0 0 0.5"), HasSubstr("length of a quaternion"));
  EXPECT_EQ(pose("<pose rotation_format=\"quat_xyzw\">0 0 0.5 1"), "accepted");
  EXPECT_THAT(pose("<pose rotation_format=\"quat_xyzw\" degrees=\"true\">0 0 0.5 1"), HasSubstr("remove it"));
  EXPECT_THAT(pose("<pose rotation_format=\"matrix\">0 0 0.5"), HasSubstr("no rotation_format"));
  EXPECT_THAT(pose("<pose frame=\"base\">0 0 0.5"), AllOf(StartsWith("arm.sdf:4: 'base'"), HasSubstr("relative_to")));
  EXPECT_EQ(pose("<pose frame=\"\">0 0 0.5"), "accepted");
  for (const char* type : {"ball", "universal", "screw", "revolute2", "gearbox"}) {
    const std::string more = sdf_link("c") + sdf_joint("j3", type, "b", "c");
    EXPECT_THAT(sdf_complaint(small_sdf(more)),
                AllOf(StartsWith("arm.sdf:9: 'j3'"), HasSubstr("is a " + std::string(type) + " joint")));
  }
  EXPECT_THAT(sdf_complaint(small_sdf(sdf_joint("j3", "floating", "b", "c"))), HasSubstr("no type of a joint"));
  const std::string no_axis = sdf_link("c") + sdf_joint("j3", "revolute", "b", "c");
  EXPECT_THAT(sdf_complaint(small_sdf(no_axis)), AllOf(StartsWith("arm.sdf:9: 'j3'"), HasSubstr("zero length")));
  const std::string mimic = sdf_link("c") + sdf_joint("j3", "revolute", "b", "c", "<axis><mimic joint=\"j1\"/></axis>");
  EXPECT_THAT(sdf_complaint(small_sdf(mimic)), HasSubstr("follows joint j1"));
  EXPECT_THAT(sdf_complaint(small_sdf(sdf_link("c", "<inertial><mass>-1</mass></inertial>"))), HasSubstr("negative"));
  const std::string elsewhere = "<inertial><mass>1</mass><pose relative_to=\"a\">0 0 0 0 0 0</pose></inertial>";
  EXPECT_THAT(sdf_complaint(small_sdf(sdf_link("c", elsewhere))), HasSubstr("inertial"));
}

}  // namespace
}  // namespace demecal
