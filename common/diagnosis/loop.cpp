#include "diagnosis/loop.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "diagnosis/candidates.hpp"
#include "diagnosis/detectable.hpp"
#include "diagnosis/explain.hpp"
#include "diagnosis/group.hpp"
#include "diagnosis/scan.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "explanations/error_budget.hpp"
#include "parameters/observation.hpp"
#include "prediction/corrected_robot.hpp"
#include "products/tall_products.hpp"
#include "random/random_purpose.hpp"
#include "random/random_stream.hpp"
#include "residuals/noise_estimation.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"
#include "residuals/structure.hpp"

namespace demecal::inline diagnosis {
namespace {

constexpr int kFirstSteps = 12;  ///< of Gauss and Newton, from the declared fit
constexpr int kLaterSteps = 3;   ///< after effects were added to a model that was already refined
constexpr int kMostGroups = 60;
constexpr int kMostOneByOne = 100;  ///< effects after which the search for sets of them gains more than a further one
/// Of more poses the many small errors that no model has are larger than what noise has in common, and taken for it.
constexpr std::size_t kMostPosesForNoise = 400;
constexpr double kOutlier = 0.05;                    ///< root of a pose's weight below which it counts as far out
constexpr std::size_t kMostPosesForFormulas = 5000;  ///< thousands of formulas over more take minutes

class ClosedLoop {
 public:
  ClosedLoop(const DiagnosisProblem& problem, const LoopOptions& options, const RoundWatcher& watch)
      : problem_(problem), options_(options), watch_(watch) {}

  LoopResult run(DiagnosedModel start);

 private:
  void make_candidates(const Linearization& linearization);
  void measure_pure_error(const Linearization& linearization);
  GroupRules rules() const;
  int most_one_by_one() const { return std::min(options_.max_effects, kMostOneByOne + held_at_start_); }
  std::vector<bool> excluded_candidates() const;
  void estimate_noise();
  void record_decoys(const Group& group, const GroupOutcome& outcome);
  bool run_group(const Linearization& linearization);
  StopReason reason_to_stop(const GroupOutcome& last) const;
  Linearization choose_explanation(const Linearization& linearization, LoopResult& result);
  Linearization choose_explanation(Linearization linearization, const ExplanationSearch& search, LoopResult& result);
  void finish(const Linearization& linearization);
  RandomStream random(RandomPurpose purpose) const {
    return RandomStream{options_.seed, number_of(purpose), static_cast<std::uint64_t>(group_)};
  }
  double structure(const Linearization& linearization) const {
    return structure_p_value(linearization.fitted, linearization.projection, problem_.data.robot.chain,
                             options_.null_draws, random(RandomPurpose::structure_test), options_.work.do_work);
  }

