#include "programs/configuration.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <sstream>

#include "kinematics/angles.hpp"
#include "kinematics/inverse.hpp"
#include "parsed_programs/program_text.hpp"
#include "programs/nominal_joints.hpp"

namespace demecal::inline programs {
namespace {

double farthest_joint(const JointVector& one, const JointVector& other) {
  return (one - other).cwiseAbs().maxCoeff();
}

/// Leaves those that are about as near to `reference` as the nearest, the nearest first. The joints of arms with more
/// than six are a matter of their controllers: all are left.
void keep_nearest(std::vector<JointVector>& joints, const JointVector& reference, int held) {
  constexpr double kFactor = 1.5, kMargin = 0.2;  ///< rad or m
  std::stable_sort(joints.begin(), joints.end(), [&](const JointVector& one, const JointVector& other) {
    return farthest_joint(one, reference) < farthest_joint(other, reference) - 1e-9;
  });
  if (joints.empty() || reference.size() - held > 6) return;
  const double allowed = kFactor * farthest_joint(joints.front(), reference) + kMargin;
  std::erase_if(joints, [&](const JointVector& candidate) { return farthest_joint(candidate, reference) > allowed; });
}

/// Leaves the one that is so near to `reference` that no other can be meant, where there is one.
bool keep_adjacent(std::vector<JointVector>& joints, const JointVector& reference) {
  constexpr double kNear = 0.5, kFactor = 2.0, kMargin = 0.6;  ///< rad or m
  std::stable_sort(joints.begin(), joints.end(), [&](const JointVector& one, const JointVector& other) {
    return farthest_joint(one, reference) < farthest_joint(other, reference) - 1e-9;
  });
  const double nearest = farthest_joint(joints.front(), reference);
  if (nearest > kNear || farthest_joint(joints[1], reference) <= kFactor * nearest + kMargin) return false;
  joints.resize(1);
  return true;
}

/// Leaves those of the posture of `known`, where postures can be told.
bool keep_posture(const Chain& arm, std::vector<JointVector>& joints, const JointVector& known) {
  std::vector<JointVector> kept;
  for (const JointVector& candidate : joints) {
    const std::optional<bool> same = same_posture(arm, candidate, known);
    if (!same) return false;
    if (*same) kept.push_back(candidate);
  }
  if (kept.size() != 1) return false;
  joints = std::move(kept);
  return true;
}

/// Leaves those that have the part on the side that it is on at `known`; false: sides cannot be told.
bool keep_side(const Chain& arm, std::vector<JointVector>& joints, const JointVector& known, std::size_t part) {
  std::vector<JointVector> kept;
  for (const JointVector& candidate : joints) {
    const std::optional<bool> same = same_side(arm, candidate, known, part);
    if (!same) return false;
    if (*same) kept.push_back(candidate);
  }
  joints = std::move(kept);
  return true;
}

/// The words of shoulder, elbow and wrist, a blank between them.
std::vector<std::string> words_of_parts(const std::string& words) {
  std::istringstream stream(words);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Leaves those that contradict what is stated least.
void keep_stated(std::vector<JointVector>& joints, const ArmHint& hint) {
  int least = kMaxJoints;
  for (const JointVector& candidate : joints) least = std::min(least, contradictions(hint, candidate));
  std::erase_if(joints, [&](const JointVector& candidate) { return contradictions(hint, candidate) > least; });
}

/// The words that state shoulder, elbow and wrist, without the numbers of turns behind them: "NUT" of "NUT,0,0,-1", and
/// the first three of the numbers of a Yaskawa job.
std::string_view without_turns(std::string_view words) {
  std::size_t end = words.find(',');
  const bool numbers = !words.empty() && is_digit(words.front());
  for (int i = 1; i < 3 && numbers && end != std::string_view::npos; ++i) end = words.find(',', end + 1);
  return words.substr(0, end);
}

/// In the whole turns that words state.
Configurations in_stated_turns(Configurations found, const ArmHint& hint) {
  for (JointVector& joints : found.joints) {
    for (Eigen::Index i = 0; i < std::min(joints.size(), std::ssize(hint.turns)); ++i) {
      const std::optional<int> turn = hint.turns[static_cast<std::size_t>(i)];
      if (turn) joints[i] = wrap_near(joints[i], 2.0 * std::numbers::pi * *turn);
    }
  }
  return found;
}

Configurations settled(std::vector<JointVector> joints, JointsFrom from) {
  if (joints.empty()) return {};
  return {joints.size() == 1 ? from : JointsFrom::undetermined, std::move(joints)};
}

}  // namespace

std::optional<JointVector> joints_after_line(const Chain& arm, const JointVector& from, const Eigen::Isometry3d& tool,
                                             int held) {
  constexpr double kStep_m = 0.02, kStep_rad = 0.05, kLeap = 0.3, kMostSteps = 500.0;
  const PoseFunction model = nominal_pose(arm);
  const Eigen::Isometry3d start = model(from).pose;
  const PoseError way = pose_error(start, tool);
  const double needed = std::max(way.head<3>().norm() / kStep_m, way.tail<3>().norm() / kStep_rad);
  const int steps = static_cast<int>(std::ceil(std::clamp(needed, 1.0, kMostSteps)));
  const double angle = way.tail<3>().norm();
  const Eigen::Vector3d axis = angle > 0.0 ? Eigen::Vector3d(way.tail<3>() / angle) : Eigen::Vector3d::UnitZ();
  JointVector joints = from;
  for (int step = 1; step <= steps; ++step) {
    const double share = static_cast<double>(step) / steps;
    Eigen::Isometry3d ahead(Eigen::AngleAxisd(share * angle, axis).toRotationMatrix() * start.linear());
    ahead.translation() = start.translation() + share * way.head<3>();
    const InverseSolution solution = inverse(model, step == steps ? tool : ahead, joints, {.held = held});
    if (solution.status != InverseStatus::converged) return std::nullopt;
    if ((solution.q - joints).cwiseAbs().maxCoeff() > kLeap) return std::nullopt;
    joints = solution.q;
  }
  return joints;
}

std::string_view to_string(JointsFrom from) {
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

void ConfigurationFinder::arrive(std::optional<JointVector> joints, const std::string& configuration) {
  if (joints && !configuration.empty()) worded_.insert_or_assign(configuration, *joints);
  present_ = std::move(joints);
  present_words_ = configuration;
}

Configurations ConfigurationFinder::find_worded(const Chain& arm, const std::string& words,
                                                const Eigen::Isometry3d& tool) const {
  const auto known = worded_.find(words);
  const bool present = present_ && (present_words_.empty() || present_words_ == words);
  const bool given = !present_ && near_.size() == arm.size();
  const JointVector& reference = present ? *present_ : known != worded_.end() ? known->second : given ? near_ : middle_;
  std::vector<JointVector> joints = joints_reaching(arm, tool, reference, held_);
  if (joints.size() <= 1) return settled(std::move(joints), JointsFrom::only);
  if (known != worded_.end() && keep_posture(arm, joints, known->second)) return {JointsFrom::stated, joints};
  if (present && keep_adjacent(joints, *present_)) return {JointsFrom::before, joints};
  if (known != worded_.end() && keep_adjacent(joints, known->second)) return {JointsFrom::stated, joints};
  if (given && keep_adjacent(joints, near_)) return {JointsFrom::given, joints};
  return {JointsFrom::undetermined, joints};
}

/// Joints that were reached in a configuration with this word for the part.
std::optional<JointVector> ConfigurationFinder::joints_with(const std::string& word, std::size_t part) const {
  for (const auto& [words, joints] : worded_) {
    const std::vector<std::string> each = words_of_parts(words);
    if (part < each.size() && each[part] == word) return joints;
  }
  return std::nullopt;
}

Configurations ConfigurationFinder::find_by_parts(const Chain& arm, const std::vector<PartHint>& parts,
                                                  const Eigen::Isometry3d& tool) const {
  const bool given = !present_ && near_.size() == arm.size();
  const std::optional<JointVector> before = given ? std::optional(near_) : present_;
  const JointsFrom from = given ? JointsFrom::given : JointsFrom::before;
  const std::vector<JointVector> all = joints_reaching(arm, tool, before.value_or(middle_), held_);
  if (all.size() <= 1) return settled(all, JointsFrom::only);
  std::vector<JointVector> joints = all;
  bool told = true, kept = false;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (parts[part].word.empty() && !parts[part].kept) continue;
    const std::optional<JointVector> known = parts[part].kept ? before : joints_with(parts[part].word, part);
    told = known && keep_side(arm, joints, *known, part) && told;
    kept = kept || parts[part].kept;
  }
  if (joints.empty()) return {JointsFrom::undetermined, all};
  if (joints.size() == 1) return {kept ? from : JointsFrom::stated, joints};
  if (!before) return {JointsFrom::undetermined, joints};
  if (told) {
    keep_nearest(joints, *before, held_);
  } else {
    keep_adjacent(joints, *before);
  }
  return settled(std::move(joints), from);
}

/// Whether the hint states another configuration than that which the arm is in now.
bool ConfigurationFinder::states_others(const ArmHint& hint) const {
  if (present_words_.empty()) return false;
  if (hint.parts.empty()) return present_words_ != hint.configuration;
  const std::vector<std::string> words = words_of_parts(present_words_);
  for (std::size_t part = 0; part < hint.parts.size(); ++part) {
    const std::string& word = hint.parts[part].word;
    if (!word.empty() && (part >= words.size() || words[part] != word)) return true;
  }
  return false;
}

/// The same with rails where these have them, so that all joints that it knows differ in the arm's alone.
ConfigurationFinder ConfigurationFinder::carried_to(const std::vector<Cell>& rails) const {
  ConfigurationFinder carried = *this;
  carried.held_ = static_cast<int>(rails.size());
  const auto carry = [&](JointVector& joints) {
    for (Eigen::Index i = 0; i < std::min(joints.size(), std::ssize(rails)); ++i)
      joints[i] = rails[static_cast<std::size_t>(i)].inside();
  };
  carry(carried.near_);
  carry(carried.middle_);
  if (carried.present_) carry(*carried.present_);
  for (auto& [words, joints] : carried.worded_) carry(joints);
  return carried;
}

Configurations ConfigurationFinder::find(const Chain& arm, const Target& target, const Eigen::Isometry3d& tool) const {
  return (target.carried.empty() ? *this : carried_to(target.carried)).find_carried(arm, target, tool);
}

Configurations ConfigurationFinder::find_carried(const Chain& arm, const Target& target,
                                                 const Eigen::Isometry3d& tool) const {
  Configurations found = find_any(arm, target, tool);
  const std::string& words = target.hint.configuration;
  if (words.empty() || found.joints.size() != 1 || found.from == JointsFrom::undetermined) return found;
  for (const auto& [other, joints] : worded_) {
    if (without_turns(other) == without_turns(words)) continue;
    if (same_posture(arm, found.joints.front(), joints).value_or(false)) found.contradicted_by = other;
  }
  return found;
}

Configurations ConfigurationFinder::find_any(const Chain& arm, const Target& target,
                                             const Eigen::Isometry3d& tool) const {
  const ArmHint& hint = target.hint;
  const bool named = hint.near.size() == arm.size();
  const bool given = near_.size() == arm.size();
  const bool states = !hint.quadrants.empty() || !hint.negative.empty();
  const bool goes_on = !states || !hint.counts_on_lines();
  if (!named && goes_on && present_ && target.motion == Motion::line && !states_others(hint)) {
    if (auto end = joints_after_line(arm, *present_, tool, held_)) return {JointsFrom::line, {std::move(*end)}};
  }
  if (!hint.configuration.empty()) return in_stated_turns(find_worded(arm, hint.configuration, tool), hint);
  if (!hint.parts.empty()) return find_by_parts(arm, hint.parts, tool);
  const JointVector& reference = named ? hint.near : present_ ? *present_ : given ? near_ : middle_;
  std::vector<JointVector> joints = joints_reaching(arm, tool, reference, held_);
  for (JointVector& candidate : joints) candidate = in_hinted_turns(arm, candidate, hint, reference);
  if (states) keep_stated(joints, hint);
  if (joints.size() <= 1) return settled(std::move(joints), states ? JointsFrom::stated : JointsFrom::only);
  if (!named && !present_ && !given) return {JointsFrom::undetermined, std::move(joints)};
  keep_nearest(joints, reference, held_);
  return settled(std::move(joints), named ? JointsFrom::stated : present_ ? JointsFrom::before : JointsFrom::given);
}

}  // namespace demecal::inline programs
