// What of a URDF is taken, assumed and said, and what is refused with a sentence.
#include "urdf/urdf_arm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "random/random_stream.hpp"
#include "small_urdf.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kTurns = "<axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\"/>";

TEST(UrdfArm, TakesNumbersAsTheyStandAndFixedJointsIntoOriginsAndFlange) {
  const UrdfFile urdf = parse_urdf(two_joints(), "arm.urdf");
  const UrdfArm arm = arm_between(urdf, {}, {});
  EXPECT_EQ(arm.base, "base");
  EXPECT_EQ(arm.tip, "tip");
  ASSERT_EQ(arm.drawing.joints.size(), 2u);
  EXPECT_EQ(arm.drawing.joints[1].origin.rpy_rad.x(), 1.5707963);
  EXPECT_EQ(arm.drawing.joints[1].row.lower, -2.0);
  EXPECT_EQ(arm.drawing.flange.xyz_m.y(), 0.1);
  EXPECT_THAT(arm.notes, IsEmpty());
}

TEST(UrdfArm, SaysWhatItAssumesOfLimitsAndAxes) {
  const std::string text = robot_xml(link_xml("base") + link_xml("a") + link_xml("b") + link_xml("c") + link_xml("d") +
                                     joint_xml("j1", "revolute", "base", "a") +
                                     joint_xml("j2", "continuous", "a", "b", "<axis xyz=\"0 3 0\"/>") +
                                     joint_xml("j3", "prismatic", "b", "c") +
                                     joint_xml("j4", "revolute", "c", "d", "<limit lower=\"1\" upper=\"-1\"/>"));
  const UrdfFile urdf = parse_urdf(text, "arm.urdf");
  const UrdfArm arm = arm_between(urdf, {}, {});
  EXPECT_EQ(arm.drawing.joints[0].axis, Eigen::Vector3d::UnitX());
  EXPECT_TRUE(arm.drawing.joints[0].row.endless);
  EXPECT_TRUE(arm.drawing.joints[1].row.endless);
  EXPECT_EQ(arm.drawing.joints[2].row.upper, 1.0);
  EXPECT_EQ(arm.drawing.joints[3].row.lower, -1.0);
  EXPECT_THAT(arm.notes,
              ElementsAre(HasSubstr("joint j1 states no limits"), HasSubstr("axis of joint j2 has length 3"),
                          HasSubstr("joint j3 states no limits"), HasSubstr("joint j4 has its lower limit above")));
}

TEST(UrdfArm, KeepsOriginsThatWereNotChangedWhateverTheirPitch) {
  RandomStream random{823};
  for (int trial = 0; trial < 200; ++trial) {
    std::string text = link_xml("l0");
    for (int joint = 1; joint <= 4; ++joint) {
      const double from_upright = std::pow(10.0, random.real(-12.0, -3.0));
      const double pitch = (random.real(-1.0, 1.0) < 0.0 ? -0.5 : 0.5) * std::numbers::pi + from_upright;
      std::ostringstream origin;
      origin.precision(10);
      origin << R"(<origin xyz="0.1 0.2 0.3" rpy=")" << random.real(-3.0, 3.0) << ' ' << pitch << ' '
             << random.real(-3.0, 3.0) << R"("/>)";
      const std::string number = std::to_string(joint), before = std::to_string(joint - 1);
      text += link_xml("l" + number) +
              joint_xml("j" + number, "revolute", "l" + before, "l" + number, origin.str() + kTurns);
    }
    text = robot_xml(text);
    const UrdfFile urdf = parse_urdf(text, "arm.urdf");
    const UrdfArm arm = arm_between(urdf, {}, {});
    const std::vector<Origin> origins = origins_of(arm.drawing, equivalent_chain(arm.drawing).chain);
    std::vector<NewOrigin> same;
    for (std::size_t i = 0; i < origins.size(); ++i)
      same.push_back({arm.joints[i], origin_of(pose_of(origins[i]), arm.joints[i]->origin)});
    EXPECT_EQ(with_origins(text, same), text);
    same[1].origin = origin_of(pose_of(origins[1]) * Eigen::Translation3d(1e-4, 0.0, 0.0), arm.joints[1]->origin);
    const std::string moved = with_origins(text, same);
    EXPECT_NE(moved, text);
    const auto rest = [](const std::string& whole) { return whole.substr(whole.find("rpy", whole.find("\"j2\""))); };
    EXPECT_EQ(rest(moved), rest(text)) << "what is shifted keeps its angles";
  }
}

