// Imported arms stand where the poses of urdfdom, put together joint by joint, have them; every public arm at hand, and
// made-up ones.
#include <gtest/gtest.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "kinematics/drawn_arm.hpp"
#include "kinematics/forward.hpp"
#include "random/random_stream.hpp"
#include "small_urdf.hpp"

namespace demecal {
namespace {

Eigen::Isometry3d eigen(const ::urdf::Pose& pose) {
  const ::urdf::Rotation& r = pose.rotation;
  return Eigen::Translation3d(pose.position.x, pose.position.y, pose.position.z) *
         Eigen::Quaterniond(r.w, r.x, r.y, r.z);
}

/// The pose of `tip` in `base` by urdfdom's model, joints not named at 0.
Eigen::Isometry3d pose_by_urdfdom(const ::urdf::ModelInterface& model, const std::string& base, const std::string& tip,
                                  const std::map<std::string, double>& values) {
  const auto in_root = [&](const std::string& link) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (auto joint = model.getLink(link)->parent_joint; joint;
         joint = model.getLink(joint->parent_link_name)->parent_joint) {
      const auto value = values.find(joint->name);
      const double q = value == values.end() ? 0.0 : value->second;
      const Eigen::Vector3d axis = Eigen::Vector3d(joint->axis.x, joint->axis.y, joint->axis.z).normalized();
      Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
      if (joint->type == ::urdf::Joint::PRISMATIC) motion.translate(q * axis);
      if (joint->type == ::urdf::Joint::REVOLUTE || joint->type == ::urdf::Joint::CONTINUOUS)
        motion.rotate(Eigen::AngleAxisd(q, axis));
      pose = eigen(joint->parent_to_joint_origin_transform) * motion * pose;
    }
    return pose;
  };
  return in_root(base).inverse() * in_root(tip);
}

void expect_same_poses(const std::string& text, const std::optional<std::string>& base,
                       const std::optional<std::string>& tip, RandomStream& stream) {
  const auto model = ::urdf::parseURDF(text);
  ASSERT_TRUE(model);
  const UrdfFile urdf = parse_urdf(text, "arm.urdf");
  const UrdfArm arm = arm_between(urdf, base, tip);
  const Chain chain = equivalent_chain(arm.drawing).chain;
  for (int which = 0; which < 50; ++which) {
    JointVector q(chain.size());
    std::map<std::string, double> values;
    for (int i = 0; i < chain.size(); ++i) {
      q[i] = stream.real(-3.0, 3.0);
      values[arm.joints[static_cast<std::size_t>(i)]->name] = q[i];
    }
    const Eigen::Isometry3d expected = pose_by_urdfdom(*model, arm.base, arm.tip, values), pose = forward(chain, q);
    EXPECT_LT((pose.translation() - expected.translation()).norm(), 1e-9);
    EXPECT_LT((pose.linear() - expected.linear()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(UrdfArm, OfEveryPublicFileStandsWhereUrdfdomHasIt) {
  const std::filesystem::path folder = std::filesystem::path(DEMECAL_SOURCE_DIR) / "../shared/data/urdf";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs " << folder;
  RandomStream stream{1821};
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".urdf") continue;
    SCOPED_TRACE(entry.path().filename());
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const bool two_ends = entry.path().filename() == "iiwa14_no_collision.urdf";
    expect_same_poses(text.str(), std::nullopt, two_ends ? std::optional("iiwa_link_ee") : std::nullopt, stream);
    ++files;
  }
  EXPECT_GE(files, 20);
}

std::string random_triple(RandomStream& stream, double size) {
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < 3; ++i) text << (i == 0 ? "" : "  ") << (stream.chance(0.3) ? 0.0 : stream.real(-size, size));
  return text.str();
}

/// Links l0, l1, ... in a row.
std::string random_row(RandomStream& stream, int joints) {
  std::string xml = link_xml("l0");
  constexpr std::array kTypes{"revolute", "continuous", "prismatic", "fixed", "revolute"};
  for (int i = 1; i <= joints; ++i) {
    const std::string own = std::to_string(i), before = std::to_string(i - 1);
    std::string inside = "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";
    if (stream.chance(0.8))
      inside += "<origin rpy='" + random_triple(stream, 9) + "' xyz='" + random_triple(stream, 1) + "'/>";
    if (stream.chance(0.7)) inside += "<axis xyz=\"" + random_triple(stream, 2) + " \"/>";
    if (inside.find("xyz=\"0  0  0 \"") != std::string::npos) inside = "";
    xml += link_xml("l" + own) + joint_xml("j" + own, inside.empty() ? "fixed" : kTypes[stream.index(kTypes.size())],
                                           "l" + before, "l" + own, inside);
  }
  return robot_xml(xml);
}

TEST(UrdfArm, OfMadeUpRowsOfJointsStandsWhereUrdfdomHasIt) {
  RandomStream stream{1822};
  int accepted = 0;
  for (int which = 0; which < 200; ++which) {
    const std::string text = random_row(stream, 2 + static_cast<int>(stream.index(7)));
    SCOPED_TRACE(text);
    if (complaint_of(text) != "accepted") continue;
    expect_same_poses(text, std::nullopt, std::nullopt, stream);
    ++accepted;
  }
  EXPECT_GT(accepted, 180);
}

TEST(UrdfArm, BeginsAtALinkThatIsFixedBesideTheArmAndEndsInTheMiddle) {
  RandomStream stream{1823};
  const std::string text = two_joints(
      link_xml("stand") + joint_xml("mount", "fixed", "base", "stand", "<origin xyz=\"1 2 3\" rpy=\"0.1 0.2 0.3\"/>"));
  expect_same_poses(text, "stand", "b", stream);
  expect_same_poses(text, "stand", "tip", stream);
  expect_same_poses(text, "a", "tip", stream);
}

}  // namespace
}  // namespace demecal
