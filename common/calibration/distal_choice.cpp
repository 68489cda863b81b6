#include "calibration/distal_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/amplitude_fit.hpp"

namespace demecal {
namespace {

constexpr double kLeastGain = 1e-4;  ///< of the linearised index, by a choice that counts
constexpr double kLargestFactor = 10.0;
constexpr double kScaleDigits = 3.0;  ///< that formulas show

/// A formula that a joint may have; its place is that of its shape.
struct Offer {
  std::size_t list = 0;  ///< of candidates
  Tree tree;
  double scale_rad = 1.0;
  bool is_present = false;
  bool is_refused = false;
};

/// A power of ten divides exactly, so that the number prints with as few digits.
double rounded(double scale_rad) {
  const double power = std::pow(10.0, kScaleDigits - 1.0 - std::floor(std::log10(std::abs(scale_rad))));
  return std::round(scale_rad * power) / power;
}

class Choice {
 public:
  Choice(std::span<const JointCandidates> candidates, std::span<const LinearisedPose> poses, Amplitudes amplitudes,
         const DistalOutcome& outcome)
      : candidates_(candidates), robot_(outcome.robot), amplitudes_(amplitudes) {
    for (std::size_t list = 0; list < candidates.size(); ++list) offer_all(list, poses);
    std::vector<std::size_t> joints;
    for (const JointCandidates& joint : candidates) joints.push_back(joint.training.joint);
    fit_.emplace(poses, joints, shapes_);
    choose(outcome.index_mm2);
  }

  CorrectedRobot robot() const;

 private:
  void offer_all(std::size_t list, std::span<const LinearisedPose> poses);
  void offer(Offer offer, CorrectionShape shape);
  void choose(double index_mm2);
  bool choose_one();
  std::optional<ChosenShapes> worth(std::span<const std::size_t> chosen) const;
  std::vector<std::size_t> with(std::size_t place) const;
  std::optional<std::size_t> unbounded(std::span<const std::size_t> chosen, const ChosenShapes& as) const;
  bool is_held(std::size_t place) const { return std::ranges::count(held_, place) > 0; }
  void fit_present();
  JointCorrection correction(std::size_t place, double factor) const;

  std::span<const JointCandidates> candidates_;
  const CorrectedRobot& robot_;
  Amplitudes amplitudes_;
  std::vector<Offer> offers_;
  std::vector<CorrectionShape> shapes_;
  std::optional<AmplitudeFit> fit_;
  std::vector<std::size_t> chosen_;  ///< places of offers, at most one a joint
  std::vector<std::size_t> held_;    ///< places of offers that are to keep their size: larger, they are not bounded
  ChosenShapes as_;
};

void Choice::offer(Offer offer, CorrectionShape shape) {
  if (!std::ranges::all_of(shape.value_rad, [](double value) { return std::isfinite(value); })) return;
  if (offer.is_present) chosen_.push_back(offers_.size());
  offers_.push_back(std::move(offer));
  shapes_.push_back(std::move(shape));
}

void Choice::offer_all(std::size_t list, std::span<const LinearisedPose> poses) {
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
std::vector<std::size_t> Choice::with(std::size_t place) const {
  std::vector<std::size_t> chosen;
  for (const std::size_t other : chosen_)
    if (offers_[other].list != offers_[place].list) chosen.push_back(other);
  chosen.push_back(place);
  return chosen;
}

/// Nothing where a factor is out of bounds.
std::optional<ChosenShapes> Choice::worth(std::span<const std::size_t> chosen) const {
  if (amplitudes_ == Amplitudes::as_evolved) return fit_->as_they_are(chosen);
  ChosenShapes fitted = fit_->fitted(chosen, held_);
  const auto is_sound = [](double factor) { return factor >= 1.0 / kLargestFactor && factor <= kLargestFactor; };
  if (!std::ranges::all_of(fitted.factor, is_sound)) return std::nullopt;
  return fitted;
}

/// The place of one that is not. Limits change with what is left: what the model has may stay, but not grow.
std::optional<std::size_t> Choice::unbounded(std::span<const std::size_t> chosen, const ChosenShapes& as) const {
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Offer& offer = offers_[chosen[i]];
    if (is_held(chosen[i]) || (offer.is_present && as.factor[i] <= 1.0)) continue;
    if (!is_bounded(correction(chosen[i], as.factor[i]), candidates_[offer.list].training)) return chosen[i];
  }
  return std::nullopt;
}

/// Whether another choice lowers the index. What does but is not bounded is refused; what it would have grow too large
/// is held.
bool Choice::choose_one() {
  while (true) {
    std::optional<std::size_t> best;
    ChosenShapes as = as_;
    as.index_mm2 *= 1.0 - kLeastGain;
    for (std::size_t place = 0; place < offers_.size(); ++place) {
      if (offers_[place].is_refused || std::ranges::count(chosen_, place) > 0) continue;
      std::optional<ChosenShapes> one = worth(with(place));
      if (!one || !(one->index_mm2 < as.index_mm2)) continue;
      as = std::move(*one);
      best = place;
    }
    if (!best) return false;
    std::vector<std::size_t> chosen = with(*best);
    const std::optional<std::size_t> large = unbounded(chosen, as);
    if (large == best) offers_[*best].is_refused = true;
    if (large && large != best) held_.push_back(*large);
    if (large) continue;
    chosen_ = std::move(chosen);
    as_ = std::move(as);
    return true;
  }
}

/// What the model has, to one another.
void Choice::fit_present() {
  while (true) {
    std::optional<ChosenShapes> fitted = worth(chosen_);
    if (!fitted || !(fitted->index_mm2 < as_.index_mm2)) return;
    const std::optional<std::size_t> large = unbounded(chosen_, *fitted);
    if (!large) as_ = std::move(*fitted);
    if (!large) return;
    held_.push_back(*large);
  }
}

void Choice::choose(double index_mm2) {
  as_ = {std::vector<double>(chosen_.size(), 1.0), index_mm2};
  fit_present();
  while (choose_one()) {
  }
}

JointCorrection Choice::correction(std::size_t place, double factor) const {
  const Offer& offer = offers_[place];
  if (factor == 1.0 && offer.is_present) return robot_.corrections[candidates_[offer.list].training.joint];
  JointTraining training = candidates_[offer.list].training;
  training.scale_rad = factor == 1.0 ? offer.scale_rad : rounded(factor * offer.scale_rad);
  return correction_from(training, offer.tree);
}

CorrectedRobot Choice::robot() const {
  CorrectedRobot robot = robot_;
  for (std::size_t i = 0; i < chosen_.size(); ++i)
    robot.corrections[shapes_[chosen_[i]].joint] = correction(chosen_[i], as_.factor[i]);
  return robot;
}

}  // namespace

bool take_candidates(const DistalIndex& index, std::span<const JointCandidates> candidates, Amplitudes amplitudes,
                     std::uint32_t generation, DistalOutcome& outcome) {
  const std::vector<LinearisedPose> poses = index.linearised(outcome.robot);
  CorrectedRobot robot = Choice(candidates, poses, amplitudes, outcome).robot();
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

}  // namespace demecal
