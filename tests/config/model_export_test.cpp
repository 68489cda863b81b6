// The URDF of a calibrated arm moves as the model does, and differs from the user's own in the origins of joints alone.
#include "config/model_export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "data_files/robot_file.hpp"
#include "drafting/templates.hpp"
#include "kinematics/random_arm.hpp"
#include "temporary_folder.hpp"
#include "urdf/urdf_arm.hpp"
#include "urdf/urdf_file.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

const std::string kUrdf = R"xml(<?xml version="1.0"?>
<!-- a comment with <origin xyz="1 2 3"/> -->
<robot name="small &amp; made up">
  <link name="base"><visual><origin xyz="0 0 1"/><geometry><mesh filename="package://a.stl"/></geometry></visual></link>
  <joint name="stand" type="fixed"><parent link="base"/><child link="s"/><origin xyz="0.1 0 0.2" rpy="0 0 3.1415926"/></joint>
  <link name="s"/><link name="a"/><link name="b"/><link name="c"/><link name='tip' />
  <joint name="j1" type="revolute">
    <axis xyz="0 0 1"/><limit lower="-2" upper="2"/>
    <parent link="s"/><child link="a"/>
  </joint>
  <joint type='revolute' name='j2'><origin   xyz = '0.1  0  0.4'/><axis xyz="0 1 0"/><limit lower="-2" upper="2"/>
    <parent link="a"/><child link="b"/></joint>
  <joint name="j3" type="revolute"><origin rpy="0 0 0" xyz="0 0 0.5"></origin><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2"/><parent link="b"/><child link="c"/></joint>
  <joint name="end" type="fixed"><parent link="c"/><child link="tip"/><origin xyz="0 0 0.1" rpy="1.5707963 0 0"/></joint>
  <gazebo reference="a"><origin xyz="7 7 7"/></gazebo>
</robot>
)xml";

std::string without_joint_origins(const std::string& text) {
  static const std::regex origin("<origin[^>]*/?>(</origin>)?");
  return std::regex_replace(text, origin, "");
}

std::vector<std::string> origins_of_text(const std::string& text) {
  static const std::regex origin("<origin[^>]*>");
  return {std::sregex_token_iterator(text.begin(), text.end(), origin, 0), std::sregex_token_iterator()};
}

CalibratedModel model_of(const Robot& robot) {
  CalibratedModel model;
  model.nominal = robot;
  DataSet none;
  none.robot = robot;
  model.robot = nominal_robot(none);
  return model;
}

void disturb(CalibratedModel& model, RandomStream& stream, double size) {
  for (Joint& row : model.robot.chain.joints) {
    for (int i = 0; i < kLinkParameters; ++i) row.parameter(static_cast<LinkParameter>(i)) += stream.real(-size, size);
  }
}

Chain chain_in(const std::string& text, const std::string& tip) {
  const UrdfFile urdf = parse_urdf(text, "exported");
  return equivalent_chain(arm_between(urdf, std::nullopt, tip).drawing).chain;
}

void expect_same_motion(const Chain& one, const Chain& other, RandomStream& stream) {
  for (int i = 0; i < 50; ++i) {
    const JointVector q = random_change(stream, one.size(), 2.0);
    EXPECT_LT((forward(one, q).matrix() - forward(other, q).matrix()).cwiseAbs().maxCoeff(), 1e-10);
  }
}

Robot imported(const TemporaryFolder& folder, const std::string& text) {
  const std::string urdf = folder.write("arm.urdf", text);
  const std::string out = folder.path() / "robot.yaml";
  folder.write("robot.yaml", import_urdf({.file = urdf, .base = {}, .tip = {}, .beside = out}).text);
  return load_robot(out);
}

TEST(ExportedUrdf, MovesAsTheModelAndKeepsEveryOtherByte) {
  RandomStream stream{1841};
  const TemporaryFolder folder;
  CalibratedModel model = model_of(imported(folder, kUrdf));
  EXPECT_EQ(calibrated_urdf(model, "").text, kUrdf);
  disturb(model, stream, 1e-3);
  const ExportedArm exported = calibrated_urdf(model, "");
  EXPECT_EQ(without_joint_origins(exported.text), without_joint_origins(kUrdf));
  expect_same_motion(chain_in(exported.text, "tip"), model.robot.chain, stream);
  const std::vector<std::string> before = origins_of_text(kUrdf), after = origins_of_text(exported.text);
  ASSERT_EQ(after.size(), before.size() + 1);  // joint 1 had none
  for (const std::string& kept : {before[0], before[1], before[2], before[5], before[6]})
    EXPECT_THAT(after, Contains(kept));
}

TEST(ExportedUrdf, LeavesTheFirstJointWhereARegistrationCannotTellItFromTheBase) {
  RandomStream stream{1842};
  const TemporaryFolder folder;
  CalibratedModel model = model_of(imported(folder, kUrdf));
  model.declared.registration = true;
  model.robot.chain.joints[0].d_m += 0.01;
  EXPECT_EQ(calibrated_urdf(model, "").text, kUrdf);
}

