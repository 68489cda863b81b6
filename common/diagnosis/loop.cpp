#include "diagnosis/loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/backward.hpp"
#include "diagnosis/detectable.hpp"
#include "diagnosis/evidence.hpp"
#include "diagnosis/further.hpp"
#include "diagnosis/group.hpp"
#include "diagnosis/noise_estimation.hpp"
#include "diagnosis/structure.hpp"

namespace demecal {
namespace {

constexpr int kSteps = 12;      ///< of Gauss and Newton, from the declared fit
constexpr int kStepsAgain = 3;  ///< after effects were added to a model that was already refined
constexpr int kMostGroups = 60;
/// Of more poses the many small errors that no model has are larger than what noise has in common, and taken for it.
constexpr std::size_t kMostPosesForNoise = 400;
constexpr double kOutlier = 0.05;                    ///< root of a pose's weight below which it counts as far out
constexpr std::size_t kMostPosesForFormulas = 5000;  ///< thousands of formulas over more take minutes

class ClosedLoop {
 public:
  ClosedLoop(const DiagnosisData& of, const LoopOptions& options, const RoundWatcher& watch)
      : of_(of), options_(options), watch_(watch) {}

  LoopResult run(DiagnosedModel start);

 private:
  void make_candidates(const Linearised& at);
  void measure_pure_error(const Linearised& at);
  GroupRules rules() const;
  std::vector<bool> not_to_try() const;
  void estimate_noise();
  void note_decoys(const Group& group, const GroupOutcome& outcome);
  bool run_group(const Linearised& at);
  bool gained_enough(const GroupOutcome& outcome) const;
  StopReason reason_to_stop(const GroupOutcome& last) const;
  void describe_added();
  void look_further();
  void leave_out_own_forms();
  void finish(const Linearised& at);
  RandomStream random(RandomPurpose purpose) const {
    return RandomStream{options_.seed, number_of(purpose), static_cast<std::uint64_t>(group_)};
  }
  double structure(const Linearised& at) const {
    return structure_p_value(at.fitted, at.projection, of_.data.robot.chain, options_.permutations,
                             random(RandomPurpose::structure_test));
  }

