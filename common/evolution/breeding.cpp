#include "evolution/breeding.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "errors/check.hpp"
#include "evolution/population.hpp"

namespace demecal::inline evolution {

ConstantLearning::ConstantLearning(const TrainingTable& table, const GpParameters& parameters)
    : fit_(table, parameters),
      is_on_(parameters.constants != ConstantPolicy::none || parameters.linear_scaling),
      is_inherited_(parameters.constants == ConstantPolicy::lamarckian),
      share_(parameters.constant_share) {}

void ConstantLearning::learn(NodeStore& store, SharedPopulation& population, std::size_t i) {
  const NodeId root = population.roots[i];
  if (known_.size() <= root) known_.resize(store.end());
  if (!known_[root].is_fitted) {
    known_[root].fitted = fit_(store, root, population.fitness[i]);
    known_[root].is_fitted = true;
    ++fits_;
  }
  const FittedFormula& fitted = known_[root].fitted;
  population.fitness[i] = fitted.fitness;
  population.models[i] = fitted.root;
  if (is_inherited_) population.roots[i] = fitted.root;
}

void ConstantLearning::learn(NodeStore& store, const SharedPopulation& parents, SharedPopulation& offspring) {
  if (known_.size() < store.end()) known_.resize(store.end());
  ++generation_;
  for (std::size_t i = parents.roots.size(); i-- > 0;) {
    Known& known = known_[parents.roots[i]];
    known.parent_of = generation_;
    known.parent = static_cast<std::uint32_t>(i);
  }
  chosen_.clear();
  for (std::size_t i = 0; i < offspring.roots.size(); ++i) {
    const Known& known = known_[offspring.roots[i]];
    if (known.parent_of == generation_) {
      offspring.fitness[i] = parents.fitness[known.parent];
      offspring.models[i] = parents.models[known.parent];
    } else if (std::isfinite(offspring.fitness[i])) {
      chosen_.push_back(i);
    }
  }
  choose(offspring);
  for (const std::size_t i : chosen_) learn(store, offspring, i);
}

// Keeps the fittest of those chosen so far.
void ConstantLearning::choose(const SharedPopulation& offspring) {
  const auto most = static_cast<std::size_t>(std::ceil(share_ * static_cast<double>(offspring.roots.size())));
  if (chosen_.size() <= most) return;
  const auto fitter = [&](std::size_t a, std::size_t b) {
    return std::tie(offspring.fitness[a], a) < std::tie(offspring.fitness[b], b);
  };
  std::nth_element(chosen_.begin(), chosen_.begin() + static_cast<std::ptrdiff_t>(most), chosen_.end(), fitter);
  chosen_.resize(most);
  std::sort(chosen_.begin(), chosen_.end());
}

void ConstantLearning::forget() {
  std::fill(known_.begin(), known_.end(), Known{});
}

namespace {

constexpr std::size_t kFewNodes = 4096;  // below as many, nothing is collected

}  // namespace

Breeder::Breeder(const GpParameters& parameters, const TrainingTable& table, std::size_t budget_bytes)
    : parameters_(parameters),
      fitness_(table, budget_bytes),
      learning_(table, parameters),
      is_safe_(table),
      variation_(parameters, static_cast<int>(table.variables.size())) {}

SharedPopulation Breeder::enter(const std::vector<Tree>& trees) {
  SharedPopulation population;
  for (const Tree& tree : trees) population.roots.push_back(store_.enter(tree));
  fitness_.bind(store_, population.roots);
  fitness_.run();
  for (const NodeId root : population.roots) population.fitness.push_back(fitness_.of(root));
  population.models = population.roots;
  if (learning_.is_on()) learning_.learn(store_, {}, population);
  return population;
}

void Breeder::replace(NodeId root, SharedPopulation& population, std::size_t i) {
  population.roots[i] = population.models[i] = root;
  population.fitness[i] = fitness(root);
  if (learning_.is_on() && std::isfinite(population.fitness[i])) learning_.learn(store_, population, i);
}

double Breeder::fitness(NodeId root) {
  fitness_.bind(store_, {&root, 1});
  fitness_.run();
  return fitness_.of(root);
}

std::uint64_t Breeder::breed(RandomStream& random, SharedPopulation& population) {
  vary(random, population);
  bind();
  const std::uint64_t evaluations = evaluate(population);
  learn(population);
  return evaluations;
}

// Whatever no parent needs any more makes way, once it may be more than half.
void Breeder::collect(const SharedPopulation& parents) {
  if (store_.size() < std::max(kFewNodes, 2 * size_after_collection_)) return;
  live_ = parents.roots;
  for (const NodeId model : parents.models)
    if (model != 0) live_.push_back(model);
  const std::span<const NodeId> dropped = store_.collect(live_);
  fitness_.forget(dropped);
  is_safe_.forget(dropped);
  learning_.forget();
  size_after_collection_ = store_.size();
}

void Breeder::vary(RandomStream& random, const SharedPopulation& parents) {
  DEMECAL_CHECK(!parents.roots.empty(), "no parents");
  collect(parents);
  offspring_.roots.resize(parents.roots.size());
  offspring_.roots[0] = parents.roots[fittest(parents.fitness)];
  NodeId surplus = 0;
  ++variation_count_;
  if (parameters_.no_duplicates) make_different(random, offspring_.roots[0]);
  for (std::size_t i = 1; i < offspring_.roots.size(); i += 2) {
    const bool both = i + 1 < offspring_.roots.size();
    make_pair(random, parents, offspring_.roots[i], both ? offspring_.roots[i + 1] : surplus);
    if (!parameters_.no_duplicates) continue;
    make_different(random, offspring_.roots[i]);
    if (both) make_different(random, offspring_.roots[i + 1]);
  }
}

// From all offspring made different before.
void Breeder::make_different(RandomStream& random, NodeId& formula) {
  const auto is_new = [&] {
    if (bred_.size() < store_.end()) bred_.resize(store_.end(), 0);
    return bred_[formula] != variation_count_;
  };
  for (int attempt = 0; !is_new() && attempt < parameters_.invalid_attempts; ++attempt)
    variation_.mutate(random, store_, formula);
  is_new();
  bred_[formula] = variation_count_;
}

void Breeder::make_pair(RandomStream& random, const SharedPopulation& parents, NodeId& daughter, NodeId& son) {
  const NodeId mother = parents.roots[tournament(random, parents.fitness, parameters_.tournament_size)];
  const NodeId father = parents.roots[tournament(random, parents.fitness, parameters_.tournament_size)];
  if (!random.chance(parameters_.crossover_rate) || !variation_.cross(random, store_, mother, father, daughter, son)) {
    daughter = mother;
    son = father;
  }
  if (random.chance(parameters_.mutation_rate)) variation_.mutate(random, store_, daughter);
  if (random.chance(parameters_.mutation_rate)) variation_.mutate(random, store_, son);
}

std::uint64_t Breeder::evaluate(const SharedPopulation& parents) {
  fitness_.run();
  offspring_.fitness.resize(offspring_.roots.size());
  for (std::size_t i = 0; i < offspring_.roots.size(); ++i) offspring_.fitness[i] = fitness_.of(offspring_.roots[i]);
  return count_new(parents);
}

void Breeder::learn(SharedPopulation& population) {
  offspring_.models = offspring_.roots;
  if (learning_.is_on()) learning_.learn(store_, population, offspring_);
  std::swap(population, offspring_);
}

std::uint64_t Breeder::count_new(const SharedPopulation& parents) {
  ++generation_;
  seen_.resize(store_.end(), 0);
  for (const NodeId root : parents.roots) seen_[root] = generation_;
  std::uint64_t count = 0;
  for (const NodeId root : offspring_.roots) {
    count += seen_[root] != generation_ ? 1 : 0;
    seen_[root] = generation_;
  }
  return count;
}

}  // namespace demecal::inline evolution