TEST(UrdfArm, SaysWhereTheFrameOfTheControllerStands) {
  const auto with_base = [](const std::string& origin) {
    return robot_xml(link_xml("base_link") + link_xml("base") + link_xml("a") + link_xml("tool0") +
                     joint_xml("up", "fixed", "base_link", "base", origin) +
                     joint_xml("j1", "revolute", "base_link", "a", kTurns) + joint_xml("end", "fixed", "a", "tool0"));
  };
  const UrdfFile other = parse_urdf(with_base("<origin xyz=\"0 0 0.33\" rpy=\"0 0 3.14159265\"/>"), "arm.urdf");
  EXPECT_THAT(arm_between(other, {}, {}).notes, ElementsAre(AllOf(HasSubstr("[0, 0, 330] mm there, turned by 180 deg"),
                                                                  HasSubstr("--base base --tip tool0"))));
  EXPECT_THAT(arm_between(other, "base", "tool0").notes, IsEmpty());
  const UrdfArm alone = arm_between(other, "base", {});
  EXPECT_EQ(alone.tip, "tool0") << "the base is fixed to the link that the arm begins at";
  EXPECT_LT((alone.drawing.joints[0].origin.xyz_m - Eigen::Vector3d(0.0, 0.0, -0.33)).norm(), 1e-8);
  const UrdfFile same = parse_urdf(with_base("<origin xyz=\"0 0 0\"/>"), "arm.urdf");
  EXPECT_THAT(arm_between(same, {}, {}).notes, IsEmpty());
}

TEST(UrdfArm, SuspectsLimitsThatNoArmTurnsToAndRefusesQuaternions) {
  const auto with_joint = [](const std::string& inside) {
    return robot_xml(link_xml("base") + link_xml("a") + joint_xml("j1", "revolute", "base", "a", inside));
  };
  const std::string axis = "<axis xyz=\"0 0 1\"/>";
  const UrdfFile degrees_file = parse_urdf(with_joint(axis + "<limit lower=\"-170\" upper=\"170\"/>"), "arm.urdf");
  EXPECT_THAT(arm_between(degrees_file, {}, {}).notes, ElementsAre(HasSubstr("they may be in degrees")));
  const UrdfFile endless = parse_urdf(with_joint(axis + "<limit lower=\"-1e16\" upper=\"1e16\"/>"), "arm.urdf");
  EXPECT_THAT(arm_between(endless, {}, {}).notes, IsEmpty());
  EXPECT_THAT(complaint_of(with_joint(axis + "<origin quat_xyzw=\"0 0 0.7 0.7\"/><limit lower=\"-1\" upper=\"1\"/>")),
              AllOf(HasSubstr("arm.urdf:5"), HasSubstr("state the same orientation as rpy")));
}

TEST(UrdfArm, SuspectsMillimetresAndDegreesAndRefusesWhatNoRobotFileHolds) {
  const auto with_origin = [](const std::string& origin) {
    return robot_xml(link_xml("base") + link_xml("a") +
                     joint_xml("j1", "revolute", "base", "a", "<origin " + origin + "/>" + kTurns));
  };
  const auto notes_of = [&](const std::string& origin) {
    return arm_between(parse_urdf(with_origin(origin), "arm.urdf"), {}, {}).notes;
  };
  for (const std::string far : {"300", "-100.5", "1e9", "1e308"})
    EXPECT_THAT(complaint_of(with_origin("xyz=\"0 " + far + " 0\"")),
                AllOf(HasSubstr("arm.urdf:5: 'j1': stands "), HasSubstr("divide all by 1000")))
        << far;
  EXPECT_THAT(notes_of("xyz=\"0 0 30\""), ElementsAre(HasSubstr("joint j1 stands 30 m from link base")));
  EXPECT_THAT(notes_of("xyz=\"0 0 4\""), IsEmpty());
  for (const std::string turned : {"-90 0 0", "0 0.5 6.5", "0 0 5"})
    EXPECT_THAT(notes_of("rpy=\"" + turned + "\""), ElementsAre(HasSubstr("this may be degrees"))) << turned;
  for (const std::string turned : {"-1.5707963 0 6.2831853", "0 0.9 3", "0 0 0"})
    EXPECT_THAT(notes_of("rpy=\"" + turned + "\""), IsEmpty()) << turned;
}

