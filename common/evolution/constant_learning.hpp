// What individuals learn in their lives: fitted constants, which with Lamarck they pass on and with Baldwin do not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "evolution/constant_fit.hpp"
#include "evolution/shared_population.hpp"

namespace demecal {

/// Fits the individuals of one store's generations. Which are fitted, and what comes out, is a function of table,
/// parameters and the generation at hand, not of what was fitted before.
class ConstantLearning {
 public:
  ConstantLearning(const TrainingTable& table, const GpParameters& parameters);

  bool is_on() const { return is_on_; }
  /// Individual i of the population fitted, whatever the share.
  void learn(NodeStore& store, SharedPopulation& population, std::size_t i);
  /// Offspring that equal a parent take over what it knew. Of the others, the fittest constant_share of a population
  /// are fitted; of equally fit ones those that come first.
  void learn(NodeStore& store, const SharedPopulation& parents, SharedPopulation& offspring);

  /// Forgets all fits: numbers of the store have new meanings.
  void forget();
  std::uint64_t fits() const { return fits_; }  ///< made so far, those remembered not counted

 private:
  struct Known {
    FittedFormula fitted;
    std::uint64_t parent_of = 0;  ///< the last generation in which this was a parent, and which one
    std::uint32_t parent = 0;
    bool is_fitted = false;
  };
  void choose(const SharedPopulation& offspring);

  ConstantFit fit_;
  bool is_on_, is_inherited_;
  double share_;
  std::vector<Known> known_;  ///< by node
  std::vector<std::size_t> chosen_;
  std::uint64_t generation_ = 0;
  std::uint64_t fits_ = 0;
};

}  // namespace demecal
