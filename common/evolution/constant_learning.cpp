#include "evolution/constant_learning.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace demecal {

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

}  // namespace demecal
