#include "distal/steps.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "calibration/training.hpp"
#include "distal/index.hpp"
#include "evolution/population.hpp"
#include "expression/evaluate.hpp"
#include "expression/rounded_constant.hpp"
#include "expression/tree.hpp"
#include "fitness/fitness.hpp"
#include "kinematics/chain.hpp"
#include "primitives/columns.hpp"

namespace demecal::inline distal {
namespace {

constexpr double kLeastIndexGain = 1e-4;  ///< of the linearized index, by a choice that counts
constexpr double kLargestFactor = 10.0;
constexpr int kScaleDigits = 3;  ///< that formulas show

/// A formula that a joint may have; its place is that of its shape.
struct CandidateOffer {
  std::size_t list = 0;  ///< of candidates
  Tree tree;
  double scale_rad = 1.0;
  bool is_present = false;
  bool is_refused = false;
};

class CandidateChoice {
 public:
  CandidateChoice(std::span<const JointCandidates> candidates, std::span<const LinearizedPose> poses,
                  Amplitudes amplitudes, const DistalOutcome& outcome)
      : candidates_(candidates), robot_(outcome.robot), amplitudes_(amplitudes) {
    for (std::size_t list = 0; list < candidates.size(); ++list) offer_candidates(list, poses);
    std::vector<std::size_t> joints;
    for (const JointCandidates& joint : candidates) joints.push_back(joint.training.joint);
    fit_.emplace(poses, joints, shapes_);
    choose(outcome.index_mm2);
  }

  CorrectedRobot robot() const;

 private:
  void offer_candidates(std::size_t list, std::span<const LinearizedPose> poses);
  void offer(CandidateOffer offer, CorrectionShape shape);
  void choose(double index_mm2);
  bool choose_one();
  std::optional<ChosenShapes> evaluate(std::span<const std::size_t> chosen) const;
  std::vector<std::size_t> with(std::size_t place) const;
  std::optional<std::size_t> first_unbounded(std::span<const std::size_t> chosen,
                                             const ChosenShapes& fit_of_choice) const;
  bool is_held(std::size_t place) const { return std::ranges::count(held_, place) > 0; }
  void fit_present();
  JointCorrection correction(std::size_t place, double factor) const;

  std::span<const JointCandidates> candidates_;
  const CorrectedRobot& robot_;
  Amplitudes amplitudes_;
  std::vector<CandidateOffer> offers_;
  std::vector<CorrectionShape> shapes_;
  std::optional<AmplitudeFit> fit_;
  std::vector<std::size_t> chosen_;  ///< places of offers, at most one a joint
  std::vector<std::size_t> held_;    ///< places of offers that are to keep their size: larger, they are not bounded
  ChosenShapes fit_of_chosen_;
};

void CandidateChoice::offer(CandidateOffer offer, CorrectionShape shape) {
  if (!std::ranges::all_of(shape.value_rad, [](double value) { return std::isfinite(value); })) return;
  if (offer.is_present) chosen_.push_back(offers_.size());
  offers_.push_back(std::move(offer));
  shapes_.push_back(std::move(shape));
}

void CandidateChoice::offer_candidates(std::size_t list, std::span<const LinearizedPose> poses) {
  const JointTraining& training = candidates_[list].training;
  const JointCorrection& present = robot_.corrections[training.joint];
  if (!present.is_neutral())
    offer({list, evolved_tree(present), evolved_scale_rad(present), true}, present_shape(poses, training.joint));
  ColumnEvaluator evaluate(training.table.variables);
  for (const Individual& individual : candidates_[list].front) {
    const std::span<const double> values = evaluate(individual.tree);
    CorrectionShape shape{training.joint, {values.begin(), values.end()}};
    for (double& value : shape.value_rad) value *= training.scale_rad;
    offer({list, individual.tree, training.scale_rad}, std::move(shape));
  }
}

/// What is chosen with this in its joint's place.
std::vector<std::size_t> CandidateChoice::with(std::size_t place) const {
  std::vector<std::size_t> chosen;
  for (const std::size_t other : chosen_)
    if (offers_[other].list != offers_[place].list) chosen.push_back(other);
  chosen.push_back(place);
  return chosen;
}

/// Nothing where a factor is out of bounds.
std::optional<ChosenShapes> CandidateChoice::evaluate(std::span<const std::size_t> chosen) const {
  if (amplitudes_ == Amplitudes::as_evolved) return fit_->unscaled(chosen);
  ChosenShapes fitted = fit_->fitted(chosen, held_);
  const auto is_sound = [](double factor) { return factor >= 1.0 / kLargestFactor && factor <= kLargestFactor; };
  if (!std::ranges::all_of(fitted.factor, is_sound)) return std::nullopt;
  return fitted;
}

/// The place of one that is not. Limits change with what is left: what the model has may stay, but not grow.
std::optional<std::size_t> CandidateChoice::first_unbounded(std::span<const std::size_t> chosen,
                                                            const ChosenShapes& fit_of_choice) const {
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const CandidateOffer& offer = offers_[chosen[i]];
    if (is_held(chosen[i]) || (offer.is_present && fit_of_choice.factor[i] <= 1.0)) continue;
    if (!is_bounded(correction(chosen[i], fit_of_choice.factor[i]), candidates_[offer.list].training)) return chosen[i];
  }
  return std::nullopt;
}

/// Whether another choice lowers the index. What does but is not bounded is refused; what it would have grow too large
/// is held.
bool CandidateChoice::choose_one() {
  while (true) {
    std::optional<std::size_t> best;
    ChosenShapes fit_of_choice = fit_of_chosen_;
    fit_of_choice.index_mm2 *= 1.0 - kLeastIndexGain;
    for (std::size_t place = 0; place < offers_.size(); ++place) {
      if (offers_[place].is_refused || std::ranges::count(chosen_, place) > 0) continue;
      std::optional<ChosenShapes> one = evaluate(with(place));
      if (!one || !(one->index_mm2 < fit_of_choice.index_mm2)) continue;
      fit_of_choice = std::move(*one);
      best = place;
    }
    if (!best) return false;
    std::vector<std::size_t> chosen = with(*best);
    const std::optional<std::size_t> large = first_unbounded(chosen, fit_of_choice);
    if (large == best) offers_[*best].is_refused = true;
    if (large && large != best) held_.push_back(*large);
    if (large) continue;
    chosen_ = std::move(chosen);
    fit_of_chosen_ = std::move(fit_of_choice);
    return true;
  }
}

/// What the model has, to one another.
void CandidateChoice::fit_present() {
  while (true) {
    std::optional<ChosenShapes> fitted = evaluate(chosen_);
    if (!fitted || !(fitted->index_mm2 < fit_of_chosen_.index_mm2)) return;
    const std::optional<std::size_t> large = first_unbounded(chosen_, *fitted);
    if (!large) fit_of_chosen_ = std::move(*fitted);
    if (!large) return;
    held_.push_back(*large);
  }
}

void CandidateChoice::choose(double index_mm2) {
  fit_of_chosen_ = {std::vector<double>(chosen_.size(), 1.0), index_mm2};
  fit_present();
  while (choose_one()) {
  }
}

JointCorrection CandidateChoice::correction(std::size_t place, double factor) const {
  const CandidateOffer& offer = offers_[place];
  if (factor == 1.0 && offer.is_present) return robot_.corrections[candidates_[offer.list].training.joint];
  JointTraining training = candidates_[offer.list].training;
  training.scale_rad = factor == 1.0 ? offer.scale_rad : rounded_constant(factor * offer.scale_rad, kScaleDigits);
  return correction_from(training, offer.tree);
}

CorrectedRobot CandidateChoice::robot() const {
  CorrectedRobot robot = robot_;
  for (std::size_t i = 0; i < chosen_.size(); ++i)
    robot.corrections[shapes_[chosen_[i]].joint] = correction(chosen_[i], fit_of_chosen_.factor[i]);
  return robot;
}

}  // namespace

