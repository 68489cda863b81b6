#include "diagnosis/explain.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "data/data_set.hpp"
#include "diagnosis/judgement.hpp"
#include "diagnosis/rival_exchange.hpp"
#include "diagnosis/scan.hpp"
#include "effect_sets/fitted_set.hpp"
#include "effects/effect.hpp"
#include "explanations/causes.hpp"
#include "explanations/set_models.hpp"
#include "next_measurement/next_measurement.hpp"
#include "pieces/pieces.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline diagnosis {
namespace {

using Places = std::vector<std::size_t>;

bool was_implausible(const LoopEnd& end, const Effect& effect) {
  return std::ranges::any_of(end.rounds,
                             [&](const Round& round) { return round.implausible && round.effect.same_law_as(effect); });
}

/// The candidates of each cause, the one that gains most first.
std::vector<Places> ranked_by_cause(const LoopEnd& end, const std::vector<Score>& scores) {
  std::vector<ErrorCause> causes;
  std::vector<Places> places;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (was_implausible(end, end.candidates[i].effect) || end.candidates[i].decoy_kind != DecoyKind::none ||
        scores[i].rank == 0)
      continue;
    const ErrorCause own = cause_at(end.candidates[i].effect.kind, end.candidates[i].effect.joint);
    const auto known = std::ranges::find_if(causes, [&](const ErrorCause& one) { return one.is_same_as(own); });
    const auto cause = static_cast<std::size_t>(known - causes.begin());
    if (known == causes.end()) {
      causes.push_back(own);
      places.emplace_back();
    }
    places[cause].push_back(i);
  }
  for (Places& own : places)
    std::ranges::stable_sort(own, std::greater{}, [&](std::size_t i) { return scores[i].gain_nats; });
  return places;
}

/// Which candidates the search looks at: those of the model, and of every cause those that gain most beside the model
/// and those that do without any effect; fewer where there are so many rows that the products of all columns would take
/// long.
std::vector<PricedEffect> preselected(const LoopEnd& end, const std::vector<std::vector<Score>>& scores) {
  constexpr double kMostProducts = 4e10;    ///< of rows and pairs of columns
  constexpr std::size_t kMostOfCause = 40;  ///< by each of the scores
  const auto rows = static_cast<double>(end.linearization.fitted.rows());
  const auto most_columns = static_cast<Eigen::Index>(std::sqrt(kMostProducts / rows));
  std::set<std::size_t> taken;
  Eigen::Index columns = 0;
  const auto take = [&](std::size_t i) {
    if (taken.insert(i).second) columns += end.columns.spans()[i].count;
  };
  for (std::size_t i = 0; i < end.candidates.size(); ++i) {
    const auto is_it = [&](const Effect& effect) { return effect.same_law_as(end.candidates[i].effect); };
    if (end.candidates[i].decoy_kind == DecoyKind::none && std::ranges::any_of(end.model.robot.effects, is_it)) take(i);
  }
  std::vector<std::vector<Places>> ranked;
  for (const std::vector<Score>& each : scores) ranked.push_back(ranked_by_cause(end, each));
  for (std::size_t rank = 0; rank < kMostOfCause; ++rank)
    for (const std::vector<Places>& causes : ranked)
      for (const Places& own : causes)
        if (rank < own.size() && columns < most_columns) take(own[rank]);
  std::vector<PricedEffect> effects;
  for (const std::size_t i : taken) effects.push_back({end.candidates[i].effect, end.candidates[i].naming_cost_nats});
  return effects;
}

std::vector<Score> scores_beside(const LoopEnd& end, const Linearization& linearization) {
  return Scan(end.columns, naming_costs_nats(end.candidates), linearization.fitted, linearization.projection,
              end.rules.do_work)
      .scores();
}

/// What the search may use: the model's effects, and candidates where there is to be any variation.
std::vector<PricedEffect> searched_effects(const LoopEnd& end, bool vary) {
  // An effect must gain what noise alone hardly gives.
  const std::size_t most = end.null_maxima.size();
  const double least_gain_nats =
      most == 0 ? 0.0
                : std::max(0.0, end.null_maxima[static_cast<std::size_t>((1.0 - end.rules.family_error) *
                                                                         static_cast<double>(most - 1))]);

  std::vector<PricedEffect> effects;
  if (vary) {
    const std::vector<bool> all(end.model.robot.effects.size(), true);
    effects = preselected(end, {scores_beside(end, linearize_without(end.problem, end.model, all)),
                                scores_beside(end, end.linearization)});
  } else {
    for (const Effect& effect : end.model.robot.effects)
      effects.push_back({effect, naming_cost_nats(effect, end.candidates)});
  }
  for (PricedEffect& one : effects) one.naming_cost_nats += least_gain_nats;
  return effects;
}

/// Takes effects out that some of the sets hold in a size that no real arm has; whether there were any.
bool leave_out_implausible(const LoopEnd& end, const SetModels& models, const std::vector<EffectSet>& sets,
                           std::vector<PricedEffect>& effects) {
  const auto& states = end.linearization.fitted.states;
  std::vector<std::vector<Effect>> found(sets.size());
  in_pieces(sets.size(), [&](std::size_t i) {
    DiagnosedModel model = models.with(sets[i].effects);
    for (Effect& effect : model.robot.effects)
      if (is_implausibly_large(effect, end.problem.data.robot, states)) found[i].push_back(std::move(effect));
  });
  std::vector<Effect> implausible;
  for (const std::vector<Effect>& own : found) std::ranges::copy(own, std::back_inserter(implausible));
  const auto is_out = [&](const PricedEffect& one) {
    const auto is_it = [&](const Effect& other) { return other.same_law_as(one.effect); };
    return std::ranges::any_of(implausible, is_it) && std::ranges::none_of(end.model.robot.effects, is_it);
  };
  return std::erase_if(effects, is_out) > 0;
}

