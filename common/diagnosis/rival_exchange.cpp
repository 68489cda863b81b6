#include "diagnosis/rival_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "data/data_set.hpp"
#include "diagnosis/scan.hpp"
#include "effects/effect.hpp"
#include "explanations/explanation_front.hpp"
#include "random/distributions.hpp"

namespace demecal::inline diagnosis {
namespace {

using Places = std::vector<std::size_t>;

constexpr int kSteps = 3;

/// Of every effect of the set, the places of its rivals among the effects.
std::vector<Places> rivals_of_set(const SetModels& models, const std::vector<PricedEffect>& effects,
                                  const Places& set) {
  const FittedSet fitted(models.problem(), set);
  std::vector<Places> rivals(set.size());
  for (std::size_t place = 0; place < set.size(); ++place)
    for (const Rival& rival : rivals_beside(fitted, place, effects)) {
      const auto is_it = [&](const PricedEffect& one) { return one.effect.same_law_as(rival.effect); };
      rivals[place].push_back(static_cast<std::size_t>(std::ranges::find_if(effects, is_it) - effects.begin()));
    }
  return rivals;
}

void leave_out_worthless(FittedSet& set) {
  while (const auto worst = set.least_worth()) set.remove(*worst);
}

/// What one look at the poses that may choose has of the set and its rivals.
class Exchange {
 public:
  Exchange(const DiagnosisProblem& all, const SetModels& models, const std::vector<PricedEffect>& effects,
           const Places& set)
      : all_(all),
        rivals_(rivals_of_set(models, effects, set)),
        places_(places_of(set, rivals_)),
        present_(refined(all, models.with(set), kSteps)),
        models_(all, present_, effects_at(effects, places_)) {
    for (std::size_t i = 0; i < set.size(); ++i) present_set_.push_back(i);
  }

  bool has_rivals() const { return places_.size() > present_set_.size(); }

  /// The set that is best to first order, as places among all effects; nothing where none is better than the present
  /// one, or where its refined model is not.
  std::optional<Places> better() const {
    const FittedSet present(models_.problem(), present_set_);
    FittedSet best = present;
    leave_out_worthless(best);
    bool is_exchanged = false;
    for (std::size_t place = 0; place < present_set_.size(); ++place)
      for (const std::size_t rival : rivals_[place]) {
        FittedSet other = present;
        other.remove(place);
        const auto local = static_cast<std::size_t>(std::ranges::find(places_, rival) - places_.begin());
        if (!other.holds(local)) other.add(local);
        leave_out_worthless(other);
        if (other.description_nats() >= best.description_nats()) continue;
        best = std::move(other);
        is_exchanged = true;
      }
    if (!is_exchanged || !is_better(best, present)) return std::nullopt;
    Places set;
    for (const std::size_t local : best.effects()) set.push_back(places_[local]);
    return set;
  }

 private:
  static Places places_of(const Places& set, const std::vector<Places>& rivals) {
    Places places = set;
    for (const Places& own : rivals)
      std::ranges::copy_if(own, std::back_inserter(places),
                           [&](std::size_t one) { return std::ranges::find(places, one) == places.end(); });
    return places;
  }
  static std::vector<PricedEffect> effects_at(const std::vector<PricedEffect>& effects, const Places& places) {
    std::vector<PricedEffect> own;
    for (const std::size_t place : places) own.push_back(effects[place]);
    return own;
  }
  double price_nats(const FittedSet& set) const {
    double price = 0.0;
    for (const std::size_t effect : set.effects()) price += set.price_nats(effect);
    return price;
  }
  bool is_better(const FittedSet& other, const FittedSet& present) const {
    const CorrectedRobot exchanged = refined(all_, models_.with(other.effects()), kSteps).robot;
    const std::vector<std::size_t> poses = judging_poses(all_, present_.robot);
    const auto squares = [&](const CorrectedRobot& robot) { return mean(squared_errors(all_.data, poses, robot)); };
    const double saved = 0.5 * models_.problem().rows * std::log(squares(exchanged) / squares(present_.robot));
    return saved + price_nats(other) - price_nats(present) < 0.0;
  }

  const DiagnosisProblem& all_;
  std::vector<Places> rivals_;  ///< of each effect of the set
  Places places_;               ///< among all effects: the set's, then its rivals'
  Places present_set_;          ///< among places_
  DiagnosedModel present_;
  SetModels models_;
};

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
  constexpr int kMostExchanges = 6;
  if (problem.validation.empty()) return set;
  DiagnosisProblem all{problem.data, problem.declared, problem.fitted, {}};
  std::ranges::copy(problem.validation, std::back_inserter(all.fitted));
  std::ranges::sort(all.fitted);
  for (int i = 0; i < kMostExchanges; ++i) {
    const Exchange exchange(all, models, effects, set);
    auto better = exchange.has_rivals() ? exchange.better() : std::nullopt;
    if (!better) break;
    set = *std::move(better);
  }
  return set;
}

}  // namespace demecal::inline diagnosis