  const DiagnosisData& of_;
  const LoopOptions& options_;
  const RoundWatcher& watch_;
  DiagnosedModel model_;
  LoopOutcome outcome_;
  std::vector<Candidate> candidates_;
  EffectColumns columns_;
  std::vector<double> null_maxima_;
  std::optional<double> start_excess_;  ///< mean square of the residual above that of repeats, m^2
  double p_structure_ = 1.0;
  int group_ = 0;
};

void ClosedLoop::make_candidates(const Linearised& at) {
  Evidence evidence = evidence_of(of_.data, of_.fitted);
  evidence.highest_ratio = options_.highest_ratio;
  evidence.stated_ratios = options_.stated_ratios;
  outcome_.unseen = unseen_kinds(evidence, options_.kinds);
  const bool formulas = options_.formulas && of_.fitted.size() <= kMostPosesForFormulas;
  candidates_ = candidates_for(of_.data.robot, evidence, of_.declared, {options_.kinds, formulas, options_.decoys});
  const auto decoys =
      std::ranges::find_if(candidates_, [](const Candidate& c) { return c.disguise != Disguise::none; });
  const auto evolved = candidates_.insert(decoys, options_.evolved.begin(), options_.evolved.end());
  std::for_each_n(evolved, options_.evolved.size(),
                  [&](Candidate& candidate) { set_measured_ranges(candidate.effect, of_.data.robot, evidence); });
  const std::vector<ArmState>& states = at.fitted.states;
  const auto shuffled_approach =
      disguised(states, Disguise::shuffled_approach, random(RandomPurpose::shuffled_approach));
  const auto shuffled_heat =
      disguised(states, Disguise::shuffled_temperature, random(RandomPurpose::shuffled_temperature));
  for (const Candidate& candidate : candidates_) {
    const bool sides = candidate.disguise == Disguise::shuffled_approach;
    const bool heat = candidate.disguise == Disguise::shuffled_temperature;
    columns_.append(candidate.effect, of_.data.robot, sides ? shuffled_approach : heat ? shuffled_heat : states);
    if (candidate.disguise == Disguise::none) {
      ++outcome_.candidates;
    } else {
      outcome_.decoys.push_back({.name = decoy_name(candidate)});
    }
  }
  columns_.pack();
}

/// How measurements scatter, and the model's numbers by that; twice, since either depends on the other.
void ClosedLoop::estimate_noise() {
  constexpr int kRounds = 2;
  if (!options_.noise || of_.fitted.size() > kMostPosesForNoise) return;
  const bool several_kinds = std::ranges::count_if(model_.scales, [](double scale) { return scale > 0.0; }) > 1;
  if (group_ > 0 && several_kinds) {
    // An effect that was missing may have shown in one kind of rows more than in another.
    model_.noise = {};
    model_.noise_estimated = false;
    model_ = refined(of_, std::move(model_), kStepsAgain);
  }
  for (int round = 0; round < kRounds - (group_ > 0); ++round) {
    model_ = with_noise_estimated(of_, std::move(model_));
    model_ = refined(of_, std::move(model_), kStepsAgain);
  }
}

void ClosedLoop::measure_pure_error(const Linearised& at) {
  const auto pure = pure_error(of_.data, of_.fitted);
  if (!pure) return;
  outcome_.repeat_scatter_m = pure->deviation_m;
  const RowMatrix errors = unwhitened(at.fitted, at.errors);
  double squares = 0.0, freedom = 0.0;
  for (std::size_t i = 0; i < at.fitted.poses.size(); ++i) {
    if (!of_.data.poses[at.fitted.poses[i]].position_m) continue;
    const Eigen::Index first = at.fitted.first_row[i];
    squares += errors.middleRows(first, 3).squaredNorm();
    freedom += 3.0 - at.projection.basis().middleRows(first, 3).squaredNorm();
  }
  squares *= std::pow(model_.scales[kPosition], 2);
  if (!outcome_.lack_of_fit_p) outcome_.lack_of_fit_p = lack_of_fit_p_value(*pure, squares, freedom);
  const double left = squares / freedom - std::pow(pure->deviation_m, 2);
  if (!start_excess_) start_excess_ = left;
  if (*start_excess_ > 0.0) outcome_.explained_share = 1.0 - left / *start_excess_;
}

GroupRules ClosedLoop::rules() const {
  return {.family_error = options_.family_error,
          .permutations = options_.permutations,
          .resamples = options_.resamples,
          .most = std::min(options_.group_size, options_.max_effects - static_cast<int>(model_.robot.effects.size())),
          .seed = options_.seed,
          .group = group_,
          .first_round = static_cast<int>(outcome_.rounds.size()) + 1,
          .p_structure = p_structure_,
          .evolved_luck = options_.evolved_luck};
}

/// Candidates that the model holds already, or that the backward step took back.
std::vector<bool> ClosedLoop::not_to_try() const {
  std::vector<bool> out(candidates_.size(), false);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (candidates_[i].disguise != Disguise::none) continue;
    const auto is_it = [&](const Effect& effect) { return effect.same_law_as(candidates_[i].effect); };
    out[i] = std::ranges::any_of(model_.robot.effects, is_it) || std::ranges::any_of(outcome_.dropped, is_it);
  }
  return out;
}

void ClosedLoop::note_decoys(const Group& group, const GroupOutcome& outcome) {
  for (std::size_t i = 0; i < outcome_.decoys.size(); ++i) {
    Decoy& decoy = outcome_.decoys[i];
    decoy.best_fall_nats = std::max(decoy.best_fall_nats, group.decoy_falls()[i]);
    decoy.won = decoy.won || outcome.winning_decoy == decoy.name;
    decoy.p_left = group.decoys_p_left()[i];
  }
}

StopReason ClosedLoop::reason_to_stop(const GroupOutcome& last) const {
  if (last.winning_decoy) return StopReason::decoy;
  return last.luck ? StopReason::no_structure : StopReason::no_gain;
}

/// Whether the group lowered the validation error by so much that another one may be worth its while.
bool ClosedLoop::gained_enough(const GroupOutcome& outcome) const {
  double before = std::numeric_limits<double>::quiet_NaN(), after = before;
  for (const Round& round : outcome.rounds) {
    if (std::isnan(before)) before = round.validation_before_mm;
    if (round.verdict == Verdict::added) after = round.validation_after_mm;
  }
  return !(before - after < options_.least_gain * before);
}

/// Whether anything was added and more may follow.
bool ClosedLoop::run_group(const Linearised& at) {
  Group group(of_, model_, at, candidates_, columns_, not_to_try(), null_maxima_, rules());
  GroupOutcome outcome = group.run(watch_);
  note_decoys(group, outcome);
  const bool added = !outcome.added.empty();
  for (Effect effect : outcome.added) {
    // A group's values hold beside its own linear steps of all other numbers: the joint refit begins without them.
    std::fill(effect.values.begin(), effect.values.end(), 0.0);
    model_.robot.effects.push_back(std::move(effect));
  }
  const bool more = added && !outcome.winning_decoy && !outcome.stopped && gained_enough(outcome);
  if (!more) outcome_.stopped = reason_to_stop(outcome);
  std::ranges::move(outcome.rounds, std::back_inserter(outcome_.rounds));
  return more;
}

LoopResult ClosedLoop::run(DiagnosedModel start) {
  LoopResult result;
  model_ = refined(of_, std::move(start), kSteps);
  estimate_noise();
  result.before = model_;
  Linearised at = linearise(of_, model_);
  make_candidates(at);
  measure_pure_error(at);
  outcome_.permutations = options_.permutations;
  outcome_.stopped = StopReason::no_gain;
  p_structure_ = structure(at);
  for (group_ = 1; group_ <= kMostGroups; ++group_) {
    if (static_cast<int>(model_.robot.effects.size()) >= options_.max_effects) {
      outcome_.stopped = StopReason::max_effects;
      break;
    }
    const bool more = run_group(at);
    const std::size_t held = result.model.robot.effects.size();
    if (model_.robot.effects.size() != held) {
      model_ = refined(of_, std::move(model_), kStepsAgain);
      estimate_noise();
      at = take_back_needless(of_, model_, candidates_, outcome_);
      result.model = model_;
      p_structure_ = structure(at);
    }
    if (!more) break;
  }
  if (outcome_.stopped == StopReason::no_structure && p_structure_ <= options_.family_error) {
    outcome_.stopped = StopReason::no_gain;
  }
  measure_pure_error(at);
  finish(at);
  result.model = model_;
  result.outcome = std::move(outcome_);
  return result;
}

/// Added effects stand in their rounds as they ended, not as they were first guessed.
void ClosedLoop::describe_added() {
  for (Round& round : outcome_.rounds) {
    if (round.verdict != Verdict::added) continue;
    for (const Effect& effect : model_.robot.effects) {
      if (effect.same_law_as(round.effect)) round.effect = effect;
    }
    if (!round.effect.standard_errors.empty()) round.interval = intervals_of(round.effect);
    round.diagnosis = law_of(round.effect).diagnosis(round.effect, of_.data.robot);
    round.formula = law_of(round.effect).formula(round.effect, of_.data.robot);
  }
}

/// What to measure next, for the first few effects that have rivals.
void ClosedLoop::look_further() {
  constexpr int kMost = 3;
  int said = 0;
  for (Round& round : outcome_.rounds) {
    const bool named_last = round.verdict == Verdict::added || &round == &outcome_.rounds.back();
    if (!named_last || round.rivals.empty() || said >= kMost) continue;
    round.further =
        further_measurement(of_, model_, round.effect, round.rivals, random(RandomPurpose::further_measurement));
    ++said;
  }
}

/// Other forms of an effect are no rivals of it.
void ClosedLoop::leave_out_own_forms() {
  for (Round& round : outcome_.rounds) {
    std::erase_if(round.rivals, [&](const Rival& rival) {
      const Effect &own = round.effect, &other = rival.effect;
      const bool named = !is_symbolic(own) && own.kind == other.kind && own.joint == other.joint;
      return other.same_law_as(own) || (named && other.settings == own.settings);
    });
  }
}

void ClosedLoop::finish(const Linearised& at) {
  outcome_.p_structure_left = p_structure_;
  outcome_.noise = model_.noise;
  outcome_.noise_estimated = model_.noise_estimated;
  outcome_.independent_m = model_.scales[kPosition];
  describe_added();
  leave_out_own_forms();
  look_further();
  outcome_.not_found =
      not_found_beyond({of_.data.robot, model_, at, candidates_, columns_, outcome_.rounds}, null_maxima_,
                       {options_.family_error, options_.permutations}, random(RandomPurpose::null_distribution));
  for (std::size_t i = 0; i < at.fitted.poses.size(); ++i) {
    if (at.fitted.root_weight[i] < kOutlier) outcome_.outliers.push_back(at.fitted.poses[i]);
  }
}

}  // namespace

LoopResult close_loop(const DataSet& data, const DeclaredModel& declared, const Fit& start, const LoopOptions& options,
                      const RoundWatcher& watch) {
  const DiagnosisData of{data, declared, poses_of(data, PoseSet::calibration), poses_of(data, PoseSet::validation)};
  return ClosedLoop(of, options, watch).run(diagnosed_model(of, start));
}

}  // namespace demecal
