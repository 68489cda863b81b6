#include "diagnosis/feasible_poses.hpp"

#include <algorithm>
#include <limits>

#include "effects/arm_state.hpp"
#include "errors/check.hpp"

namespace demecal {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kBelow_m = 0.05;
constexpr double kBeyond = 0.1;
constexpr double kFromLimits = 0.02;
constexpr int kAttempts = 500;

Eigen::Vector3d upwards(const Eigen::Vector3d& gravity_mps2) {
  if (gravity_mps2.isZero()) return Eigen::Vector3d::UnitZ();
  return -gravity_mps2.normalized();
}

/// Height of the lowest of the arm's joints but the first, and of its flange, m.
double lowest_of(const ArmState& state, const Eigen::Vector3d& up) {
  double lowest = kInfinite;
  for (std::size_t i = 1; i < state.places.size(); ++i)
    lowest = std::min(lowest, up.dot(state.places[i].translation()));
  return lowest;
}

}  // namespace

FeasiblePoses::FeasiblePoses(const DataSet& data, std::span<const std::size_t> poses)
    : data_(data),
      measured_(data.robot.chain.joints.size(), Interval{kInfinite, -kInfinite}),
      up_(upwards(data.robot.gravity_mps2)),
      lowest_tool_m_(kInfinite),
      lowest_m_(kInfinite),
      nearest_m_(kInfinite),
      farthest_m_(0.0) {
  DEMECAL_CHECK(!poses.empty(), "no poses");
  for (const std::size_t pose : poses) {
    const JointVector& joints = joints_.emplace_back(data.poses[pose].joints);
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      const double value = joints[static_cast<Eigen::Index>(i)];
      measured_[i] = {std::min(measured_[i].lower, value), std::max(measured_[i].upper, value)};
    }
    const ArmState state = arm_state(data.robot, Stop(joints));
    const double height = up_.dot(state.payload_point_m), reach = state.payload_point_m.norm();
    lowest_tool_m_ = std::min(lowest_tool_m_, height);
    lowest_m_ = std::min({lowest_m_, height, lowest_of(state, up_)});
    nearest_m_ = std::min(nearest_m_, reach);
    farthest_m_ = std::max(farthest_m_, reach);
  }
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    const Joint& joint = data.robot.chain.joints[i];
    const double margin = kFromLimits * (joint.upper - joint.lower);
    allowed_.push_back(margin > 0 ? Interval{joint.lower + margin, joint.upper - margin} : measured_[i]);
  }
}

bool FeasiblePoses::contains(const JointVector& joints) const {
  const ArmState state = arm_state(data_.robot, Stop(joints));
  const double reach = state.payload_point_m.norm();
  return up_.dot(state.payload_point_m) >= lowest_tool_m_ - kBelow_m && lowest_of(state, up_) >= lowest_m_ - kBelow_m &&
         reach <= (1.0 + kBeyond) * farthest_m_ && reach >= (1.0 - kBeyond) * nearest_m_;
}

JointVector FeasiblePoses::draw(const std::vector<Interval>& ranges, RandomStream& random) const {
  JointVector joints(static_cast<Eigen::Index>(ranges.size()));
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      joints[static_cast<Eigen::Index>(i)] = random.real(ranges[i].lower, ranges[i].upper);
    }
    if (contains(joints)) return joints;
  }
  return joints_[random.index(joints_.size())];
}

}  // namespace demecal
