#include "calibration/admissible.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "calibration/training.hpp"
#include "effects/arm_state.hpp"
#include "evolution/population.hpp"
#include "expression/bound.hpp"
#include "expression/tree.hpp"
#include "fitness/fitness.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline calibration {
namespace {

constexpr std::size_t kMostJumps = 4;  ///< over a joint's range
constexpr int kJumpGrid = 512;
constexpr double kNegligible = 1e-6;    ///< rad or m
constexpr double kLeastJumpRad = 1e-5;  ///< a tool a metre away then moves by a hundredth of a millimetre

bool stays_below(const JointCorrection& correction, double limit_rad) {
  return stays_within(correction.formula(), correction.range_rad(), limit_rad);
}

bool jumps_seldom(const JointCorrection& correction) {
  const auto may_jump = [](const Node& node) {
    return node.primitive == Primitive::sign || node.primitive == Primitive::divide ||
           node.primitive == Primitive::logarithm;
  };
  if (std::ranges::none_of(correction.formula(), may_jump)) return true;
  return discontinuities(correction.formula(), correction.range_rad(), kLeastJumpRad, kJumpGrid).size() <= kMostJumps;
}

/// Whether the joint's correction moves what is seen of any pose.
bool moves_any_pose(const DataSet& data, const CorrectedRobot& robot, std::size_t joint) {
  CorrectedRobot without = robot;
  without.corrections[joint] = JointCorrection{};
  const bool turns =
      std::ranges::any_of(data.poses, [](const MeasuredPose& pose) { return pose.orientation.has_value(); });
  return std::ranges::any_of(data.poses, [&](const MeasuredPose& pose) {
    const Eigen::Isometry3d moved =
        robot.predict(Stop(pose), pose.target).inverse() * without.predict(Stop(pose), pose.target);
    return moved.translation().norm() >= kNegligible ||
           (turns && Eigen::AngleAxisd(moved.linear()).angle() >= kNegligible);
  });
}

/// A sum without the terms that stay below a microradian over the range; nothing where none is left.
std::optional<Tree> without_small_terms(std::span<const Node> sum, const Interval& range) {
  constexpr int kHalvings = 16;  ///< polynomials of many terms need more than other formulas
  const Primitive root = sum.front().primitive;
  if (root != Primitive::add && root != Primitive::subtract) {
    Tree term(sum.begin(), sum.end());
    if (stays_within(term, range, kNegligible, kHalvings)) return std::nullopt;
    return term;
  }
  const std::size_t second = subtree_end(sum, 1);
  const std::optional<Tree> left = without_small_terms(sum.subspan(1, second - 1), range);
  const std::optional<Tree> right = without_small_terms(sum.subspan(second), range);
  if (left && right) return apply(root, *left, *right);
  if (left || root == Primitive::add) return left ? left : right;
  return right ? std::optional(apply(Primitive::multiply, constant_tree(-1.0), *right)) : std::nullopt;
}

}  // namespace

bool is_bounded(const JointCorrection& correction, const JointTraining& training) {
  return stays_below(correction, correction_limit_rad(training));
}

std::vector<JointCorrection> admissible_corrections(const JointCandidates& candidates, std::optional<std::size_t> set) {
  std::vector<JointCorrection> corrections;
  const double limit_rad = correction_limit_rad(candidates.training);
  const auto add = [&](const JointCorrection& correction) {
    if (stays_below(correction, limit_rad) && jumps_seldom(correction)) corrections.push_back(correction);
  };
  for (const Individual& individual : candidates.front) add(correction_from(candidates.training, individual.tree));
  for (const Tree& tree : candidates.short_forms) add(correction_from(candidates.training, tree));
  if (set && *set < candidates.alternatives.size() && !candidates.alternatives[*set].is_neutral())
    add(candidates.alternatives[*set]);
  return corrections;
}

JointCorrection fittest_correction(const JointCandidates& candidates) {
  const double limit_rad = correction_limit_rad(candidates.training);
  JointCorrection fittest;
  for (const Individual& individual : candidates.front) {  // falling fitness: the last one that is bounded stays
    const JointCorrection correction = correction_from(candidates.training, individual.tree);
    if (stays_below(correction, limit_rad)) fittest = correction;
  }
  return fittest;
}

CorrectedRobot without_negligible_corrections(const DataSet& data, CorrectedRobot robot) {
  const CorrectedRobot whole = robot;
  for (std::size_t joint = 0; joint < robot.corrections.size(); ++joint) {
    JointCorrection& correction = robot.corrections[joint];
    if (correction.is_neutral()) continue;
    const std::optional<Tree> terms = without_small_terms(correction.formula(), correction.range_rad());
    if (!terms || !moves_any_pose(data, whole, joint)) {
      correction = JointCorrection{};
    } else if (*terms != correction.formula()) {
      correction = JointCorrection(*terms, correction.branch(), correction.range_rad());
    }
  }
  return robot;
}

namespace {

EvolvedCorrection described(const JointTraining& training, const JointCorrection& correction) {
  constexpr double kSmallestJump = 1e-5;
  EvolvedCorrection evolved{.joint = static_cast<int>(training.joint), .correction = correction};
  double sum = 0.0;
  std::size_t counted = 0;
  for (std::size_t row = 0; row < training.table.target.size(); ++row) {
    if (training.table.weight[row] <= 0.0) continue;
    sum += std::abs(training.scale_rad * training.table.target[row] - correction(training.table.variables[0][row]));
    ++counted;
  }
  if (counted > 0) evolved.mean_abs_error_rad = sum / static_cast<double>(counted);
  evolved.bound_rad = magnitude_bound(correction.formula(), correction.range_rad());
  evolved.jumps = discontinuities(correction.formula(), correction.range_rad(), kSmallestJump).size();
  return evolved;
}

}  // namespace

std::vector<EvolvedCorrection> evolved_fronts(std::span<const JointCandidates> candidates) {
  std::vector<EvolvedCorrection> all;
  for (const JointCandidates& joint : candidates) {
    for (const Individual& individual : joint.front)
      all.push_back(described(joint.training, correction_from(joint.training, individual.tree)));
  }
  return all;
}

std::vector<EvolvedCorrection> as_evolved(std::span<const JointCandidates> candidates) {
  std::vector<EvolvedCorrection> fittest;
  for (const JointCandidates& joint : candidates) {
    const JointCorrection correction = fittest_correction(joint);
    if (!correction.is_neutral()) fittest.push_back(described(joint.training, correction));
  }
  return fittest;
}

}  // namespace demecal::inline calibration
