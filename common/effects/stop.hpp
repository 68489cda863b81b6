// One stop of the robot: where it was commanded, and the circumstances that its errors depend on.
#pragma once

#include <optional>

#include "data/data_set.hpp"

namespace demecal {

struct Stop {
  JointVector joints;                           ///< commanded, rad or m
  ApproachSigns approach;                       ///< -1, 0 or +1 per joint; empty: unknown, taken as 0
  double payload_kg = 0.0;                      ///< at the tool point
  std::optional<double> temperature_celsius{};  ///< none: effects take the arm to be at their reference
  std::optional<double> time_s{};               ///< none: effects take the stop to be at their reference

  /// A command alone: no approach, nothing carried, nothing known of warmth and time.
  Stop(JointVector commanded) : joints(std::move(commanded)) {}  // NOLINT(google-explicit-constructor)
  /// The same of an expression such as a sum of joint vectors.
  template <typename Joints>
  Stop(const Eigen::MatrixBase<Joints>& commanded) : joints(commanded) {}  // NOLINT(google-explicit-constructor)
  explicit Stop(const MeasuredPose& pose);

  /// The same circumstances at other joints.
  Stop with_joints(const JointVector& commanded) const;
};

}  // namespace demecal
