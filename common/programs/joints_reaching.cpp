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
#include "kinematics/ended_inverse.hpp"
#include "kinematics/inverse.hpp"
#include "programs/nominal_joints.hpp"

namespace demecal::inline programs {
namespace {

constexpr double kAlike = 1e-3;            ///< rad or m
constexpr std::size_t kMostBranches = 16;  ///< that are looked for
constexpr double kRegular = 0.03;          ///< smallest singular value (lengths in m) of joints far from singular ones

/// By how much the Jacobian (lengths in m) can change at most for a change of six turning joints behind `held` others,
/// per rad: its derivatives by joint i of column j are no longer than the way from the farther joint to the tool, and 1
/// in its lower half; what the logarithm of the missing turn adds is below 3.
double most_curvature(const Chain& arm, int held) {
  double square = 0.0, way_m = arm.tool_m.norm() + arm.flange.translation().norm();
  for (int joint = arm.size() - 1; joint >= held; --joint) {
    const Joint& link = arm.joints[static_cast<std::size_t>(joint)];
    way_m += std::abs(link.a_m) + std::abs(link.d_m);
    square += (2.0 * (joint - held) + 1.0) * (way_m * way_m + 1.0);
  }
  return std::sqrt(square) + 3.0;
}

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
      : arm_(arm), model_(nominal_pose(arm)), tool_(tool), reference_(reference), held_(held) {
    const auto turns = [](const Joint& joint) { return is_revolute(joint); };
    const bool six_turn = arm.size() == held + 6 && std::all_of(arm.joints.begin() + held, arm.joints.end(), turns);
    if (!six_turn || !arm.couplings.empty()) return;
    curvature_ = most_curvature(arm, held);
    most_ = most_configurations(arm, reference);
  }

  std::vector<JointVector> all() {
    try_from(reference_);
    for (int index = 1; index <= kSearchStarts && !complete(); ++index) {
      try_from(search_start(arm_, index, reference_, held_));
    }
    // Neighbours of what was found: the wrist turned over, the elbow and the shoulder on their other side.
    for (std::size_t i = 0; i < found_.size() && arm_.size() - held_ >= 6 && !complete(); ++i) {
      try_mirrored(found_[i]);
    }
    return within_limits();
  }

 private:
  void try_from(const JointVector& start) {
    const auto known_end = [this](const JointVector& joints) { return leads_to_known(joints); };
    const InverseSolution solution = inverse_unless(known_end, model_, tool_, start, {.held = held_});
    if (solution.status != InverseStatus::converged) return;
    const auto same = [&](const JointVector& known) { return alike(arm_, known, solution.q); };
    if (std::any_of(found_.begin(), found_.end(), same)) return;
    found_.push_back(solution.q);
    basins_.push_back(0.0);
    if (curvature_ == 0.0) return;
    const double singular = inverse(model_, tool_, solution.q, {.held = held_}).smallest_singular;
    if (singular < kRegular) return;
    basins_.back() = singular / (3.0 * curvature_);
    ++regular_;
  }

  /// Whether no others can be found: as many regular configurations as there are leave no room for singular ones.
  bool complete() const { return found_.size() >= kMostBranches || regular_ >= most_; }

  /// Whether Newton's iteration from these joints converges to what was found, as it does from less than two thirds of
  /// the root's smallest singular value over the curvature (Rheinboldt, 1974; Traub and Wozniakowski, 1979).
  bool leads_to_known(const JointVector& joints) const {
    for (std::size_t i = 0; i < found_.size(); ++i) {
      double square = 0.0;
      const double allowed = basins_[i] * basins_[i];
      for (Eigen::Index joint = held_; joint < joints.size() && square < allowed; ++joint) {
        const double apart = wrap_near(joints[joint] - found_[i][joint], 0.0);
        square += apart * apart;
      }
      if (square < allowed) return true;
    }
    return false;
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
  double curvature_ = 0.0;            ///< 0: not of six turning joints
  std::size_t most_ = kMostBranches;  ///< regular ones that there can be
  std::size_t regular_ = 0;
  std::vector<JointVector> found_;
  std::vector<double> basins_;  ///< of each that was found: so near to it searches lead there
};

}  // namespace

std::vector<JointVector> joints_reaching(const Chain& arm, const Eigen::Isometry3d& tool, const JointVector& reference,
                                         int held) {
  return BranchSearch(arm, tool, reference, held).all();
}

}  // namespace demecal::inline programs
