#include "kinematics/chain.hpp"
#include "programs/configuration.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "kinematics/angles.hpp"
#include "kinematics/inverse.hpp"
#include "programs/nominal_joints.hpp"

namespace demecal::inline programs {
namespace {

constexpr double kAlike = 1e-3;            ///< rad or m
constexpr std::size_t kMostBranches = 16;  ///< that six revolute joints can have

/// Whether two joint positions are one but for whole turns.
bool alike(const Chain& arm, const JointVector& one, const JointVector& other) {
  for (Eigen::Index i = 0; i < one.size(); ++i) {
    const bool revolute = is_revolute(arm, i);
    const double difference = revolute ? wrap_near(one[i] - other[i], 0.0) : one[i] - other[i];
    if (std::abs(difference) > kAlike) return false;
  }
  return true;
}

class BranchSearch {
 public:
  BranchSearch(const Chain& arm, const Eigen::Isometry3d& tool, const JointVector& reference, int held)
      : arm_(arm), model_(nominal_pose(arm)), tool_(tool), reference_(reference), held_(held) {}

  std::vector<JointVector> all() {
    try_from(reference_);
    for (int index = 1; index <= kSearchStarts && found_.size() < kMostBranches; ++index) {
      try_from(search_start(arm_, index, reference_, held_));
    }
    // Neighbours of what was found: the wrist turned over, the elbow and the shoulder on their other side.
    for (std::size_t i = 0; i < found_.size() && arm_.size() - held_ >= 6 && found_.size() < kMostBranches; ++i) {
      try_mirrored(found_[i]);
    }
    return within_limits();
  }

 private:
  void try_from(const JointVector& start) {
    const InverseSolution solution = inverse(model_, tool_, start, {.held = held_});
    if (solution.status != InverseStatus::converged) return;
    const auto same = [&](const JointVector& known) { return alike(arm_, known, solution.q); };
    if (std::none_of(found_.begin(), found_.end(), same)) found_.push_back(solution.q);
  }

  void try_mirrored(const JointVector& joints) {
    constexpr double kHalf = std::numbers::pi;
    const Eigen::Index last = joints.size() - 1;
    JointVector wrist = joints, elbow = joints, shoulder = joints;
    wrist[last - 2] += kHalf;
    wrist[last - 1] *= -1.0;
    wrist[last] += kHalf;
    elbow[held_ + 2] = kHalf - elbow[held_ + 2];
    shoulder[held_] += kHalf;
    for (const JointVector& start : {wrist, elbow, shoulder}) try_from(start);
  }

  bool outside(const JointVector& joints) const {
    for (Eigen::Index i = 0; i < joints.size(); ++i) {
      if (beyond_limits(arm_.joints[static_cast<std::size_t>(i)], joints[i]) > 0.0) return true;
    }
    return false;
  }

  std::vector<JointVector> within_limits() {
    for (JointVector& joints : found_) {
      for (Eigen::Index i = 0; i < joints.size(); ++i) {
        joints[i] = nearest_turn(arm_.joints[static_cast<std::size_t>(i)], joints[i], reference_[i]);
      }
    }
    std::vector<JointVector> inside = found_;
    std::erase_if(inside, [&](const JointVector& joints) { return outside(joints); });
    return inside.empty() ? found_ : inside;
  }

  const Chain& arm_;
  PoseFunction model_;
  const Eigen::Isometry3d& tool_;
  const JointVector& reference_;
  int held_;
  std::vector<JointVector> found_;
};

}  // namespace

std::vector<JointVector> joints_reaching(const Chain& arm, const Eigen::Isometry3d& tool, const JointVector& reference,
                                         int held) {
  return BranchSearch(arm, tool, reference, held).all();
}

}  // namespace demecal::inline programs
