#include "evolution/breeding.hpp"

#include <utility>

#include "errors/check.hpp"
#include "evolution/selection.hpp"

namespace demecal {

Breeder::Breeder(const GpParameters& parameters, int variables)
    : parameters_(parameters), variation_(parameters, variables), index_(0) {}

std::uint64_t Breeder::breed(RandomStream& random, Population& population, Fitness& fitness) {
  DEMECAL_CHECK(!population.empty(), "no parents");
  make_offspring(random, population);
  const std::uint64_t evaluations = evaluate(population, fitness);
  std::swap(population, offspring_);
  return evaluations;
}

void Breeder::make_offspring(RandomStream& random, const Population& parents) {
  offspring_.resize(parents.size());
  offspring_[0].tree = parents[fittest(parents)].tree;
  for (std::size_t i = 1; i < offspring_.size(); i += 2)
    make_pair(random, parents, offspring_[i].tree, i + 1 < offspring_.size() ? offspring_[i + 1].tree : surplus_);
}

void Breeder::make_pair(RandomStream& random, const Population& parents, Tree& daughter, Tree& son) {
  const Tree& mother = parents[tournament(random, parents, parameters_.tournament_size)].tree;
  const Tree& father = parents[tournament(random, parents, parameters_.tournament_size)].tree;
  if (!random.chance(parameters_.crossover_rate) || !variation_.cross(random, mother, father, daughter, son)) {
    daughter = mother;
    son = father;
  }
  if (random.chance(parameters_.mutation_rate)) variation_.mutate(random, daughter);
  if (random.chance(parameters_.mutation_rate)) variation_.mutate(random, son);
}

std::uint64_t Breeder::evaluate(const Population& parents, Fitness& fitness) {
  const std::size_t count = parents.size();
  std::uint64_t evaluations = 0;
  index_.clear(2 * count);
  for (std::size_t i = 0; i < count; ++i) index_.enter(parents[i].tree, i);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t known = index_.enter(offspring_[i].tree, count + i);
    if (known == count + i) {
      offspring_[i].fitness = fitness(offspring_[i].tree);
      ++evaluations;
    } else {
      offspring_[i].fitness = known < count ? parents[known].fitness : offspring_[known - count].fitness;
    }
  }
  return evaluations;
}

}  // namespace demecal