TEST(ExportedUrdf, IsRefusedWhereTheFileIsNotTheOneThatWasImported) {
  const TemporaryFolder folder;
  const CalibratedModel model = model_of(imported(folder, kUrdf));
  std::string other = kUrdf;
  other.replace(other.find("0.1  0  0.4"), 11, "0.1  0  0.5");
  const std::string changed = folder.write("changed.urdf", other);
  EXPECT_THAT(complaint([&] { calibrated_urdf(model, changed); }), HasSubstr("'j2': is not the joint 2"));
  std::filesystem::remove(folder.path() / "arm.urdf");
  EXPECT_THAT(complaint([&] { calibrated_urdf(model, ""); }), HasSubstr("say --urdf"));
  EXPECT_EQ(calibrated_urdf(model, folder.write("moved.urdf", kUrdf)).text, kUrdf);
}

TEST(ExportedUrdf, IsANewOneOfArmsThatWereNotImported) {
  RandomStream stream{1843};
  for (const Convention convention : kConventions) {
    Robot robot;
    robot.name = "rows";
    robot.chain = random_arm(stream, 5, convention, 0.2);
    robot.chain.base = random_place(stream);
    robot.chain.flange = random_place(stream);
    CalibratedModel model = model_of(robot);
    disturb(model, stream, 1e-3);
    expect_same_motion(chain_in(calibrated_urdf(model, "").text, "flange"), model.robot.chain, stream);
  }
}

TEST(ExportedUrdf, IsANewOneOfAnSdfWhichIsNeverRewritten) {
  const std::string sdf =
      "<sdf version='1.9'><model name='m'><link name='base'/><link name='a'><pose>0 0 0.4 0 0 0</pose></link>"
      "<link name='b'><pose>0.3 0 0.4 0 0 0</pose></link>"
      "<joint name='j1' type='revolute'><parent>base</parent><child>a</child><axis><xyz>0 0 1</xyz></axis></joint>"
      "<joint name='j2' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 1 0</xyz></axis></joint>"
      "</model></sdf>";
  RandomStream stream{1844};
  const TemporaryFolder folder;
  CalibratedModel model = model_of(imported(folder, sdf));
  EXPECT_FALSE(model.nominal.urdf);
  disturb(model, stream, 1e-3);
  const ExportedArm exported = calibrated_urdf(model, "");
  expect_same_motion(chain_in(exported.text, "flange"), model.robot.chain, stream);
  EXPECT_THAT(exported.notes, Contains(HasSubstr("not imported from a URDF; a new one")));
  const std::string file = folder.write("arm.sdf", sdf);
  EXPECT_THAT(complaint([&] { calibrated_urdf(model, file); }), HasSubstr("without --urdf a new one"));
  const CalibratedModel of_urdf = model_of(imported(folder, kUrdf));
  EXPECT_THAT(complaint([&] { calibrated_urdf(of_urdf, file); }), HasSubstr("is an SDF; a URDF is expected"));
}

/// Without returns and what is blank at its end.
std::string bare(std::string text) {
  std::erase(text, '\r');
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

/// The URDF that a ROS 2 node finds in a parameter file.
std::string described_in(const std::string& parameters) {
  const YamlNode file = parse_yaml(parameters, "parameters.yaml");
  return bare(file.at("/**").at("ros__parameters").at("robot_description").text());
}

TEST(ExportedUrdf, OfEveryPublicFileIsThatFileAgainAndMovesAsItsModel) {
  const std::filesystem::path public_files = std::filesystem::path(DEMECAL_SOURCE_DIR) / "../shared/data/urdf";
  if (!std::filesystem::exists(public_files)) GTEST_SKIP() << "needs " << public_files;
  RandomStream stream{1844};
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(public_files)) {
    if (entry.path().extension() != ".urdf") continue;
    SCOPED_TRACE(entry.path().filename());
    const TemporaryFolder folder;
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    Robot robot;
    try {
      robot = imported(folder, text.str());
    } catch (const InputError&) {
      continue;  // its tip has to be named
    }
    CalibratedModel model = model_of(robot);
    EXPECT_EQ(calibrated_urdf(model, "").text, text.str());
    disturb(model, stream, 1e-4);
    const std::string calibrated = calibrated_urdf(model, "").text;
    expect_same_motion(chain_in(calibrated, robot.urdf->tip), model.robot.chain, stream);
    EXPECT_EQ(described_in(ros2_parameters(model, "").text), bare(calibrated));
    ++files;
  }
  EXPECT_GE(files, 19);
}