  const DiagnosisProblem& problem_;
  const LoopOptions& options_;
  const RoundWatcher& watch_;
  DiagnosedModel model_;
  LoopOutcome outcome_;
  std::vector<Candidate> candidates_;
  EffectColumns columns_;
  std::vector<double> null_maxima_;
  std::optional<double> start_excess_;  ///< mean square of the residual above that of repeats, m^2
  double p_structure_ = 1.0;
  int group_ = 0, held_at_start_ = 0;
  bool interrupted_ = false;  ///< by the watcher
};

void ClosedLoop::make_candidates(const Linearization& linearization) {
  Evidence evidence = evidence_of(problem_.data, problem_.fitted);
  evidence.highest_ratio = options_.highest_ratio;
  evidence.stated_ratios = options_.stated_ratios;
  outcome_.untestable = untestable_kinds(evidence, options_.kinds);
  outcome_.considered = options_.kinds;
  const bool formulas = options_.formulas && problem_.fitted.size() <= kMostPosesForFormulas;
  candidates_ =
      candidates_for(problem_.data.robot, evidence, problem_.declared, {options_.kinds, formulas, options_.decoys});
  const auto decoys =
      std::ranges::find_if(candidates_, [](const Candidate& c) { return c.decoy_kind != DecoyKind::none; });
  const auto evolved = candidates_.insert(decoys, options_.evolved.begin(), options_.evolved.end());
  std::for_each_n(evolved, options_.evolved.size(),
                  [&](Candidate& candidate) { set_measured_ranges(candidate.effect, problem_.data.robot, evidence); });
  const std::vector<ArmState>& states = linearization.fitted.states;
  const auto shuffled_approach =
      with_shuffled(states, DecoyKind::shuffled_approach, random(RandomPurpose::shuffled_approach));
  const auto shuffled_heat =
      with_shuffled(states, DecoyKind::shuffled_temperature, random(RandomPurpose::shuffled_temperature));
  std::vector<SampledEffect> sampled;
  for (const Candidate& candidate : candidates_) {
    const DecoyKind kind = candidate.decoy_kind;
    const bool sides = kind == DecoyKind::shuffled_approach, heat = kind == DecoyKind::shuffled_temperature;
    sampled.push_back({candidate.effect, sides ? shuffled_approach : heat ? shuffled_heat : states});
    outcome_.candidates += kind == DecoyKind::none;
    if (kind != DecoyKind::none) outcome_.decoys.push_back({.name = decoy_name(candidate)});
  }
  columns_.append(sampled, problem_.data.robot);
  columns_.pack();
}

/// How measurements scatter, and the model's numbers by that; twice, since either depends on the other.
void ClosedLoop::estimate_noise() {
  constexpr int kRounds = 2;
  if (!options_.noise || problem_.fitted.size() > kMostPosesForNoise || has_contacts(problem_.data)) return;
  const bool several_kinds = std::ranges::count_if(model_.scales, [](double scale) { return scale > 0.0; }) > 1;
  if (group_ > 0 && several_kinds) {
    // An effect that was missing may have shown in one kind of rows more than in another.
    model_.noise = {};
    model_.noise_estimated = false;
    model_ = refined(problem_, std::move(model_), kLaterSteps);
  }
  for (int round = 0; round < kRounds - (group_ > 0); ++round) {
    model_ = with_noise_estimated(problem_, std::move(model_));
    model_ = refined(problem_, std::move(model_), kLaterSteps);
  }
}

void ClosedLoop::measure_pure_error(const Linearization& linearization) {
  if (const auto plain = pure_error(problem_.data, problem_.fitted)) outcome_.repeat_scatter_m = plain->deviation_m;
  // Repeats by a precise instrument say nothing of what a coarse one leaves: all in units of their station's noise.
  const auto pure = pure_error(problem_.data, problem_.fitted, model_.scales);
  if (!pure) return;
  const auto [squares, freedom] = position_errors(problem_, linearization, model_.scales);
  if (!outcome_.lack_of_fit_p) outcome_.lack_of_fit_p = lack_of_fit_p_value(*pure, squares, freedom);
  const double left = squares / freedom - std::pow(pure->deviation_m, 2);
  if (!start_excess_) start_excess_ = left;
  if (*start_excess_ > 0.0) outcome_.explained_share = 1.0 - std::max(0.0, left) / *start_excess_;
}

GroupRules ClosedLoop::rules() const {
  return {.family_error = options_.family_error,
          .null_draws = options_.null_draws,
          .resamples = options_.resamples,
          .most = std::min(options_.group_size, most_one_by_one() - static_cast<int>(model_.robot.effects.size())),
          .seed = options_.seed,
          .group = group_,
          .first_round = static_cast<int>(outcome_.rounds.size()) + 1,
          .p_structure = p_structure_,
          .evolved_null_gains = options_.evolved_null_gains,
          .do_work = options_.work.do_work};
}

/// Candidates that the model holds already, or that the backward step took back.
std::vector<bool> ClosedLoop::excluded_candidates() const {
  std::vector<Effect> out = model_.robot.effects;
  std::ranges::copy(outcome_.dropped, std::back_inserter(out));
  return candidates_among(candidates_, out);
}

void ClosedLoop::record_decoys(const Group& group, const GroupOutcome& outcome) {
  for (std::size_t i = 0; i < outcome_.decoys.size(); ++i) {
    Decoy& decoy = outcome_.decoys[i];
    decoy.best_gain_nats = std::max(decoy.best_gain_nats, group.decoy_gains()[i]);
    decoy.won = decoy.won || outcome.winning_decoy == decoy.name;
    decoy.p_left = group.decoy_p_values()[i];
  }
}

StopReason ClosedLoop::reason_to_stop(const GroupOutcome& last) const {
  if (last.winning_decoy) return StopReason::decoy;
  return last.not_significant ? StopReason::no_structure : StopReason::no_gain;
}

/// Whether anything was added and more may follow.
bool ClosedLoop::run_group(const Linearization& linearization) {
  Group group(problem_, model_, linearization, candidates_, columns_, excluded_candidates(), null_maxima_, rules());
  GroupOutcome outcome = group.run(watch_);
  record_decoys(group, outcome);
  interrupted_ = outcome.stopped;
  const bool added = !outcome.added.empty();
  for (Effect effect : outcome.added) {
    // A group's values hold beside its own linear steps of all other numbers: the joint refit begins without them.
    std::fill(effect.values.begin(), effect.values.end(), 0.0);
    model_.robot.effects.push_back(std::move(effect));
  }
  const bool more =
      added && !outcome.winning_decoy && !outcome.stopped && !(validation_gain(outcome) < options_.least_gain);
  if (!more) outcome_.stopped = reason_to_stop(outcome);
  std::ranges::move(outcome.rounds, std::back_inserter(outcome_.rounds));
  return more;
}

LoopResult ClosedLoop::run(DiagnosedModel start) {
  LoopResult result;
  model_ = refined(problem_, std::move(start), kFirstSteps);
  result.before = model_;
  estimate_noise();
  held_at_start_ = static_cast<int>(model_.robot.effects.size());
  Linearization linearization = linearize(problem_, model_);
  make_candidates(linearization);
  measure_pure_error(linearization);
  outcome_.null_draws = options_.null_draws;
  outcome_.stopped = StopReason::no_gain;
  p_structure_ = structure(linearization);
  for (group_ = 1; group_ <= kMostGroups; ++group_) {
    if (static_cast<int>(model_.robot.effects.size()) >= most_one_by_one()) {
      outcome_.stopped = StopReason::max_effects;
      break;
    }
    const bool more = run_group(linearization);
    if (model_.robot.effects.size() != result.model.robot.effects.size()) {
      model_ = refined(problem_, std::move(model_), kLaterSteps);
      estimate_noise();
      linearization = eliminate_backward(problem_, model_, candidates_, outcome_);
      result.model = model_;
      p_structure_ = structure(linearization);
    }
    if (!more) break;
  }
  if (outcome_.stopped == StopReason::no_structure && p_structure_ <= options_.family_error)
    outcome_.stopped = StopReason::no_gain;
  linearization = choose_explanation(std::move(linearization), result);
  if (!model_.robot.effects.empty() && leaves_more(problem_, model_, result.before)) {
    model_ = result.before;
    linearization = linearize(problem_, model_);
    result.front = {}, result.best.reset();
  }
  measure_pure_error(linearization);
  finish(linearization);
  result.model = model_;
  result.outcome = std::move(outcome_);
  return result;
}

/// What the effects amount to: better sets of them are looked for, and the fewest causes chosen that do as well. Where
/// what evolution found is behind what it began with once the backward step is done, it is not used.
Linearization ClosedLoop::choose_explanation(const Linearization& linearization, LoopResult& result) {
  if (model_.robot.effects.empty()) return linearization;
  ++group_;
  ExplanationSearch search = options_.explanations;
  if (interrupted_) search.variations = 0;
  search.most_effects = static_cast<std::size_t>(options_.max_effects);
  const DiagnosedModel present = model_;
  const LoopOutcome so_far = outcome_;
  Linearization chosen = choose_explanation(linearization, search, result);
  if (search.variations == 0 || does_as_well(problem_, model_, present)) return chosen;
  model_ = present;
  outcome_ = so_far;
  search.variations = 0;
  return choose_explanation(linearization, search, result);
}

Linearization ClosedLoop::choose_explanation(Linearization linearization, const ExplanationSearch& search,
                                             LoopResult& result) {
  Explained found = explained({problem_, model_, linearization, candidates_, columns_, outcome_.rounds, null_maxima_,
                               rules(), options_.work.search_explanations},
                              search, random(RandomPurpose::explanation_search), watch_);
  result.front = std::move(found.front);
  if (found.rounds.empty() && found.model.robot.effects.size() == model_.robot.effects.size()) return linearization;
  model_ = std::move(found.model);
  std::ranges::move(found.rounds, std::back_inserter(outcome_.rounds));
  estimate_noise();
  linearization = eliminate_backward(problem_, model_, candidates_, outcome_);
  p_structure_ = structure(linearization);
  result.best = std::move(found.best);
  choose(problem_, model_, result.front);
  return linearization;
}

void ClosedLoop::finish(const Linearization& linearization) {
  const BoundOptions bounds{options_.family_error, options_.null_draws, options_.work.do_work};
  outcome_.p_structure_left = p_structure_;
  outcome_.noise = model_.noise;
  outcome_.noise_estimated = model_.noise_estimated;
  outcome_.independent_m = model_.scales[kPosition];
  update_rounds(outcome_, model_.robot, problem_.data.robot);
  const Scan scan(columns_, naming_costs_nats(candidates_), linearization.fitted, linearization.projection,
                  options_.work.do_work);
  const FinishedLoop finished{problem_.data.robot, model_, linearization, candidates_, columns_, scan, outcome_.rounds};
  update_rivals(finished, outcome_.rounds);
  exclude_own_forms(outcome_.rounds);
  find_next_measurements(problem_, model_, random(RandomPurpose::next_measurement), outcome_.rounds);
  find_limits(finished, null_maxima_, bounds, random(RandomPurpose::null_distribution), outcome_);
  for (std::size_t i = 0; i < linearization.fitted.poses.size(); ++i)
    if (linearization.fitted.root_weight[i] < kOutlier) outcome_.outliers.push_back(linearization.fitted.poses[i]);
}

}  // namespace

LoopResult close_loop(const DataSet& data, const DeclaredModel& declared, const Fit& start, const LoopOptions& options,
                      const RoundWatcher& watch) {
  const DiagnosisProblem problem{data, declared, poses_of(data, PoseSet::calibration),
                                 poses_of(data, PoseSet::validation)};
  return ClosedLoop(problem, options, watch).run(diagnosed_model(problem, start));
}

}  // namespace demecal::inline diagnosis