JointTraining distal_training(const JointTraining& previous, std::span<const LinearizedPose> poses,
                              std::optional<double> scale_rad) {
  const auto joint = static_cast<Eigen::Index>(previous.joint);
  JointTraining training = previous;
  training.table.loss = Loss::squared;
  training.table.seeds.clear();
  double most = 0.0;
  for (const LinearizedPose& pose : poses) most = std::max(most, pose.jacobian_mm.col(joint).squaredNorm());
  double sum = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto slope = poses[i].jacobian_mm.col(joint);
    // A joint that moves nothing here learns nothing here.
    const bool moves = slope.squaredNorm() > 1e-12 * most;
    const double weight = moves ? std::min(1.0, slope.squaredNorm() / most) : 0.0;
    const double more = moves ? slope.dot(poses[i].residual_mm) / slope.squaredNorm() : 0.0;
    training.table.target[i] = poses[i].correction[joint] + more;
    training.table.weight[i] = weight;
    sum += weight * std::abs(training.table.target[i]);
    weights += weight;
  }
  training.scale_rad = scale_rad ? *scale_rad : round_scale(weights > 0.0 ? sum / weights : 0.0);
  for (double& target : training.table.target) target /= training.scale_rad;
  limit_formulas(training);
  return training;
}

void rescale_trainings(const CorrectedRobot& robot, std::span<JointTraining> trainings) {
  for (JointTraining& training : trainings) {
    const JointCorrection& correction = robot.corrections[training.joint];
    if (correction.is_neutral()) continue;
    const double factor = evolved_scale_rad(correction) / training.scale_rad;
    training.scale_rad = evolved_scale_rad(correction);
    for (double& target : training.table.target) target /= factor;
    limit_formulas(training);
  }
}

bool accept_correction(const DistalIndex& index, const JointTraining& training, const JointCorrection& correction,
                       std::uint32_t generation, DistalOutcome& outcome) {
  JointCorrection& present = outcome.robot.corrections[training.joint];
  JointCorrection before = std::exchange(present, correction);
  const double index_mm2 = index(outcome.robot);
  if (!(index_mm2 < (1.0 - kLeastFall) * outcome.index_mm2)) {
    present = std::move(before);
    return false;
  }
  outcome.index_mm2 = index_mm2;
  outcome.steps.push_back({static_cast<int>(training.joint), generation, correction, index_mm2});
  return true;
}

bool accept_candidates(const DistalIndex& index, std::span<const JointCandidates> candidates, Amplitudes amplitudes,
                       std::uint32_t generation, DistalOutcome& outcome) {
  const std::vector<LinearizedPose> poses = index.linearized(outcome.robot);
  CorrectedRobot robot = CandidateChoice(candidates, poses, amplitudes, outcome).robot();
  const double index_mm2 = index(robot);
  if (!(index_mm2 < (1.0 - kLeastFall) * outcome.index_mm2)) return false;
  for (const JointCandidates& joint : candidates) {
    const JointCorrection& correction = robot.corrections[joint.training.joint];
    if (correction.formula() == outcome.robot.corrections[joint.training.joint].formula()) continue;
    outcome.steps.push_back({static_cast<int>(joint.training.joint), generation, correction, index_mm2});
  }
  outcome.robot = std::move(robot);
  outcome.index_mm2 = index_mm2;
  return true;
}

}  // namespace demecal::inline distal
