#include "explanations/explanation_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "pieces/pieces.hpp"

namespace demecal::inline explanations {
namespace {

constexpr std::size_t kIslands = 4;
constexpr int kEpochs = 10;

/// The sets that one island keeps.
class SetIsland {
 public:
  SetIsland(const ExplanationProblem& problem, const std::vector<std::size_t>& known, const ExplanationSearch& search,
            RandomStream random)
      : problem_(problem), search_(search), random_(std::move(random)) {
    const FittedSet first(problem, known);
    most_columns_ = std::max(first.columns(), static_cast<Eigen::Index>(search.most_freedom * problem.freedom));
    search_.most_causes = std::max(search.most_causes, first.causes().size());
    search_.most_effects = std::max(search.most_effects, known.size());
  }

  /// `known`, and what is left of it without the causes that are missed least, one after another.
  void begin_with(const std::vector<std::size_t>& known);
  /// The same sets at the start of other random numbers.
  SetIsland settled_by(RandomStream random) const;
  void vary(int variations);
  /// The best of every number of causes.
  std::vector<const FittedSet*> elite() const;
  void accept_immigrants(const SetIsland& neighbour);

 private:
  static constexpr std::size_t kKept = 4;        ///< sets of every number of causes
  static constexpr std::size_t kPromising = 12;  ///< effects among which an addition is drawn

  void note(const FittedSet& set);
  const FittedSet& any_kept();
  std::vector<std::size_t> promising(const FittedSet& set, bool of_its_causes) const;
  void add_promising(FittedSet& set, bool of_its_causes);
  void exchange_neighbour(FittedSet& set);
  void leave_out_a_cause(FittedSet& set);
  FittedSet mixed(const FittedSet& one, const FittedSet& other);
  void leave_out_what_earns_nothing(FittedSet& set) const;
  void fill(FittedSet& set, int most);
  FittedSet varied();

