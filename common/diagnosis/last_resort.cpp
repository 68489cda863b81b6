#include "diagnosis/last_resort.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>

#include "diagnosis/group.hpp"
#include "diagnosis/scan.hpp"

namespace demecal::inline diagnosis {
namespace {

EffectColumns columns_tried(const std::vector<Candidate>& candidates, const LastResort& search,
                            const Linearization& linearization) {
  std::vector<Effect> effects;
  for (const Candidate& candidate : candidates) effects.push_back(candidate.effect);
  EffectColumns columns;
  columns.append(effects, search.problem.data.robot, linearization.fitted.states);
  columns.pack();
  return columns;
}

Scan scan_of(const std::vector<Candidate>& candidates, const EffectColumns& columns, const LastResort& search,
             const Linearization& linearization) {
  return {columns, naming_costs_nats(candidates), linearization.fitted, linearization.projection, search.do_work};
}

constexpr double kSame_nats = 1e-6;

/// Effects of which each is next to that before, and what they gain.
struct Neighbours {
  std::vector<Candidate> all;
  std::vector<Score> scores;
};

Neighbours finer_neighbours(const Effect& effect, const LastResort& search, const Linearization& linearization) {
  Neighbours finer;
  for (Effect& proposal : law_of(effect).finer_proposals(effect, search.evidence)) {
    set_measured_ranges(proposal, search.problem.data.robot, search.evidence);
    finer.all.push_back({.effect = std::move(proposal)});
  }
  const EffectColumns columns = columns_tried(finer.all, search, linearization);
  finer.scores = scan_of(finer.all, columns, search, linearization).scores();
  return finer;
}

/// The last of the neighbours of `effect` that follow it (or stand before it) without a break and gain as much.
Effect end_of_plateau(Effect effect, bool following, double gain_nats, const LastResort& search,
                      const Linearization& linearization) {
  constexpr int kMostSteps = 50;
  for (int step = 0; step < kMostSteps; ++step) {
    Neighbours finer = finer_neighbours(effect, search, linearization);
    if (!following) {
      std::ranges::reverse(finer.all);
      std::ranges::reverse(finer.scores);
    }
    std::size_t end = finer.all.size() / 2;
    while (end + 1 < finer.all.size() && finer.scores[end + 1].gain_nats > gain_nats - kSame_nats) ++end;
    effect = finer.all[end].effect;
    if (end + 1 < finer.all.size()) break;
  }
  return effect;
}

/// An effect between those that explain most, and what these gain.
struct Placed {
  Effect effect;
  double gain_nats = 0.0;
};

Placed at_best_place(const Effect& effect, const LastResort& search, const Linearization& linearization) {
  const Neighbours finer = finer_neighbours(effect, search, linearization);
  const auto best = std::ranges::max_element(finer.scores, {}, &Score::gain_nats) - finer.scores.begin();
  const Effect& one = finer.all[static_cast<std::size_t>(best)].effect;
  const double gain_nats = finer.scores[static_cast<std::size_t>(best)].gain_nats;
  return {law_of(effect).between(end_of_plateau(one, false, gain_nats, search, linearization),
                                 end_of_plateau(one, true, gain_nats, search, linearization)),
          gain_nats};
}

std::vector<Candidate> best_of_joints(const LastResort& search, const Linearization& linearization,
                                      const RandomStream& random) {
  constexpr double kLeastShare = 0.1;
  constexpr std::size_t kPlaced = 8;  // of a joint: coarse places alone do not say which is the best
  const std::vector<Candidate> tried =
      candidates_for(search.problem.data.robot, search.evidence, search.problem.declared,
                     {.kinds = search.kinds, .formulas = false, .decoys = false, .last_resort = true});
  if (tried.empty()) return {};
  const EffectColumns columns = columns_tried(tried, search, linearization);
  const Scan scan = scan_of(tried, columns, search, linearization);
  const std::vector<Score> scores = scan.scores();
  const auto explains_enough = [&](const Score& score) {
    return score.drop > kLeastShare * linearization.projection.squares();
  };
  if (std::ranges::none_of(scores, explains_enough)) return {};
  const std::vector<double> null = scan.null_maxima(columns, linearization.fitted, linearization.projection,
                                                    search.null_draws, random, search.do_work);
  std::map<int, std::vector<std::size_t>> evident;  // by joint
  for (std::size_t i = 0; i < tried.size(); ++i)
    if (explains_enough(scores[i]) && family_p_value(null, scores[i].gain_nats) <= search.family_error)
      evident[tried[i].effect.joint].push_back(i);
  std::vector<Candidate> found;
  for (auto& [joint, places] : evident) {
    std::ranges::stable_sort(places, std::greater{}, [&](std::size_t i) { return scores[i].gain_nats; });
    places.resize(std::min(places.size(), kPlaced));
    std::vector<Placed> placed;
    for (const std::size_t i : places) placed.push_back(at_best_place(tried[i].effect, search, linearization));
    found.push_back({.effect = std::ranges::max_element(placed, {}, &Placed::gain_nats)->effect,
                     .naming_cost_nats = std::log(static_cast<double>(tried.size()))});
  }
  return found;
}

}  // namespace

bool add_last_resorts(const LastResort& search, const DiagnosedModel& model, const Linearization& linearization,
                      RandomStream random, std::vector<Candidate>& known) {
  const std::size_t before = known.size();
  const auto add = [&](const Linearization& about) {
    for (Candidate& found : best_of_joints(search, about, random)) {
      const auto is_it = [&](const Candidate& other) { return other.effect.same_law_as(found.effect); };
      if (std::ranges::none_of(known, is_it)) known.push_back(std::move(found));
    }
  };
  add(linearization);
  std::vector<bool> harmonics;
  for (const Effect& effect : model.robot.effects) harmonics.push_back(law_of(effect).is_harmonic());
  if (std::ranges::count(harmonics, true) > 0) add(linearize_without(search.problem, model, harmonics));
  return known.size() > before;
}

}  // namespace demecal::inline diagnosis
