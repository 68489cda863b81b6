#include "programs/configuration.hpp"

#include <algorithm>

#include "programs/branches.hpp"

namespace demecal {
namespace {

double farthest_joint(const JointVector& one, const JointVector& other) {
  return (one - other).cwiseAbs().maxCoeff();
}

/// Leaves those that are about as near to `reference` as the nearest, the nearest first. The joints of arms with more
/// than six are a matter of their controllers: all are left.
void keep_nearest(std::vector<JointVector>& joints, const JointVector& reference) {
  constexpr double kFactor = 1.5, kMargin = 0.2;  ///< rad or m
  std::stable_sort(joints.begin(), joints.end(), [&](const JointVector& one, const JointVector& other) {
    return farthest_joint(one, reference) < farthest_joint(other, reference) - 1e-9;
  });
  if (joints.empty() || reference.size() > 6) return;
  const double allowed = kFactor * farthest_joint(joints.front(), reference) + kMargin;
  std::erase_if(joints, [&](const JointVector& candidate) { return farthest_joint(candidate, reference) > allowed; });
}

/// Leaves those that contradict what is stated least.
void keep_stated(std::vector<JointVector>& joints, const ArmHint& hint) {
  int least = kMaxJoints;
  for (const JointVector& candidate : joints) least = std::min(least, contradictions(hint, candidate));
  std::erase_if(joints, [&](const JointVector& candidate) { return contradictions(hint, candidate) > least; });
}

Configurations settled(std::vector<JointVector> joints, JointsFrom from) {
  if (joints.empty()) return {};
  return {joints.size() == 1 ? from : JointsFrom::undetermined, std::move(joints)};
}

}  // namespace

std::string_view word_of(JointsFrom from) {
  switch (from) {
    case JointsFrom::target:
      return "joint_target";
    case JointsFrom::stated:
      return "stated";
    case JointsFrom::line:
      return "straight_line";
    case JointsFrom::before:
      return "joints_before";
    case JointsFrom::given:
      return "near_option";
    case JointsFrom::only:
      return "only_one";
    case JointsFrom::undetermined:
      return "undetermined";
    case JointsFrom::nowhere:
      break;
  }
  return "none";
}

Configurations ConfigurationFinder::find(const Chain& arm, const Target& target, const Eigen::Isometry3d& tool) const {
  const ArmHint& hint = target.hint;
  const bool named = hint.near.size() == arm.size();
  const bool given = near_.size() == arm.size();
  const bool states = !hint.quadrants.empty() || !hint.negative.empty();
  if (!named && !states && present_ && target.motion == Motion::line) {
    if (auto end = joints_after_line(arm, *present_, tool)) return {JointsFrom::line, {std::move(*end)}};
  }
  const JointVector& reference = named ? hint.near : present_ ? *present_ : given ? near_ : middle_;
  std::vector<JointVector> joints = joints_reaching(arm, tool, reference);
  for (JointVector& candidate : joints) candidate = in_hinted_turns(arm, candidate, hint, reference);
  if (states) keep_stated(joints, hint);
  if (joints.size() <= 1) return settled(std::move(joints), states ? JointsFrom::stated : JointsFrom::only);
  if (!named && !present_ && !given) return {JointsFrom::undetermined, std::move(joints)};
  keep_nearest(joints, reference);
  return settled(std::move(joints), named ? JointsFrom::stated : present_ ? JointsFrom::before : JointsFrom::given);
}

}  // namespace demecal