  const ExplanationProblem& problem_;
  ExplanationSearch search_;
  RandomStream random_;
  Eigen::Index most_columns_ = 0;
  std::map<std::size_t, std::vector<FittedSet>> kept_;  ///< by number of causes, the shortest description first
};

void SetIsland::note(const FittedSet& set) {
  const std::size_t causes = set.causes().size();
  if (causes > search_.most_causes || set.columns() > most_columns_ || set.effects().size() > search_.most_effects)
    return;
  std::vector<FittedSet>& kept = kept_[causes];
  const double nats = set.description_nats();
  constexpr double kSame_nats = 1e-6;
  const auto same = [&](const FittedSet& other) { return std::abs(other.description_nats() - nats) < kSame_nats; };
  if (std::ranges::any_of(kept, same)) return;
  if (kept.size() == kKept && nats >= kept.back().description_nats()) return;
  // Afresh, so that rounding does not gather over generations.
  FittedSet afresh(problem_, set.effects());
  const auto place =
      std::ranges::find_if(kept, [&](const FittedSet& other) { return nats < other.description_nats(); });
  kept.insert(place, std::move(afresh));
  if (kept.size() > kKept) kept.pop_back();
}

const FittedSet& SetIsland::any_kept() {
  auto at = kept_.begin();
  std::advance(at, random_.index(kept_.size()));
  return at->second[random_.index(at->second.size())];
}

std::vector<std::size_t> SetIsland::promising(const FittedSet& set, bool of_its_causes) const {
  const std::vector<std::size_t> causes = set.causes();
  const Eigen::VectorXd left = set.moments_left();
  std::vector<std::pair<double, std::size_t>> gains;
  for (std::size_t i = 0; i < problem_.spans.size(); ++i) {
    const ColumnSpan& span = problem_.spans[i];
    if (span.count == 0 || set.holds(i)) continue;
    if (of_its_causes && !std::ranges::binary_search(causes, problem_.cause[i])) continue;
    const double share = std::min(left.segment(span.first, span.count).squaredNorm() / set.squares(), 0.99);
    gains.emplace_back(-0.5 * problem_.rows * std::log1p(-share) - set.price_nats(i), i);
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
  FittedSet both(problem_);
  for (const std::size_t cause : causes) {
    const FittedSet& from = random_.chance(0.5) ? one : other;
    for (const std::size_t effect : from.effects())
      if (problem_.cause[effect] == cause) both.add(effect);
  }
  return both;
}

void SetIsland::leave_out_what_earns_nothing(FittedSet& set) const {
  for (;;) {
    std::optional<std::size_t> worst;
    double most = 0.0;
    for (std::size_t place = 0; place < set.effects().size(); ++place) {
      const double gain = set.gain_without(place);
      if (gain <= most) continue;
      most = gain;
      worst = place;
    }
    if (!worst) return;
    set.remove(*worst);
  }
}

/// Adds what its causes still lack, the best first, as long as that shortens the description.
void SetIsland::fill(FittedSet& set, int most) {
  for (int i = 0; i < most; ++i) {
    const std::vector<std::size_t> choice = promising(set, true);
    if (choice.empty()) return;
    FittedSet more = set;
    more.add(choice.front());
    if (more.description_nats() >= set.description_nats()) return;
    set = std::move(more);
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
  leave_out_what_earns_nothing(set);
  return set;
}

void SetIsland::begin_with(const std::vector<std::size_t>& known) {
  FittedSet set(problem_, known);
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

SetIsland SetIsland::settled_by(RandomStream random) const {
  SetIsland island = *this;
  island.random_ = std::move(random);
  return island;
}

void SetIsland::vary(int variations) {
  for (int i = 0; i < variations; ++i) note(varied());
}

std::vector<const FittedSet*> SetIsland::elite() const {
  std::vector<const FittedSet*> best;
  for (const auto& [causes, sets] : kept_) best.push_back(&sets.front());
  return best;
}

void SetIsland::accept_immigrants(const SetIsland& neighbour) {
  for (const FittedSet* set : neighbour.elite()) note(*set);
}

/// The best of all islands by number of causes; of equals that of the first island.
std::vector<EffectSet> front_of(const std::vector<SetIsland>& islands) {
  std::map<std::size_t, EffectSet> front;
  for (const SetIsland& island : islands) {
    for (const FittedSet* set : island.elite()) {
      EffectSet found{set->effects(), set->causes().size(), set->description_nats()};
      std::ranges::sort(found.effects);
      const auto [known, fresh] = front.emplace(found.causes, found);
      if (!fresh && found.description_nats < known->second.description_nats) known->second = std::move(found);
    }
  }
  std::vector<EffectSet> sets;
  for (auto& [causes, set] : front) sets.push_back(std::move(set));
  return sets;
}

/// How many of `variations` fall to the island in the epoch.
int share_of(int variations, std::size_t island, int epoch) {
  constexpr int kShares = static_cast<int>(kIslands) * kEpochs;
  const int place = epoch * static_cast<int>(kIslands) + static_cast<int>(island);
  return variations / kShares + (place < variations % kShares ? 1 : 0);
}

}  // namespace

std::vector<EffectSet> search_explanations(const ExplanationProblem& problem, const std::vector<std::size_t>& known,
                                           const ExplanationSearch& search, RandomStream random) {
  constexpr std::size_t kNames = std::size_t{1} << 53;
  SetIsland start(problem, known, search, random);
  start.begin_with(known);
  std::vector<SetIsland> islands;
  const std::uint64_t name = random.index(kNames);
  for (std::size_t i = 0; i < (search.variations > 0 ? kIslands : 1); ++i)
    islands.push_back(start.settled_by(RandomStream{name, i}));
  for (int epoch = 0; epoch < kEpochs && search.variations > 0; ++epoch) {
    in_pieces(islands.size(), [&](std::size_t i) { islands[i].vary(share_of(search.variations, i, epoch)); });
    const std::vector<SetIsland> neighbours = islands;
    for (std::size_t i = 0; i < islands.size(); ++i)
      islands[i].accept_immigrants(neighbours[(i + 1) % neighbours.size()]);
  }
  return front_of(islands);
}

std::vector<EffectSet> prunings(const ExplanationProblem& problem, const std::vector<std::size_t>& known) {
  return search_explanations(problem, known, {.variations = 0}, RandomStream{0});
}

}  // namespace demecal::inline explanations
