#include "library/conversion.hpp"

#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>

#include "errors/input_error.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline library {
namespace {

JointVector to_joints(const std::vector<double>& values, const Chain& chain) {
  if (std::ssize(values) != chain.size()) {
    throw InputError({}, std::to_string(values.size()) + " values",
                     "the arm has " + std::to_string(chain.size()) + " joints");
  }
  for (const double value : values) {
    if (!std::isfinite(value)) throw InputError({}, std::to_string(value), "the value of a joint must be finite");
  }
  return joints_from_deg_or_mm(chain, values);
}

}  // namespace

Stop to_stop(const JointCommand& command, const Chain& chain) {
  Stop stop(to_joints(command.joints, chain));
  if (!command.approach.empty()) {
    if (std::ssize(command.approach) != chain.size())
      throw InputError({}, std::to_string(command.approach.size()) + " approach signs", "must be one per joint");
    stop.approach = ApproachSigns(chain.size());
    for (int joint = 0; joint < chain.size(); ++joint) {
      const int sign = command.approach[static_cast<std::size_t>(joint)];
      if (sign < -1 || sign > 1) throw InputError({}, std::to_string(sign), "an approach sign is -1, 0 or 1");
      stop.approach[joint] = sign;
    }
  }
  stop.payload_kg = command.payload_kg;
  stop.temperature_celsius = command.temperature_celsius;
  stop.time_s = command.time_s;
  return stop;
}

std::vector<double> to_deg_or_mm(const JointVector& joints, const Chain& chain) {
  std::vector<double> values;
  for (int joint = 0; joint < chain.size(); ++joint) {
    const bool revolute = is_revolute(chain, joint);
    values.push_back(revolute ? degrees(joints[joint]) : millimetres(joints[joint]));
  }
  return values;
}

ToolPose to_tool_pose(const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d position_m = pose.translation();
  const Eigen::Quaterniond turn(pose.linear());
  return {{millimetres(position_m.x()), millimetres(position_m.y()), millimetres(position_m.z())},
          {turn.w(), turn.x(), turn.y(), turn.z()}};
}

PoseUse to_pose_use(PoseSet set) {
  switch (set) {
    case PoseSet::calibration:
      return PoseUse::calibration;
    case PoseSet::validation:
      return PoseUse::validation;
    case PoseSet::accept:
      break;
  }
  return PoseUse::accept;
}

PoseSet to_pose_set(PoseUse use) {
  switch (use) {
    case PoseUse::calibration:
      return PoseSet::calibration;
    case PoseUse::validation:
      return PoseSet::validation;
    case PoseUse::accept:
      break;
  }
  return PoseSet::accept;
}

}  // namespace demecal::inline library