/// By number of causes: what is left of the model, and then what evolution found that is shorter, by as much as tells
/// rivals apart, than all these of fewer causes and what is left of the model with as many.
std::vector<EffectSet> worth_having(std::vector<EffectSet> pruned, const std::vector<EffectSet>& evolved) {
  std::vector<EffectSet> found;
  double shortest = std::numeric_limits<double>::infinity();
  for (const EffectSet& set : evolved) {
    for (const EffectSet& left : pruned)
      if (left.causes <= set.causes) shortest = std::min(shortest, left.description_nats);
    if (set.description_nats > shortest - kNatsToDistinguish) continue;
    shortest = set.description_nats;
    found.push_back(set);
  }
  std::ranges::move(found, std::back_inserter(pruned));
  std::ranges::stable_sort(pruned, {}, &EffectSet::causes);
  return pruned;
}

/// Leaves effects out of the chosen model that the present one lacks and that do not stand the judgement.
void judge_new_effects(const LoopEnd& end, const SetModels& models, const std::vector<PricedEffect>& effects,
                       const std::function<bool(const Round&)>& watch, Explained& found) {
  constexpr int kSteps = 3;
  const std::vector<std::size_t>& set = found.front.points[found.front.chosen].set;
  found.model = model_of(end.problem, models, found.front.points[found.front.chosen]);
  found.rounds = judged_together(end, found.model);
  const FittedSet fitted(models.problem(), set);
  in_pieces(found.rounds.size(), [&](std::size_t i) {
    Round& round = found.rounds[i];
    const auto place =
        std::ranges::find_if(set, [&](std::size_t effect) { return effects[effect].effect.same_law_as(round.effect); });
    round.rivals = rivals_beside(fitted, static_cast<std::size_t>(place - set.begin()), effects);
  });
  for (const Round& round : found.rounds) {
    found.stopped = found.stopped || (watch && !watch(round));
    if (round.verdict == Verdict::added) continue;
    std::erase_if(found.model.robot.effects, [&](const Effect& effect) { return effect.same_law_as(round.effect); });
  }
  if (std::ranges::any_of(found.rounds, [](const Round& round) { return round.verdict != Verdict::added; }))
    found.model = refined(end.problem, std::move(found.model), kSteps);
}

/// Sets of effects by number of causes, and what they are places among.
struct SearchedSets {
  std::vector<PricedEffect> effects;
  SetModels models;
  std::vector<EffectSet> sets;
};

/// Evolution begins anew without effects that it made larger than any arm's.
SearchedSets searched_sets(const LoopEnd& end, const ExplanationSearch& search, const RandomStream& random) {
  constexpr int kMostAttempts = 10;
  const bool vary = search.variations > 0;
  std::vector<PricedEffect> effects = searched_effects(end, vary);
  for (int attempt = 1;; ++attempt) {
    SetModels models(end.problem, end.model, effects);
    std::vector<EffectSet> sets = prunings(models.problem(), models.held());
    if (!vary || attempt == kMostAttempts) return {std::move(effects), std::move(models), std::move(sets)};
    const auto evolved = end.search_explanations(models.problem(), set_search(models.held(), search, random));
    if (leave_out_implausible(end, models, evolved, effects)) continue;
    sets = worth_having(std::move(sets), evolved);
    return {std::move(effects), std::move(models), std::move(sets)};
  }
}

}  // namespace

Explained explained(const LoopEnd& end, const ExplanationSearch& search, const RandomStream& random,
                    const std::function<bool(const Round&)>& watch) {
  const SearchedSets searched = searched_sets(end, search, random);
  Explained found{.front = judged_front(end.problem, end.model, searched.models, searched.effects, searched.sets),
                  .model = end.model,
                  .best = {},
                  .rounds = {}};
  if (search.variations > 0) {
    const std::vector<std::size_t>& chosen = found.front.points[found.front.chosen].set;
    std::vector<std::size_t> better = with_better_rivals(end.problem, searched.models, searched.effects, chosen);
    if (better != chosen) choose_set(end.problem, end.model, searched.models, std::move(better), found.front);
  }
  const auto set_of = [&](std::size_t point) -> const std::vector<std::size_t>& {
    return found.front.points[point].set;
  };
  const auto is_present = [&](std::size_t point) { return set_of(point) == searched.models.held(); };
  if (!is_present(found.front.chosen)) {
    judge_new_effects(end, searched.models, searched.effects, watch, found);
    if (!found.rounds.empty() && !does_as_well(end.problem, found.model, end.model))
      return explained(end, {.variations = 0}, random, watch);
  }
  if (found.front.best != found.front.chosen)
    found.best = is_present(found.front.best)
                     ? end.model
                     : model_of(end.problem, searched.models, found.front.points[found.front.best]);
  return found;
}

}  // namespace demecal::inline diagnosis