TEST(UrdfArm, AddsUpTheMassesOfWhatMovesWithAJoint) {
  const auto mass = [](const char* kg, const char* at) {
    return "<inertial><mass value=\"" + std::string(kg) + "\"/><origin xyz=\"" + at + "\"/></inertial>";
  };
  const std::string text = robot_xml(link_xml("base", mass("100", "0 0 0")) + link_xml("a", mass("3", "0 0 0")) +
                                     link_xml("box", mass("1", "0 0.4 0")) + link_xml("b", mass("2", "0 0 0.1")) +
                                     joint_xml("j1", "revolute", "base", "a", kTurns) +
                                     joint_xml("screws", "fixed", "a", "box", "<origin xyz=\"0.8 0 0\"/>") +
                                     joint_xml("j2", "revolute", "a", "b", kTurns));
  const UrdfFile urdf = parse_urdf(text, "arm.urdf");
  const UrdfArm arm = arm_between(urdf, {}, "b");
  ASSERT_EQ(arm.masses.size(), 2u);
  EXPECT_DOUBLE_EQ(arm.masses[0].mass_kg, 4.0);
  EXPECT_LT((arm.masses[0].centre_m - Eigen::Vector3d(0.2, 0.1, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(arm.masses[1].centre_m.z(), 0.1);
  EXPECT_THAT(arm_between(urdf, {}, {}).tip, "b");  // the box is fixed on the way
}

TEST(UrdfArm, AddsUpTheInertiasOfWhatMovesWithAJointAboutTheCommonCentre) {
  const auto body = [](const char* kg, const char* origin, const char* inertia) {
    return "<inertial><mass value=\"" + std::string(kg) + "\"/><origin " + origin + "/><inertia " + inertia +
           "/></inertial>";
  };
  const std::string round = R"(ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1")",
                    rod = R"(ixx="0" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.2")";
  const auto arm_of = [&](const std::string& box, const std::string& b) {
    const std::string text =
        robot_xml(link_xml("base") + link_xml("a", body("3", R"(xyz="0 0 0")", round.c_str())) + link_xml("box", box) +
                  link_xml("b", b) + joint_xml("j1", "revolute", "base", "a", kTurns) +
                  joint_xml("screws", "fixed", "a", "box", "<origin xyz=\"0.8 0 0\"/>") +
                  joint_xml("j2", "revolute", "a", "b", kTurns));
    const UrdfFile urdf = parse_urdf(text, "arm.urdf");
    return arm_between(urdf, {}, "b");
  };
  // A rod along x in its own axes, which stand a quarter turn about z: along y in the link's.
  const UrdfArm arm = arm_of(body("1", R"(xyz="0 0 0")", round.c_str()),
                             body("2", R"(xyz="0 0 0.1" rpy="0 0 1.5707963267948966")", rod.c_str()));
  ASSERT_EQ(arm.inertias.size(), 2u);
  const double by_parallel_axes = 3.0 * 0.2 * 0.2 + 1.0 * 0.6 * 0.6;
  EXPECT_LT((*arm.inertias[0] -
             Eigen::Matrix3d(Eigen::Vector3d(0.2, 0.2 + by_parallel_axes, 0.2 + by_parallel_axes).asDiagonal()))
                .norm(),
            1e-15);
  EXPECT_LT((*arm.inertias[1] - Eigen::Matrix3d(Eigen::Vector3d(0.2, 0.0, 0.2).asDiagonal())).norm(), 1e-15);
  const UrdfArm wrong = arm_of(body("1", R"(xyz="0 0 0")", R"(ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="3")"),
                               body("2", R"(xyz="0 0 0.1")", rod.c_str()));
  EXPECT_FALSE(wrong.inertias[0]);
  EXPECT_TRUE(wrong.inertias[1]);
  EXPECT_THAT(wrong.notes, ElementsAre(HasSubstr("the inertia of link box is left out: it must have principal moments"),
                                       HasSubstr("no inertia is written of what moves with link box")));
  const std::string bare = "<inertial><mass value=\"1\"/></inertial>";
  EXPECT_FALSE(arm_of(bare, body("2", R"(xyz="0 0 0.1")", rod.c_str())).inertias[0]);
}

TEST(UrdfArm, AsksForTheTipWhereSeveralArmsBeginAndTakesTool0OfFixedEnds) {
  const std::string second = link_xml("c") + joint_xml("j3", "revolute", "base", "c", kTurns);
  EXPECT_THAT(complaint_of(two_joints(second)), AllOf(HasSubstr("tip, c"), HasSubstr("--tip")));
  EXPECT_EQ(complaint_of(two_joints(second), "tip"), "accepted");
  const std::string camera =
      link_xml("camera") + joint_xml("screws", "fixed", "b", "camera", "<origin xyz=\"1 0 0\"/>");
  const std::string body = link_xml("body") + joint_xml("screws", "fixed", "b", "body");
  EXPECT_EQ(complaint_of(two_joints(body)), "accepted");
  EXPECT_THAT(complaint_of(two_joints(camera)), AllOf(HasSubstr("camera"), HasSubstr("tip"), HasSubstr("--tip")));
  const std::string tool0 = link_xml("tool0") + joint_xml("screws", "fixed", "b", "tool0");
  const UrdfFile urdf = parse_urdf(two_joints(tool0), "arm.urdf");
  const UrdfArm arm = arm_between(urdf, {}, {});
  EXPECT_EQ(arm.tip, "tool0");
  EXPECT_THAT(arm.notes, ElementsAre(AllOf(HasSubstr("tool0"), HasSubstr("tip"))));
}

TEST(UrdfArm, DoesNotTakeAGripperForTheEndOfTheArm) {
  const std::string fingers = link_xml("left") + link_xml("right") +
                              joint_xml("f1", "prismatic", "tip", "left", kTurns) +
                              joint_xml("f2", "prismatic", "tip", "right", kTurns + "<mimic joint=\"f1\"/>");
  EXPECT_THAT(complaint_of(two_joints(fingers)), AllOf(HasSubstr("left, right"), HasSubstr("--tip")));
  EXPECT_EQ(complaint_of(two_joints(fingers), "tip"), "accepted");
  const std::string strut =
      link_xml("strut") + joint_xml("s", "revolute", "base", "strut", kTurns + "<mimic joint=\"j1\"/>");
  EXPECT_EQ(complaint_of(two_joints(strut)), "accepted");
}

TEST(UrdfArm, RefusesWhatIsNoSerialArmWithASentenceAndItsLine) {
  const auto with_joint = [](const std::string& type, const std::string& inside) {
    return robot_xml(link_xml("base") + link_xml("a") + joint_xml("j", type, "base", "a", inside));
  };
  EXPECT_THAT(complaint_of(with_joint("floating", "")), AllOf(HasSubstr("arm.urdf:5"), HasSubstr("floating joint")));
  EXPECT_THAT(complaint_of(with_joint("revolute", "<axis xyz=\"0 0 0\"/>")), HasSubstr("axis of zero length"));
  EXPECT_THAT(complaint_of(with_joint("revolute", "<axis xyz=\"0 0\"/>")), HasSubstr("must be 3 numbers"));
  EXPECT_THAT(complaint_of(with_joint("revolute", "<origin xyz=\"0 0 nan\"/>")), HasSubstr("must be 3 numbers"));
  EXPECT_THAT(complaint_of(with_joint("ball", "")), HasSubstr("is no type of a joint"));
  EXPECT_THAT(complaint_of(with_joint("fixed", "")), HasSubstr("no moving joint"));
  EXPECT_THAT(complaint_of(two_joints(joint_xml("again", "fixed", "a", "tip"))), HasSubstr("second joint"));
  EXPECT_THAT(complaint_of(two_joints(joint_xml("j9", "fixed", "a", "tipp"))), HasSubstr("nearest is tip"));
  EXPECT_THAT(complaint_of(two_joints(joint_xml("ring", "fixed", "tip", "base"))), HasSubstr("ring of joints"));
  EXPECT_THAT(complaint_of(two_joints(link_xml("alone"))), HasSubstr("say --base"));
  EXPECT_THAT(complaint_of(two_joints(), "tiip"), HasSubstr("nearest is tip"));
  EXPECT_THAT(complaint_of(two_joints("<xacro:arm/>")), HasSubstr("is xacro that is not expanded"));
  EXPECT_THAT(complaint_of(with_joint("revolute", "<origin xyz=\"${x} 0 0\"/>")), HasSubstr("is xacro"));
  EXPECT_THAT(complaint_of("<sdf/>"), HasSubstr("is an SDF"));
  EXPECT_THAT(complaint_of(robot_xml(link_xml("base") + link_xml("a") + link_xml("b") +
                                     joint_xml("j1", "revolute", "base", "a", kTurns) +
                                     joint_xml("j2", "revolute", "a", "b", kTurns + "<mimic joint=\"j1\"/>"))),
              HasSubstr("follows joint j1"));
}

TEST(Xml, IsRefusedWhereItIsCutOffOrMisspelt) {
  EXPECT_THAT(complaint_of(""), HasSubstr("holds no XML"));
  EXPECT_THAT(complaint_of("<robot"), HasSubstr("cut off"));
  EXPECT_THAT(complaint_of("<robot>\n<link name=\"a\"/>"), AllOf(HasSubstr("arm.urdf:2"), HasSubstr("cut off")));
  EXPECT_THAT(complaint_of("<robot></robto>"), HasSubstr("</robot> should"));
  EXPECT_THAT(complaint_of("<robot name=a/>"), HasSubstr("not in quotes"));
  EXPECT_THAT(complaint_of("<robot name=\"a\" name=\"b\"/>"), HasSubstr("given twice"));
  EXPECT_THAT(complaint_of("<robot name=\"&what;\"/>"), HasSubstr("&amp;"));
  EXPECT_THAT(complaint_of("<robot/><robot/>"), HasSubstr("second element"));
  EXPECT_THAT(complaint_of("\xff\xfe<"), HasSubstr("UTF-16"));
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_THAT(complaint_of(deep), HasSubstr("nested too deep"));
}

TEST(Xml, KnowsTheBytesOfValuesAndPassesOverTheRest) {
  const std::string text =
      "\xef\xbb\xbf<?xml version='1.0'?><!DOCTYPE robot [<!ENTITY a 'b'>]>\n<!-- <robot> -->\n<robot name = 'a "
      "&lt;&#65;&#x42;'>"
      "text &amp; &what;<![CDATA[<x>]]><link\n name=\"b\"/>.</robot>\n<!-- end -->";
  const XmlElement root = parse_xml(text, "x");
  EXPECT_EQ(root.attribute("name")->value, "a <AB");
  EXPECT_EQ(root.line, 3u);
  EXPECT_EQ(root.text, "text & &what;<x>.");
  ASSERT_EQ(root.children.size(), 1u);
  const XmlElement& link = root.children[0];
  EXPECT_EQ(text.substr(link.attribute("name")->begin, 1), "b");
  EXPECT_EQ(text.substr(link.begin, link.tag_end - link.begin), "<link\n name=\"b\"/>");
  EXPECT_TRUE(link.stands_closed);
}

}  // namespace
}  // namespace demecal
