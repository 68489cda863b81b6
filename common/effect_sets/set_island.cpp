#include "effect_sets/set_island.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "errors/check.hpp"
#include "primitives/elementary.hpp"

namespace demecal::inline effect_sets {
namespace {

/// Of the island's stream: streams are numbered against the ring, so that an island takes from the next by number.
std::uint64_t number_in_ring(IslandKey key) {
  return (kSetIslands - key.deme) % kSetIslands;
}

}  // namespace

SetIsland::SetIsland(const ExplanationProblem& problem, const SetSearch& search, IslandKey key)
    : problem_(problem), search_(search), key_(key), random_(own_stream()) {
  const FittedSet first(problem, search.known);
  for (std::size_t i = 0; i < problem.spans.size(); ++i) prices_nats_.push_back(first.price_nats(i));
  most_columns_ = std::max(first.columns(), static_cast<Eigen::Index>(search.search.most_freedom * problem.freedom));
  search_.search.most_causes = std::max(search.search.most_causes, first.causes().size());
  search_.search.most_effects = std::max(search.search.most_effects, search.known.size());
}

RandomStream SetIsland::own_stream() const {
  return RandomStream{search_.stream, number_in_ring(key_)};
}

bool SetIsland::note(const FittedSet& set) {
  const std::size_t causes = set.causes().size();
  if (causes > search_.search.most_causes || set.columns() > most_columns_ ||
      set.effects().size() > search_.search.most_effects)
    return false;
  std::vector<FittedSet>& kept = kept_[causes];
  const double nats = set.description_nats();
  constexpr double kSame_nats = 1e-6;
  const auto same = [&](const FittedSet& other) { return std::abs(other.description_nats() - nats) < kSame_nats; };
  if (std::ranges::any_of(kept, same)) return false;
  if (kept.size() == kSetsKept && nats >= kept.back().description_nats()) return false;
  // Afresh, so that rounding does not gather over generations.
  FittedSet afresh(problem_, set.effects());
  const auto place =
      std::ranges::find_if(kept, [&](const FittedSet& other) { return nats < other.description_nats(); });
  kept.insert(place, std::move(afresh));
  if (kept.size() > kSetsKept) kept.pop_back();
  return true;
}

const FittedSet& SetIsland::any_kept() {
  auto at = kept_.begin();
  std::advance(at, random_.index(kept_.size()));
  return at->second[random_.index(at->second.size())];
}

std::vector<std::size_t> SetIsland::promising(const FittedSet& set, bool of_its_causes) const {
  const std::vector<std::size_t> causes = set.causes();
  std::vector<std::size_t> choice;
  std::vector<ColumnSpan> columns;  // of the choice
  for (std::size_t i = 0; i < problem_.spans.size(); ++i) {
    const ColumnSpan& span = problem_.spans[i];
    if (span.count == 0 || (of_its_causes && !std::ranges::binary_search(causes, problem_.cause[i]))) continue;
    choice.push_back(i);
    if (columns.empty() || columns.back().first + columns.back().count != span.first)
      columns.push_back({span.first, 0});
    columns.back().count += span.count;
  }
  std::vector<bool> held(problem_.spans.size());
  for (const std::size_t effect : set.effects()) held[effect] = true;
  const Eigen::VectorXd left = set.moments_left(columns);
  std::vector<std::pair<double, std::size_t>> gains;
  for (const std::size_t i : choice) {
    if (held[i]) continue;
    const ColumnSpan& span = problem_.spans[i];
    const double share = std::min(left.segment(span.first, span.count).squaredNorm() / set.squares(), 0.99);
    gains.emplace_back(-0.5 * problem_.rows * protected_logarithm(1.0 - share) - prices_nats_[i], i);
  }
  const auto most = static_cast<std::ptrdiff_t>(std::min(kPromising, gains.size()));
  std::partial_sort(gains.begin(), gains.begin() + most, gains.end(), std::greater{});
  std::vector<std::size_t> best;
  for (std::ptrdiff_t i = 0; i < most; ++i) best.push_back(gains[static_cast<std::size_t>(i)].second);
  return best;
}

void SetIsland::add_promising(FittedSet& set, bool of_its_causes) {
  const std::vector<std::size_t> choice = promising(set, of_its_causes);
  if (!choice.empty()) set.add(choice[random_.index(choice.size())]);
}

/// Another of the same cause, near by in the order of proposals: the next ratio, another form.
void SetIsland::exchange_neighbour(FittedSet& set) {
  if (set.effects().empty()) return;
  const std::size_t place = random_.index(set.effects().size()), present = set.effects()[place];
  constexpr std::ptrdiff_t kFarthest = 3;
  std::vector<std::size_t> choice;
  for (std::ptrdiff_t step = -kFarthest; step <= kFarthest; ++step) {
    const std::ptrdiff_t other = static_cast<std::ptrdiff_t>(present) + step;
    if (other < 0 || other >= std::ssize(problem_.spans)) continue;
    const auto index = static_cast<std::size_t>(other);
    if (problem_.cause[index] == problem_.cause[present] && !set.holds(index)) choice.push_back(index);
  }
  if (choice.empty()) return;
  set.remove(place);
  set.add(choice[random_.index(choice.size())]);
}

void SetIsland::leave_out_a_cause(FittedSet& set) {
  if (!set.effects().empty()) set.remove_cause(problem_.cause[set.effects()[random_.index(set.effects().size())]]);
}

/// Every cause as the one or the other has it.
FittedSet SetIsland::mixed(const FittedSet& one, const FittedSet& other) {
  std::set<std::size_t> causes;
  for (const FittedSet* set : {&one, &other})
    for (const std::size_t cause : set->causes()) causes.insert(cause);
  std::vector<std::size_t> both;
  for (const std::size_t cause : causes) {
    const FittedSet& from = random_.chance(0.5) ? one : other;
    std::ranges::copy_if(from.effects(), std::back_inserter(both),
                         [&](std::size_t effect) { return problem_.cause[effect] == cause; });
  }
  return {problem_, std::move(both)};
}

/// Adds what its causes still lack, the best first, as long as that shortens the description.
void SetIsland::fill(FittedSet& set, int most) {
  for (int i = 0; i < most; ++i) {
    const std::vector<std::size_t> choice = promising(set, true);
    if (choice.empty() || !set.add_if_shorter(choice.front())) return;
  }
}

FittedSet SetIsland::varied() {
  constexpr double kMixed = 0.15, kAdded = 0.35, kNeighbour = 0.50, kCauseOut = 0.65;
  const double draw = random_.real();
  FittedSet set = any_kept();
  if (draw < kMixed) {
    set = mixed(set, any_kept());
  } else if (draw < kAdded) {
    add_promising(set, random_.chance(0.5));
  } else if (draw < kNeighbour) {
    exchange_neighbour(set);
  } else {
    if (draw < kCauseOut) {
      leave_out_a_cause(set);
    } else if (!set.effects().empty()) {
      set.remove(random_.index(set.effects().size()));
    }
    add_promising(set, random_.chance(0.5));
  }
  constexpr int kMostFilled = 4;
  fill(set, kMostFilled);
  while (const auto least = set.least_worth()) set.remove(*least);
  return set;
}

void SetIsland::settle() {
  FittedSet set(problem_, search_.known);
  note(FittedSet(problem_));
  note(set);
  while (!set.effects().empty()) {
    std::optional<FittedSet> best;
    for (const std::size_t cause : set.causes()) {
      FittedSet less = set;
      less.remove_cause(cause);
      if (!best || less.description_nats() < best->description_nats()) best = std::move(less);
    }
    set = std::move(*best);
    note(set);
  }
}

SetIsland SetIsland::settled_at(IslandKey key) const {
  SetIsland island = *this;
  island.key_ = key;
  island.random_ = island.own_stream();
  return island;
}

/// All variations are divided among islands and epochs as evenly as can be.
int SetIsland::variations_of_epoch() const {
  constexpr int kShares = static_cast<int>(kSetIslands * kSetEpochs);
  const int place = static_cast<int>(state_.epoch * kSetIslands + number_in_ring(key_));
  return search_.search.variations / kShares + (place < search_.search.variations % kShares ? 1 : 0);
}

void SetIsland::run_epoch(const Population& immigrants, const std::function<void()>& after_variation) {
  DEMECAL_CHECK(!finished(), "epoch=" << state_.epoch << " of " << kSetEpochs);
  if (kept_.empty()) enter_sets();
  for (const Individual& immigrant : immigrants) state_.migrants_taken += note(fitted_set(problem_, immigrant)) ? 1 : 0;
  const int variations = variations_of_epoch();
  for (int i = 0; i < variations; ++i) {
    note(varied());
    if (after_variation) after_variation();
  }
  state_.evaluations += static_cast<std::uint64_t>(variations);
  state_.generation = state_.epoch++;
  state_.draws = random_.drawn();
  state_.population.clear();
  for (const auto& [causes, sets] : kept_)
    for (const FittedSet& set : sets) state_.population.push_back(individual(set));
  state_.front = emigrants();
}

std::vector<const FittedSet*> SetIsland::elite() const {
  std::vector<const FittedSet*> best;
  for (const auto& [causes, sets] : kept_) best.push_back(&sets.front());
  return best;
}

Population SetIsland::emigrants() const {
  Population population;
  for (const FittedSet* set : elite()) population.push_back(individual(*set));
  return population;
}

const FittedSet* SetIsland::best() const {
  const std::vector<const FittedSet*> all = elite();
  const auto best = std::ranges::min_element(all, {}, &FittedSet::description_nats);
  return best == all.end() ? nullptr : *best;
}

IslandFigures SetIsland::figures() const {
  if (state_.population.empty()) return {};
  std::vector<Individual> ranked = state_.population;
  std::ranges::sort(ranked, {}, &Individual::fitness);
  return {ranked.front().fitness, ranked[(ranked.size() - 1) / 2].fitness,
          static_cast<std::uint32_t>(ranked.front().effects.size()), 1.0};
}

std::vector<std::size_t> SetIsland::causes_of_best() const {
  const FittedSet* const shortest = best();
  return shortest == nullptr ? std::vector<std::size_t>{} : shortest->causes();
}

void SetIsland::restore(const IslandState& state) {
  state_ = state;
  kept_.clear();
}

// The first sets, or those of a state that another worker reached.
void SetIsland::enter_sets() {
  if (state_.epoch == 0) return settle();
  for (const Individual& one : state_.population) {
    FittedSet set = fitted_set(problem_, one);
    kept_[set.causes().size()].push_back(std::move(set));
  }
  random_ = own_stream();
  random_.skip(state_.draws);
}

Individual SetIsland::individual(const FittedSet& set) const {
  const double fitness = bounded_exponential(set.description_nats() / problem_.rows);
  return {.tree = {},
          .fitness = std::isfinite(fitness) ? fitness : std::numeric_limits<double>::infinity(),
          .effects = {set.effects().begin(), set.effects().end()}};
}

FittedSet fitted_set(const ExplanationProblem& problem, const Individual& individual) {
  return {problem, {individual.effects.begin(), individual.effects.end()}};
}

}  // namespace demecal::inline effect_sets
