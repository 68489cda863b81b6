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
#include "diagnosis/last_resort.hpp"
#include "diagnosis/scan.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "explanations/explanation_front.hpp"
#include "parameters/observation.hpp"
#include "prediction/corrected_robot.hpp"
#include "products/tall_products.hpp"
#include "random/random_purpose.hpp"
#include "random/random_stream.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"
#include "residuals/structure.hpp"

namespace demecal::inline diagnosis {
namespace {

constexpr int kFirstSteps = 12;  ///< of Gauss and Newton, from the declared fit
constexpr int kLaterSteps = 3;   ///< after effects were added to a model that was already refined
constexpr int kMostGroups = 60;
constexpr int kMostOffers = 4;      ///< of last resorts, each beside those that were taken
constexpr int kMostOneByOne = 100;  ///< effects after which the search for sets of them gains more than a further one
constexpr double kOutlier = 0.05;   ///< root of a pose's weight below which it counts as far out
constexpr std::size_t kMostPosesForFormulas = 5000;  ///< thousands of formulas over more take minutes

class ClosedLoop {
 public:
  ClosedLoop(const DiagnosisProblem& problem, const LoopOptions& options, const RoundWatcher& watch)
      : problem_(problem), options_(options), watch_(watch) {}

  LoopResult run(DiagnosedModel start);

 private:
  Evidence evidence_here() const;
  void make_candidates(const Linearization& linearization);
  void measure_pure_error(const Linearization& linearization) {
    measure_lack_of_fit(problem_, model_, linearization, start_excess_, outcome_);
  }
  GroupRules rules() const;
  int most_one_by_one() const { return std::min(options_.max_effects, kMostOneByOne + held_at_start_); }
  std::vector<bool> excluded_candidates() const;
  void estimate_noise() {
    if (options_.noise) model_ = with_noise_known(problem_, std::move(model_), group_ == 0);
  }
  bool run_group(const Linearization& linearization);
  void run_groups(Linearization& linearization, LoopResult& result);
  bool offer_last_resorts(const Linearization& linearization);
  StopReason reason_to_stop(const GroupOutcome& last) const;
  Linearization choose_explanation(const Linearization& linearization, LoopResult& result);
  Linearization choose_explanation(Linearization linearization, const ExplanationSearch& search, LoopResult& result);
  void finish(const Linearization& linearization);
  RandomStream random(RandomPurpose purpose) const {
    return RandomStream{options_.seed, number_of(purpose), static_cast<std::uint64_t>(group_)};
  }
  RandomStream random_of_loop(RandomPurpose purpose) const {
    return RandomStream{options_.seed, number_of(purpose), 0};
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
  std::vector<Candidate> last_resorts_;  ///< in the order in which they were found
  EffectColumns columns_;
  std::vector<double> null_maxima_;
  std::optional<double> start_excess_;  ///< mean square of the residual above that of repeats, m^2
  double p_structure_ = 1.0;
  int group_ = 0, held_at_start_ = 0;
  bool interrupted_ = false;  ///< by the watcher
};

Evidence ClosedLoop::evidence_here() const {
  Evidence evidence = evidence_of(problem_.data, problem_.fitted);
  evidence.highest_ratio = options_.highest_ratio;
  evidence.stated_ratios = options_.stated_ratios;
  return evidence;
}

void ClosedLoop::make_candidates(const Linearization& linearization) {
  const Evidence evidence = evidence_here();
  outcome_.untestable = untestable_kinds(evidence, options_.kinds);
  outcome_.considered = options_.kinds;
  const bool formulas = options_.formulas && problem_.fitted.size() <= kMostPosesForFormulas;
  candidates_ =
      candidates_for(problem_.data.robot, evidence, problem_.declared, {options_.kinds, formulas, options_.decoys});
  const auto decoys =
      std::ranges::find_if(candidates_, [](const Candidate& c) { return c.decoy_kind != DecoyKind::none; });
  std::vector<Candidate> found = options_.evolved;
  for (Candidate& candidate : found) set_measured_ranges(candidate.effect, problem_.data.robot, evidence);
  std::ranges::copy(last_resorts_, std::back_inserter(found));
  candidates_.insert(decoys, found.begin(), found.end());
  outcome_.candidates = static_cast<int>(std::ranges::count(candidates_, DecoyKind::none, &Candidate::decoy_kind));
  if (outcome_.decoys.empty())
    for (const Candidate& candidate : candidates_)
      if (candidate.decoy_kind != DecoyKind::none) outcome_.decoys.push_back({.name = decoy_name(candidate)});
  const std::vector<ArmState>& states = linearization.fitted.states;
  const DecoyStates of_decoys{
      with_shuffled(states, DecoyKind::shuffled_approach, random_of_loop(RandomPurpose::shuffled_approach)),
      with_shuffled(states, DecoyKind::shuffled_temperature, random_of_loop(RandomPurpose::shuffled_temperature))};
  columns_ = EffectColumns();
  columns_.append(sampled_effects(candidates_, states, of_decoys), problem_.data.robot);
  columns_.pack();
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

StopReason ClosedLoop::reason_to_stop(const GroupOutcome& last) const {
  if (last.winning_decoy) return StopReason::decoy;
  return last.not_significant ? StopReason::no_structure : StopReason::no_gain;
}

/// Whether anything was added and more may follow.
bool ClosedLoop::run_group(const Linearization& linearization) {
  Group group(problem_, model_, linearization, candidates_, columns_, excluded_candidates(), null_maxima_, rules());
  GroupOutcome outcome = group.run(watch_);
  group.record_decoys(outcome, outcome_.decoys);
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

/// Group after group, until no more may follow.
void ClosedLoop::run_groups(Linearization& linearization, LoopResult& result) {
  for (++group_; group_ <= kMostGroups; ++group_) {
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
}

/// Whether laws that are a last resort explain any structure that is left: from here on they are tried too.
bool ClosedLoop::offer_last_resorts(const Linearization& linearization) {
  if (interrupted_ || p_structure_ > options_.family_error) return false;
  const Evidence evidence = evidence_here();
  const LastResort search{
      problem_, evidence, options_.kinds, options_.family_error, options_.null_draws, options_.work.do_work};
  if (!add_last_resorts(search, model_, linearization, random(RandomPurpose::last_resort), last_resorts_)) return false;
  make_candidates(linearization);
  null_maxima_.clear();
  return true;
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
  run_groups(linearization, result);
  for (int offers = 0; offers < kMostOffers && offer_last_resorts(linearization); ++offers)
    run_groups(linearization, result);
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
