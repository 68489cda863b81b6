#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/evolver.hpp"
#include "calibration/job.hpp"
#include "calibration/selection.hpp"
#include "calibration/shared_functions.hpp"
#include "calibration/training.hpp"
#include "distal/index.hpp"
#include "distal/learning.hpp"
#include "distal/steps.hpp"
#include "evolution/population.hpp"
#include "expression/shared_function.hpp"
#include "expression/tree.hpp"
#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"
#include "fitting/fit.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline distal {
namespace {

constexpr std::size_t kSeedShare = 4;  ///< one in so many individuals may be a seed

/// Trees of a front, the fittest last.
std::vector<Tree> trees_of(const Population& front) {
  std::vector<Tree> trees;
  for (const Individual& individual : front) trees.push_back(individual.tree);
  return trees;
}

class DistalRounds {
 public:
  DistalRounds(const DistalIndex& index, const Preparation& preparation, const Job& job,
               const KnownFunctions& functions)
      : index_(index),
        job_(job),
        seeks_functions_(!functions),
        trainings_(preparation.training),
        outcome_{without_corrections(preparation.declared.robot), 0.0} {
    outcome_.index_mm2 = index_(outcome_.robot);
    if (functions) outcome_.functions = *functions;
    trees_.resize(trainings_.size());
  }

  DistalOutcome run(Evolver& evolver);

 private:
  void prepare();
  std::vector<Tree> seeds_of(std::size_t i) const;
  bool round(Evolver& evolver, EvolutionTerms terms);

  const DistalIndex& index_;
  const Job& job_;
  bool seeks_functions_;
  std::vector<SharedFunction> next_functions_;
  std::vector<JointTraining> trainings_;  ///< of the present round
  std::vector<std::vector<Tree>> trees_;  ///< by training: the fronts of the last round
  bool first_ = true;
  std::uint32_t generation_ = 0;
  DistalOutcome outcome_;
};

/// The fittest of the last front, as many as may be, and the formula in use.
std::vector<Tree> DistalRounds::seeds_of(std::size_t i) const {
  const auto most = static_cast<std::size_t>(job_.gp.population_size) / kSeedShare;
  std::vector<Tree> seeds;
  const JointCorrection& present = outcome_.robot.corrections[trainings_[i].joint];
  if (!present.is_neutral()) seeds.push_back(evolved_tree(present));
  for (auto tree = trees_[i].rbegin(); tree != trees_[i].rend() && seeds.size() < most; ++tree) {
    if (seeds.empty() || *tree != seeds.front()) seeds.push_back(*tree);
  }
  return seeds;
}

void DistalRounds::prepare() {
  const std::vector<LinearizedPose> poses = index_.linearized(outcome_.robot);
  for (std::size_t i = 0; i < trainings_.size(); ++i) {
    JointTraining& training = trainings_[i];
    training = distal_training(training, poses, first_ ? std::nullopt : std::optional(training.scale_rad));
    training.table.seeds = first_ ? seed_trees(job_.corrections.seeds, training) : seeds_of(i);
  }
  first_ = false;
}

/// Whether it was evolved to the end. Where no joint gains, one may in the next, whose populations are others.
bool DistalRounds::round(Evolver& evolver, EvolutionTerms terms) {
  prepare();
  if (seeks_functions_) outcome_.functions = next_functions_;
  terms.functions = outcome_.functions;
  const EvolvedJoints evolved = evolver.evolve(trainings_, terms);
  outcome_.is_complete = evolved.is_complete;
  if (!evolved.is_complete) return false;
  generation_ += static_cast<std::uint32_t>(terms.generations);
  for (std::size_t i = 0; i < trees_.size(); ++i) trees_[i] = trees_of(evolved.joints[i].front);
  if (seeks_functions_) next_functions_ = shared_functions(evolved.joints, job_.corrections.sharing);
  const Amplitudes amplitudes = job_.distal.amplitudes.value_or(Amplitudes::fitted);
  accept_candidates(index_, evolved.joints, amplitudes, generation_, outcome_);
  rescale_trainings(outcome_.robot, trainings_);
  return true;
}

DistalOutcome DistalRounds::run(Evolver& evolver) {
  const int rounds = std::min(job_.distal.rounds, job_.gp.number_generations), generations = job_.gp.number_generations;
  for (int number = 0; number < rounds && !trainings_.empty(); ++number) {
    if (!round(evolver, terms_of_round(job_.seed, generations, rounds, number))) break;
  }
  gather_candidates(index_, trainings_, trees_, outcome_);
  return std::move(outcome_);
}

}  // namespace

DistalOutcome learn_in_rounds(const DistalIndex& index, const Preparation& preparation, const Job& job,
                              Evolver& evolver, const KnownFunctions& functions) {
  return DistalRounds(index, preparation, job, functions).run(evolver);
}

void gather_candidates(const DistalIndex& index, const std::vector<JointTraining>& trainings,
                       const std::vector<std::vector<Tree>>& trees, DistalOutcome& outcome) {
  const std::vector<LinearizedPose> poses = index.linearized(outcome.robot);
  outcome.candidates.clear();
  for (std::size_t i = 0; i < trainings.size(); ++i) {
    JointCandidates joint{distal_training(trainings[i], poses, trainings[i].scale_rad), {}};
    Fitness fitness(joint.training.table);
    ParetoFront front;
    for (const Tree& tree : trees[i]) front.offer({tree, fitness(tree)});
    joint.front = std::move(front).release();
    joint.alternatives = {outcome.robot.corrections[trainings[i].joint]};
    outcome.candidates.push_back(std::move(joint));
  }
}

}  // namespace demecal::inline distal
