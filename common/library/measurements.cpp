#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data/read_poses.hpp"
#include "data/text.hpp"
#include "data_check/check_data.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "effects/arm_state.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "library/conversion.hpp"
#include "library/demecal.hpp"
#include "random/random_stream.hpp"
#include "trials/finding.hpp"
#include "yaml/files.hpp"

namespace demecal::inline library {
namespace {

Eigen::Vector3d to_metres(const std::array<double, 3>& point_mm) {
  return metres(1.0) * Eigen::Vector3d(point_mm[0], point_mm[1], point_mm[2]);
}

Joint to_joint(const ArmLink& link) {
  Joint joint;
  joint.type = link.prismatic ? JointType::prismatic : JointType::revolute;
  joint.alpha_rad = radians(link.alpha_deg);
  joint.a_m = metres(link.a_mm);
  joint.d_m = metres(link.d_mm);
  joint.theta_rad = radians(link.theta_offset_deg);
  joint.lower = link.prismatic ? metres(link.lower) : radians(link.lower);
  joint.upper = link.prismatic ? metres(link.upper) : radians(link.upper);
  if (!(joint.lower < joint.upper))
    throw InputError({}, number_text(link.lower), "the lower limit of a joint must be below the upper one");
  return joint;
}

Robot to_robot(const ArmDescription& description) {
  const std::size_t joints = description.links.size();
  if (joints == 0 || joints > static_cast<std::size_t>(kMaxJoints)) {
    throw InputError({}, std::to_string(joints) + " links",
                     "an arm has from 1 to " + std::to_string(kMaxJoints) + " joints");
  }
  Robot robot;
  robot.name = description.name;
  robot.chain.convention = description.modified_dh ? Convention::modified_dh : Convention::standard_dh;
  robot.chain.tool_m = to_metres(description.tool_mm);
  for (const ArmLink& link : description.links) {
    robot.chain.joints.push_back(to_joint(link));
    robot.masses.push_back({link.mass_kg, to_metres(link.centre_of_mass_mm)});
  }
  if (std::ranges::all_of(robot.masses, [](const LinkMass& link) { return link.mass_kg == 0.0; })) robot.masses.clear();
  return robot;
}

/// Row `number`, from 1.
MeasuredPose to_pose(const PoseMeasurement& measured, const Chain& chain, std::size_t number) {
  const Stop stop = to_stop(measured.command, chain);
  MeasuredPose pose;
  pose.joints = stop.joints;
  if (!measured.command.approach.empty()) pose.approach = stop.approach;
  if (stop.payload_kg != 0.0) pose.payload_kg = stop.payload_kg;
  pose.temperature_celsius = stop.temperature_celsius;
  pose.time_s = stop.time_s;
  pose.position_m = to_metres(measured.position_mm);
  if (!pose.position_m->allFinite()) throw InputError({"measurements", number}, "", "a position must be finite");
  if (measured.quaternion_wxyz) {
    const auto& q = *measured.quaternion_wxyz;
    const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
    if (!(std::abs(turn.norm() - 1.0) < 1e-3))
      throw InputError({"measurements", number}, number_text(turn.norm()), "a quaternion must be of unit length");
    pose.orientation = turn.normalized();
  }
  if (measured.use) pose.set = to_pose_set(*measured.use);
  pose.pose_id = measured.id.empty() ? "P" + std::to_string(number) : measured.id;
  pose.line = number;
  return pose;
}

/// Payloads are of all poses or of none: one that is told nowhere is not known to be 0 kg.
void share_payloads(std::vector<MeasuredPose>& poses) {
  if (std::ranges::none_of(poses, [](const MeasuredPose& pose) { return pose.payload_kg.has_value(); })) return;
  for (MeasuredPose& pose : poses) pose.payload_kg = pose.payload_kg.value_or(0.0);
}

/// By which models name the measurements that they were made from.
std::string poses_sha256(const std::vector<MeasuredPose>& poses) {
  std::string text;
  for (const MeasuredPose& pose : poses) {
    for (const double joint : pose.joints) text += number_text(joint) + ' ';
    for (const double length_m : *pose.position_m) text += number_text(length_m) + ' ';
    text += pose.pose_id + '\n';
  }
  return sha256(text);
}

DataSet to_data_set(const Robot& robot, const std::vector<PoseMeasurement>& measured, bool in_base_frame) {
  DataSet data;
  data.name = data.file = "measurements";
  data.robot = robot;
  data.frame = in_base_frame ? Frame::base : Frame::sensor;
  for (const PoseMeasurement& one : measured) data.poses.push_back(to_pose(one, robot.chain, data.poses.size() + 1));
  if (data.poses.empty()) throw InputError({data.file, 0}, "", "there is no pose");
  share_payloads(data.poses);
  data.sha256 = poses_sha256(data.poses);
  if (std::ranges::none_of(measured, [](const PoseMeasurement& one) { return one.use.has_value(); })) {
    RandomStream random{1};
    split_by_pose(data.poses, {}, [&random](std::size_t n) { return random.index(n); });
  }
  check_repeats(data.poses, data.file);
  return data;
}

}  // namespace

std::shared_ptr<const Measurements::Implementation> checked_measurements(DataSet data) {
  auto measured = std::make_shared<Measurements::Implementation>();
  measured->data = std::move(data);
  measured->check = check_without_copies(measured->data);
  for (const Finding& finding : measured->check.findings) measured->findings.push_back(finding.sentence);
  return measured;
}

Arm Arm::load(const std::filesystem::path& robot_file) {
  return Arm(std::make_shared<Implementation>(Implementation{load_robot(robot_file)}));
}

Arm::Arm(const ArmDescription& description)
    : implementation_(std::make_shared<Implementation>(Implementation{to_robot(description)})) {}

Arm::Arm(std::shared_ptr<const Implementation> implementation) : implementation_(std::move(implementation)) {}

std::string Arm::name() const {
  return implementation_->robot.name;
}

int Arm::joints() const {
  return implementation_->robot.chain.size();
}

ToolPose Arm::pose(const std::vector<double>& joints) const {
  const Chain& chain = implementation_->robot.chain;
  const Stop stop = to_stop({.joints = joints}, chain);
  return to_tool_pose(forward(chain, stop.joints) * Eigen::Translation3d(chain.tool_m));
}

Measurements Measurements::load(const std::filesystem::path& dataset_file) {
  return Measurements(checked_measurements(load_data_set(dataset_file)));
}

Measurements::Measurements(const Arm& arm, const std::vector<PoseMeasurement>& poses, bool in_base_frame)
    : implementation_(checked_measurements(to_data_set(arm.implementation().robot, poses, in_base_frame))) {}

Measurements::Measurements(std::shared_ptr<const Implementation> implementation)
    : implementation_(std::move(implementation)) {}

Arm Measurements::arm() const {
  return Arm(std::make_shared<Arm::Implementation>(Arm::Implementation{implementation_->data.robot}));
}

std::size_t Measurements::size() const {
  return implementation_->data.poses.size();
}

std::size_t Measurements::count(PoseUse use) const {
  return poses_of(implementation_->data, to_pose_set(use)).size();
}

const std::vector<std::string>& Measurements::findings() const {
  return implementation_->findings;
}

bool Measurements::contradict_arm() const {
  return implementation_->check.verdict() == DataVerdict::contradiction;
}

}  // namespace demecal::inline library
