#include "diagnosis/rival_exchange.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "data/data_set.hpp"
#include "diagnosis/scan.hpp"
#include "effects/effect.hpp"
#include "explanations/explanation_front.hpp"
#include "pieces/pieces.hpp"

namespace demecal::inline diagnosis {
namespace {

using Places = std::vector<std::size_t>;

/// Of every effect of the set, the places of its rivals among the effects.
std::vector<Places> rivals_of_set(const SetModels& models, const std::vector<PricedEffect>& effects,
                                  const Places& set) {
  const FittedSet fitted(models.problem(), set);
  std::vector<Places> rivals(set.size());
  in_pieces(set.size(), [&](std::size_t place) {
    for (const Rival& rival : rivals_beside(fitted, place, effects)) {
      const auto is_it = [&](const PricedEffect& one) { return one.effect.same_law_as(rival.effect); };
      rivals[place].push_back(static_cast<std::size_t>(std::ranges::find_if(effects, is_it) - effects.begin()));
    }
  });
  return rivals;
}

void leave_out_worthless(FittedSet& set) {
  while (const auto worst = set.least_worth()) set.remove(*worst);
}

Places with_rivals(const Places& set, const std::vector<Places>& rivals) {
  Places places = set;
  for (const Places& own : rivals)
    std::ranges::copy_if(own, std::back_inserter(places),
                         [&](std::size_t one) { return std::ranges::find(places, one) == places.end(); });
  return places;
}

/// The set with one of its effects exchanged for a rival by which it is described shortest, worthless ones left out;
/// nothing where none is shorter. It does not come to more causes than a person reads. `rivals` are of the problem's
/// effects.
std::optional<FittedSet> with_one_exchange(const FittedSet& present, const std::vector<Places>& rivals) {
  const std::size_t most_causes = std::max(present.causes().size(), kReadableCauses);
  FittedSet best = present;
  leave_out_worthless(best);  // that needs no exchange
  std::optional<FittedSet> found;
  for (std::size_t place = 0; place < present.effects().size(); ++place)
    for (const std::size_t rival : rivals[present.effects()[place]]) {
      FittedSet other = present;
      other.remove(place);
      if (!other.holds(rival)) other.add(rival);
      leave_out_worthless(other);
      if (other.causes().size() > most_causes) continue;
      if (other.description_nats() < best.description_nats()) found = best = std::move(other);
    }
  return found;
}

}  // namespace

std::vector<Rival> rivals_beside(const FittedSet& set, std::size_t place, const std::vector<PricedEffect>& effects) {
  std::vector<Rival> rivals;
  const Effect& own = effects[set.effects()[place]].effect;
  for (const Alike& other : set.alike(place))
    if (is_rival(own, effects[other.effect].effect, other.cosine, other.nats_behind))
      rivals.push_back({effects[other.effect].effect, other.cosine, other.nats_behind});
  keep_nearest(rivals);
  return rivals;
}

std::vector<std::size_t> with_better_rivals(const DiagnosisProblem& problem, const SetModels& models,
                                            const std::vector<PricedEffect>& effects, std::vector<std::size_t> set) {
  constexpr int kMostExchanges = 6, kSteps = 1;
  if (problem.validation.empty()) return set;
  const std::vector<Places> rivals = rivals_of_set(models, effects, set);
  const Places places = with_rivals(set, rivals);
  if (places.size() == set.size()) return set;
  DiagnosisProblem all{problem.data, problem.declared, problem.fitted, {}};
  std::ranges::copy(problem.validation, std::back_inserter(all.fitted));
  std::ranges::sort(all.fitted);
  std::vector<PricedEffect> considered;
  for (const std::size_t place : places) considered.push_back(effects[place]);
  const SetModels models_of_all(all, refined(all, models.with(set), kSteps), considered);
  std::vector<Places> among_considered(places.size());  // rivals of rivals are not asked for
  for (std::size_t i = 0; i < set.size(); ++i)
    for (const std::size_t rival : rivals[i])
      among_considered[i].push_back(static_cast<std::size_t>(std::ranges::find(places, rival) - places.begin()));
  FittedSet present(models_of_all.problem(), models_of_all.held());
  bool is_changed = false;
  for (int i = 0; i < kMostExchanges; ++i) {
    auto better = with_one_exchange(present, among_considered);
    if (!better) break;
    present = *std::move(better);
    is_changed = true;
  }
  if (!is_changed) return set;
  set.clear();
  for (const std::size_t effect : present.effects()) set.push_back(places[effect]);
  return set;
}

}  // namespace demecal::inline diagnosis
