// The interface through which a calibration has formulas and explanations evolved, wherever the islands are.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "calibration/selection.hpp"
#include "calibration/training.hpp"
#include "diagnosis/loop.hpp"
#include "effect_sets/fitted_set.hpp"
#include "effect_sets/set_island.hpp"
#include "explanations/explanation_search.hpp"
#include "expression/shared_function.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline calibration {

/// Functions that joints share, where these are known, be they none.
using KnownFunctions = std::optional<std::vector<SharedFunction>>;

/// What an evolution is for: for those who watch, not for the islands, which must not know that a search is in vain.
enum class Purpose {
  corrections,       ///< of each joint, from its own value
  formulas,          ///< over all that a joint's error may depend on
  null_distribution  ///< the same on permuted residuals: what the search finds where there is nothing to find
};

/// What one of several evolutions in a row has of its own.
struct EvolutionTerms {
  std::uint64_t seed = 0;
  int generations = 0;
  std::vector<SharedFunction> functions{};  ///< that the joints share
  Purpose purpose = Purpose::corrections;
};

/// The terms of round `number` (from 0) of `rounds` into which generations are divided as evenly as can be; rounds
/// differ in their random numbers as seeds do.
inline EvolutionTerms terms_of_round(std::uint64_t seed, int generations, int rounds, int number) {
  return {.seed = seed + (static_cast<std::uint64_t>(number) << 32U),
          .generations = generations / rounds + (number < generations % rounds ? 1 : 0)};
}

struct EvolvedJoints {
  std::vector<JointCandidates> joints;  ///< one per training, in their order
  bool is_complete = true;              ///< false: evolution was cut off, and `joints` are what it had reached
};

class Evolver {
 public:
  virtual ~Evolver() = default;

  /// Evolves candidates for every joint of a training. What complete evolutions find is a function of the arguments.
  virtual EvolvedJoints evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) = 0;

  /// As demecal::search_explanations() does, to the bit, wherever the islands are; where they are elsewhere and it is
  /// interrupted, what they had reached.
  virtual std::vector<EffectSet> search_explanations(const ExplanationProblem& problem, const SetSearch& search) {
    return demecal::search_explanations(problem, search);
  }

  /// As demecal::do_work() does, to the bit, whoever does it.
  virtual std::vector<std::vector<double>> do_work(const SharedWork& work) { return demecal::do_work(work); }

  /// The closed loop is about to have this evolved; for those who watch.
  virtual void announce(Purpose /*purpose*/) {}
  /// The closed loop begins once more, without the evolved joint corrections; for those who watch.
  virtual void announce_loop_without_corrections() {}
  /// Whether what is bred by the caller itself, without evolve(), should end.
  virtual bool is_interrupted() const { return false; }
  /// Counts what the caller bred itself.
  virtual void add_effort(std::uint32_t /*generations*/, std::uint64_t /*evaluations*/) {}
};

/// The closed loop's work, done by the evolver, which has to outlive it.
inline LoopWork work_of(Evolver& evolver) {
  return {[&evolver](const ExplanationProblem& problem, const SetSearch& search) {
            return evolver.search_explanations(problem, search);
          },
          [&evolver](const SharedWork& work) { return evolver.do_work(work); }};
}

}  // namespace demecal::inline calibration