/// The pose of wrist_3 by a calibration file, joints turned about z.
Eigen::Isometry3d pose_by_driver(const std::string& text, const JointVector& q) {
  const YamlNode file = parse_yaml(text, "calibration.yaml");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  int joint = 0;
  for (const char* link : {"shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"}) {
    const YamlNode& place = file.at("kinematics").at(link);
    const auto number = [&](const char* key) { return place.at(key).number(); };
    EXPECT_LT(std::abs(number("x")) + std::abs(number("y")) + std::abs(number("z")), 1.0);
    pose = pose *
           pose_of(Origin{{number("x"), number("y"), number("z")}, {number("roll"), number("pitch"), number("yaw")}}) *
           Eigen::AngleAxisd(q[joint++], Eigen::Vector3d::UnitZ());
  }
  return pose;
}

TEST(UrCalibration, MovesAsTheModelWhateverTheArmIsDrawnLike) {
  RandomStream stream{1845};
  for (const char* file : {"ur3", "ur3e", "ur5", "ur5e", "ur10", "ur10e", "ur16e"}) {
    SCOPED_TRACE(file);
    CalibratedModel model = model_of(load_robot(std::string(DEMECAL_SOURCE_DIR) + "/configs/robots/" + file + ".yaml"));
    disturb(model, stream, 1e-4);
    const std::string text = ur_calibration(model).text;
    const auto flange_on_wrist = [&](const JointVector& q) {
      const Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
      return Eigen::Isometry3d((base * pose_by_driver(text, q)).inverse() * forward(model.robot.chain, q));
    };
    const auto turned_on_wrist = [&](const JointVector& q) {
      const Eigen::Isometry3d half(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()));
      return Eigen::Isometry3d((half * pose_by_driver(text, q)).inverse() * forward(model.robot.chain, q));
    };
    const JointVector zero = JointVector::Zero(6);
    double straight = 0.0, turned = 0.0;
    for (int i = 0; i < 50; ++i) {
      const JointVector q = random_change(stream, 6, 3.0);
      straight =
          std::max(straight, (flange_on_wrist(q).matrix() - flange_on_wrist(zero).matrix()).cwiseAbs().maxCoeff());
      turned = std::max(turned, (turned_on_wrist(q).matrix() - turned_on_wrist(zero).matrix()).cwiseAbs().maxCoeff());
    }
    EXPECT_LT(std::min(straight, turned), 1e-10);
  }
}

TEST(UrCalibration, IsRefusedOfOtherArms) {
  const auto of = [](const char* file) {
    return complaint(
        [&] { ur_calibration(model_of(load_robot(std::string(DEMECAL_SOURCE_DIR) + "/configs/robots/" + file))); });
  };
  EXPECT_THAT(of("abb-irb120.yaml"), HasSubstr("is no arm of Universal Robots"));
  EXPECT_THAT(of("kuka-iiwa7.yaml"), HasSubstr("is no arm of Universal Robots"));
}

TEST(ExportedUrdf, SaysWhatTheSideOfApproachDoesThatLinksCannotHold) {
  const TemporaryFolder folder;
  CalibratedModel model = model_of(imported(folder, kUrdf));
  model.robot.effects = {{.kind = "backlash", .joint = 0, .values = {1e-3}}};
  const LinksAlone alone = links_alone(model, in_own_base(model));
  EXPECT_THAT(lacks_of_links(model, alone),
              Contains(testing::AllOf(HasSubstr("the tool is off by "), testing::Not(HasSubstr("by 0 mm")))));
}

TEST(ExportedUrdf, HasTheLinksThatComeNearestToWhatTheModelDoes) {
  const TemporaryFolder folder;
  CalibratedModel model = model_of(imported(folder, kUrdf));
  model.robot.effects = {{.kind = "gain", .joint = 0, .values = {1e-3}},
                         {.kind = "joint_offset", .joint = 1, .values = {2e-3}}};
  for (const Joint& joint : model.nominal.chain.joints)
    model.measured.push_back({std::max(joint.lower, -0.2), std::min(joint.upper, 0.9)});
  const LinksAlone nearest = links_alone(model, in_own_base(model));
  EXPECT_TRUE(nearest.fitted);
  EXPECT_LT(nearest.mean_m, 0.3e-3) << "links hold a zero whole, and of a gain what it is in the middle";
  EXPECT_GT(nearest.mean_m, 0.0);
  model.robot.effects.clear();
  const LinksAlone own = links_alone(model, in_own_base(model));
  EXPECT_FALSE(own.fitted);
  EXPECT_EQ(own.most_m, 0.0);
}

TEST(ExportedUrdf, SaysWhereTheBaseWasNotFitted) {
  const TemporaryFolder folder;
  CalibratedModel model = model_of(imported(folder, kUrdf));
  model.job = "a job";
  const auto said = Contains(HasSubstr("where it stands was not fitted"));
  const LinksAlone alone = links_alone(model, in_own_base(model));
  EXPECT_THAT(lacks_of_links(model, alone), said);
  model.declared.registration = true;
  EXPECT_THAT(lacks_of_links(model, alone), testing::Not(said));
}

}  // namespace
}  // namespace demecal
