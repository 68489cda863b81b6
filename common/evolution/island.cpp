#include "evolution/island.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "errors/check.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/population.hpp"
#include "evolution/tree_generation.hpp"
#include "expression/node_store.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline evolution {
namespace {

constexpr double kRejected = std::numeric_limits<double>::infinity();

bool stands_in(const Population& population, const Tree& tree) {
  return std::any_of(population.begin(), population.end(), [&](const Individual& one) { return one.tree == tree; });
}

std::vector<double> population_fitness(const Population& population) {
  std::vector<double> fitness;
  for (const Individual& individual : population) fitness.push_back(individual.fitness);
  return fitness;
}

double share_of_different(const Population& population) {
  TreeIndex index(population.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < population.size(); ++i) different += index.enter(population[i].tree, i) == i ? 1 : 0;
  return static_cast<double>(different) / static_cast<double>(population.size());
}

}  // namespace

Island::Island(const GpParameters& parameters, const Archipelago& archipelago, const TrainingTable& table,
               IslandKey key, std::uint64_t seed)
    : parameters_(island_parameters(parameters, archipelago, key.deme)),
      archipelago_(archipelago),
      variables_(static_cast<int>(table.variables.size())),
      seeds_(table.seeds),
      breeder_(parameters_, table),
      key_(key),
      seed_(seed) {
  const auto fault = find_fault(parameters);
  DEMECAL_CHECK(!fault, fault->key << " = " << fault->value << " " << fault->rule);
  DEMECAL_CHECK(archipelago.migration_interval > 0, "migration_interval = 0");
}

std::uint32_t Island::epochs_total() const {
  const auto generations = static_cast<std::uint32_t>(parameters_.number_generations);
  return 1 + generations / archipelago_.migration_interval + (generations % archipelago_.migration_interval != 0);
}

bool Island::finished() const {
  return state_.epoch >= epochs_total();
}

std::uint32_t Island::generations_of_epoch() const {
  if (state_.epoch == 0) return 0;
  return std::min(archipelago_.migration_interval,
                  static_cast<std::uint32_t>(parameters_.number_generations) - state_.generation);
}

void Island::run_epoch(const Population& immigrants, const std::function<void()>& after_generation) {
  DEMECAL_CHECK(!finished(), "epoch=" << state_.epoch << " of " << epochs_total());
  RandomStream random{seed_, key_.joint, key_.deme, state_.epoch};
  enter_population(random);
  const double best_before = residents_.fitness[fittest(residents_.fitness)];
  accept_immigrants(immigrants, random);
  ParetoFront front(std::move(state_.front));
  offer_all(front);
  const std::uint32_t generations = generations_of_epoch();
  for (std::uint32_t i = 0; i < generations; ++i) {
    state_.evaluations += breeder_.breed(random, residents_);
    offer_all(front);
    if (after_generation) after_generation();
  }
  reject_unsafe(archipelago_.migrants);
  const bool has_gained = state_.epoch == 0 || residents_.fitness[fittest(residents_.fitness)] < best_before;
  state_.without_gain = has_gained ? 0 : state_.without_gain + 1;
  write_population();
  forget_models();
  state_.front = std::move(front).release();
  state_.generation += generations;
  ++state_.epoch;
}

std::vector<Tree> Island::first_trees(RandomStream& random) const {
  std::vector<Tree> trees = ramped_half_and_half(random, parameters_, variables_);
  std::size_t place = trees.size();
  for (const Tree& seed : seeds_)
    if (place > 1 && fits(seed)) trees[--place] = seed;  // the first is the neutral model
  return trees;
}

bool Island::is_stagnant() const {
  return parameters_.restart_after > 0 && state_.without_gain >= static_cast<std::uint32_t>(parameters_.restart_after);
}

// The first population, one that begins anew, or that of a state another worker reached.
void Island::enter_population(RandomStream& random) {
  if (state_.epoch == 0 || is_stagnant()) {
    residents_ = breeder_.enter(first_trees(random));
    state_.evaluations += residents_.roots.size();
    state_.without_gain = 0;
    return;
  }
  if (!residents_.roots.empty()) return;
  for (const Individual& individual : state_.population) residents_.roots.push_back(breeder_.enter(individual.tree));
  residents_.fitness = population_fitness(state_.population);
  residents_.models = residents_.roots;
  forget_models();
}

