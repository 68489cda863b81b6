#include "report/pose_places.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "report/make_report.hpp"

namespace demecal::inline report {
namespace {

/// To a millionth of the border's unit: what pictures and tables need, in few digits.
double rounded(double value) {
  constexpr double kSteps = 1e6;
  return std::round(kSteps * value) / kSteps + 0.0;
}

std::vector<double> in_mm(const Eigen::Vector3d& vector_m) {
  std::vector<double> numbers;
  for (const double component : vector_m) numbers.push_back(rounded(millimetres(component)));
  return numbers;
}

PlacementNumbers placement(const Eigen::Isometry3d& pose) {
  PlacementNumbers numbers;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) numbers.push_back(rounded(pose.linear()(row, column)));
    numbers.push_back(rounded(millimetres(pose.translation()[row])));
  }
  return numbers;
}

}  // namespace

PosePlace pose_place(const DataSet& data, const MeasuredPose& pose, const CorrectedRobot& before,
                     const CorrectedRobot& after) {
  PosePlace place;
  for (int joint = 0; joint < pose.joints.size(); ++joint) {
    const bool turns = data.robot.chain.joints[static_cast<std::size_t>(joint)].type == JointType::revolute;
    place.joints.push_back(rounded(turns ? degrees(pose.joints[joint]) : millimetres(pose.joints[joint])));
  }
  place.temperature_celsius = pose.temperature_celsius;
  place.time_s = pose.time_s;
  if (!pose.position_m) return place;
  const Stop stop(pose);
  place.position_mm = in_mm(*pose.position_m);
  place.before_error_mm = in_mm(measured_point(before, pose) - before.predict(stop, pose.target).translation());
  place.after_error_mm = in_mm(measured_point(after, pose) - after.predict(stop, pose.target).translation());
  return place;
}

ArmEntry arm_entry(const CorrectedRobot& robot, const std::string& target) {
  ArmEntry arm;
  arm.base = placement(robot.sensor_from_base);
  arm.tool_mm = in_mm(robot.tool(target).translation());
  Eigen::Isometry3d last = Eigen::Isometry3d::Identity();
  walk(
      robot.chain, JointVector::Zero(robot.chain.size()), [](int, LinkParameter, const Screw&) {},
      [&](int joint, const Eigen::Isometry3d& frame) {
        const PlacementNumbers here = placement(last.inverse() * frame);
        last = frame;
        if (joint == robot.chain.size()) {
          arm.flange = here;
          return;
        }
        const bool turns = robot.chain.joints[static_cast<std::size_t>(joint)].type == JointType::revolute;
        arm.joints.push_back({turns ? "revolute" : "prismatic", here});
      });
  for (const CommandCoupling& coupling : robot.chain.couplings)
    arm.couplings.push_back({static_cast<std::uint64_t>(coupling.joint) + 1,
                             static_cast<std::uint64_t>(coupling.from) + 1, coupling.factor});
  return arm;
}

}  // namespace demecal::inline report