// What individuals were fitted to does not leave the island with them: whoever goes on knows as much as this one.
void Island::forget_models() {
  if (parameters_.constants != ConstantPolicy::lamarckian && breeder_.learning().is_on())
    std::fill(residents_.models.begin(), residents_.models.end(), NodeId{0});
}

// Only what would enter is judged: of most formulas it never matters whether they are safe.
void Island::offer_all(ParetoFront& front) {
  for (std::size_t i = 0; i < residents_.roots.size(); ++i) {
    const NodeId model = residents_.models[i];
    double& fitness = residents_.fitness[i];
    if (model == 0 || !front.would_enter(breeder_.store()[model].whole.nodes, fitness)) continue;
    if (breeder_.is_safe(model))
      front.offer({breeder_.store().tree(model), fitness});
    else
      fitness = kRejected;
  }
  reject_unsafe(1);
}

// Until so many different ones of the fittest are safe.
void Island::reject_unsafe(std::size_t most) {
  if (!breeder_.limits()) return;
  std::vector<NodeId> safe;
  std::vector<double>& fitness = residents_.fitness;
  while (safe.size() < most) {
    std::size_t best = fitness.size();
    for (std::size_t i = 0; i < fitness.size(); ++i) {
      const bool is_known = std::find(safe.begin(), safe.end(), residents_.roots[i]) != safe.end();
      if (!is_known && std::isfinite(fitness[i]) && (best == fitness.size() || fitness[i] < fitness[best])) best = i;
    }
    if (best == fitness.size()) return;
    const NodeId model = residents_.models[best] != 0 ? residents_.models[best] : residents_.roots[best];
    if (breeder_.is_safe(model))
      safe.push_back(residents_.roots[best]);
    else
      fitness[best] = kRejected;
  }
}

void Island::write_population() {
  state_.population.resize(residents_.roots.size());
  for (std::size_t i = 0; i < residents_.roots.size(); ++i) {
    Individual& individual = state_.population[i];
    individual.tree.clear();
    breeder_.store().append(residents_.roots[i], individual.tree);
    individual.fitness = residents_.fitness[i];
  }
}

bool Island::fits(const Tree& tree) const {
  return is_valid(tree, variables_) && depth(tree) <= parameters_.max_tree_depth &&
         (parameters_.max_tree_nodes == 0 || tree.size() <= static_cast<std::size_t>(parameters_.max_tree_nodes));
}

void Island::accept_immigrants(const Population& immigrants, RandomStream& random) {
  std::vector<NodeId>& roots = residents_.roots;
  std::vector<std::size_t> places = ranking(residents_.fitness);
  places.erase(places.begin());
  std::reverse(places.begin(), places.end());
  std::size_t taken = 0;
  for (const Individual& immigrant : immigrants) {
    if (taken >= places.size()) break;
    if (!fits(immigrant.tree)) continue;
    const NodeId root = breeder_.enter(immigrant.tree);
    if (std::find(roots.begin(), roots.end(), root) != roots.end()) continue;
    if (archipelago_.replacement == Replacement::random)
      std::swap(places[taken], places[taken + random.index(places.size() - taken)]);
    breeder_.replace(root, residents_, places[taken++]);
  }
  state_.evaluations += taken;
  state_.migrants_taken += taken;
}

Population Island::emigrants() const {
  Population chosen;
  for (const std::size_t i : ranking(population_fitness(state_.population))) {
    const Individual& individual = state_.population[i];
    if (chosen.size() >= archipelago_.migrants || !std::isfinite(individual.fitness)) break;
    if (!stands_in(chosen, individual.tree)) chosen.push_back(individual);
  }
  return chosen;
}

IslandFigures Island::figures() const {
  if (state_.population.empty()) return {};
  const std::vector<std::size_t> ranked = ranking(population_fitness(state_.population));
  const Individual& best = state_.population[ranked.front()];
  const Individual& median = state_.population[ranked[(ranked.size() - 1) / 2]];
  return {best.fitness, median.fitness, static_cast<std::uint32_t>(best.tree.size()),
          share_of_different(state_.population)};
}

const Individual* Island::best() const {
  if (state_.population.empty()) return nullptr;
  return &state_.population[ranking(population_fitness(state_.population)).front()];
}

void Island::restore(IslandState state) {
  DEMECAL_CHECK(state.epoch == 0 || state.population.size() == static_cast<std::size_t>(parameters_.population_size),
                "epoch=" << state.epoch << " population=" << state.population.size());
  state_ = std::move(state);
  residents_ = {};
}

}  // namespace demecal::inline evolution
