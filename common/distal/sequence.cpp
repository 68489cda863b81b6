#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/evolver.hpp"
#include "calibration/job.hpp"
#include "calibration/joint_targets.hpp"
#include "calibration/selection.hpp"
#include "calibration/training.hpp"
#include "data/data_set.hpp"
#include "distal/index.hpp"
#include "distal/learning.hpp"
#include "distal/steps.hpp"
#include "evolution/breeding.hpp"
#include "evolution/population.hpp"
#include "evolution/tree_generation.hpp"
#include "expression/node_store.hpp"
#include "expression/tree.hpp"
#include "fitness/parameters.hpp"
#include "fitting/fit.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/random_purpose.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline distal {
namespace {

constexpr int kPatience = 40;     ///< generations without gain before a population begins anew
constexpr int kMostExcluded = 5;  ///< of a generation at most

class DistalSequence {
 public:
  DistalSequence(const DistalIndex& index, const Preparation& preparation, const Job& job,
                 const std::function<bool()>& may_go_on)
      : index_(index),
        job_(job),
        may_go_on_(may_go_on),
        random_{job.seed, number_of(RandomPurpose::distal_sequence)},
        trainings_(preparation.training),
        trees_(preparation.training.size()) {
    outcome_.learnt.robot = without_corrections(preparation.declared.robot);
    outcome_.learnt.index_mm2 = index_(outcome_.learnt.robot);
  }

  SequenceOutcome run();

 private:
  std::size_t select(std::span<const LinearizedPose> poses) const;
  void evolve(std::size_t i, std::span<const LinearizedPose> poses);
  SharedPopulation enter(Breeder& breeder, const std::vector<Tree>& trees);
  std::vector<Tree> restarted(const Breeder& breeder, const SharedPopulation& population);
  double present_fitness(Breeder& breeder, const JointTraining& training) const;
  bool take_fittest(const Breeder& breeder, SharedPopulation& population, const JointTraining& training, double& best);
  void fit_amplitudes();
  bool may_go_on() const {
    return outcome_.generations < static_cast<std::uint32_t>(job_.gp.number_generations) && may_go_on_();
  }

  const DistalIndex& index_;
  const Job& job_;
  const std::function<bool()>& may_go_on_;
  RandomStream random_;
  std::vector<JointTraining> trainings_;
  std::vector<std::vector<Tree>> trees_;  ///< by training: its population; empty where it has not been selected yet
  SequenceOutcome outcome_;
};

std::size_t DistalSequence::select(std::span<const LinearizedPose> poses) const {
  const Eigen::VectorXd potentials = compensation_potentials(poses);
  const auto potential = [&](const JointTraining& one) { return potentials[static_cast<Eigen::Index>(one.joint)]; };
  const auto most = std::ranges::max_element(trainings_, {}, potential);
  return static_cast<std::size_t>(most - trainings_.begin());
}

Tree formula_of(const Breeder& breeder, const SharedPopulation& population, std::size_t i) {
  return breeder.store().tree(population.models[i] != 0 ? population.models[i] : population.roots[i]);
}

/// What the formula in use is worth beside those that are bred.
double DistalSequence::present_fitness(Breeder& breeder, const JointTraining& training) const {
  const JointCorrection& present = outcome_.learnt.robot.corrections[training.joint];
  return breeder.fitness(breeder.enter(present.is_neutral() ? neutral_tree() : evolved_tree(present)));
}

SharedPopulation DistalSequence::enter(Breeder& breeder, const std::vector<Tree>& trees) {
  outcome_.evaluations += trees.size();
  return breeder.enter(trees);
}

std::vector<Tree> DistalSequence::restarted(const Breeder& breeder, const SharedPopulation& population) {
  std::vector<Tree> trees = ramped_half_and_half(random_, job_.gp, 1);
  trees.back() = breeder.store().tree(population.roots[fittest(population.fitness)]);
  return trees;
}

/// Nobody is to descend from it.
void exclude(SharedPopulation& population, NodeId root) {
  for (std::size_t i = 0; i < population.roots.size(); ++i) {
    if (population.roots[i] == root) population.fitness[i] = std::numeric_limits<double>::infinity();
  }
}

/// Whether the model took the fittest that is bounded, where that is fitter than `best`, the fittest tried so far.
bool DistalSequence::take_fittest(const Breeder& breeder, SharedPopulation& population, const JointTraining& training,
                                  double& best) {
  for (int excluded = 0; excluded < kMostExcluded; ++excluded) {
    const std::size_t i = fittest(population.fitness);
    if (!(population.fitness[i] < best)) return false;
    const JointCorrection correction = correction_from(training, formula_of(breeder, population, i));
    if (is_bounded(correction, training)) {
      best = population.fitness[i];
      return accept_correction(index_, training, correction, outcome_.generations, outcome_.learnt);
    }
    exclude(population, population.roots[i]);
  }
  return false;
}

/// Breeds one joint's population until the index falls.
void DistalSequence::evolve(std::size_t i, std::span<const LinearizedPose> poses) {
  const bool is_new = trees_[i].empty();
  trainings_[i] = distal_training(trainings_[i], poses, is_new ? std::nullopt : std::optional(trainings_[i].scale_rad));
  const JointTraining& training = trainings_[i];
  if (is_new) trees_[i] = ramped_half_and_half(random_, job_.gp, 1);
  Breeder breeder(job_.gp, training.table);
  SharedPopulation population = enter(breeder, trees_[i]);
  double best = present_fitness(breeder, training);
  for (int without_gain = 0; may_go_on();) {
    ++outcome_.generations;
    outcome_.evaluations += breeder.breed(random_, population);
    if (take_fittest(breeder, population, training, best)) break;
    if (++without_gain < kPatience) continue;
    population = enter(breeder, restarted(breeder, population));
    without_gain = 0;
  }
  for (std::size_t k = 0; k < trees_[i].size(); ++k) trees_[i][k] = breeder.store().tree(population.roots[k]);
}

/// Those of all joints to one another.
void DistalSequence::fit_amplitudes() {
  std::vector<JointCandidates> none;
  for (const JointTraining& training : trainings_) none.push_back({training, {}});
  accept_candidates(index_, none, Amplitudes::fitted, outcome_.generations, outcome_.learnt);
  rescale_trainings(outcome_.learnt.robot, trainings_);
}

SequenceOutcome DistalSequence::run() {
  while (!trainings_.empty() && may_go_on()) {
    const std::vector<LinearizedPose> poses = index_.linearized(outcome_.learnt.robot);
    evolve(select(poses), poses);
    if (job_.distal.amplitudes == Amplitudes::fitted) fit_amplitudes();
  }
  gather_candidates(index_, trainings_, trees_, outcome_.learnt);
  return std::move(outcome_);
}

/// What the model takes of these candidates beside the corrections that it has, amplitudes of all of them fitted.
CorrectedRobot fitted_together(const DistalIndex& index, CorrectedRobot robot,
                               std::span<const JointCandidates> candidates) {
  constexpr int kMostChoices = 4;  // each about the corrections of the one before
  const double index_mm2 = index(robot);
  DistalOutcome outcome{.robot = std::move(robot), .index_mm2 = index_mm2};
  for (int i = 0; i < kMostChoices; ++i)
    if (!accept_candidates(index, candidates, Amplitudes::fitted, 0, outcome)) break;
  return std::move(outcome.robot);
}

}  // namespace

SequenceOutcome learn_in_sequence(const DistalIndex& index, const Preparation& preparation, const Job& job,
                                  const std::function<bool()>& may_go_on) {
  return DistalSequence(index, preparation, job, may_go_on).run();
}

DistalOutcome learn_distally(const DataSet& data, const Job& job, const Preparation& preparation, Evolver& evolver,
                             const KnownFunctions& functions) {
  const DistalIndex index(data, preparation.targets.poses, preparation.declared);
  if (job.distal.form == DistalForm::parallel) return learn_in_rounds(index, preparation, job, evolver, functions);
  SequenceOutcome outcome = learn_in_sequence(index, preparation, job, [&] { return !evolver.is_interrupted(); });
  evolver.add_effort(outcome.generations, outcome.evaluations);
  outcome.learnt.is_complete = !evolver.is_interrupted();
  return std::move(outcome.learnt);
}

void add_choices_of_all_joints(const DataSet& data, const Preparation& preparation,
                               std::vector<JointCandidates>& candidates) {
  constexpr int kChosenAnew = 2;
  if (candidates.empty()) return;
  const CorrectedRobot& declared = preparation.declared.robot;
  const DistalIndex index(data, preparation.targets.poses, preparation.declared);
  const std::vector<std::size_t> fitted = without_gross_errors(data, PoseSet::calibration, declared);
  const std::vector<std::size_t> selecting = selection_poses(data, declared);
  std::vector<JointCandidates> no_others;
  for (const JointCandidates& joint : candidates) no_others.push_back({joint.training, {}});
  const auto add = [&candidates](const CorrectedRobot& robot) {
    for (JointCandidates& joint : candidates) joint.alternatives.push_back(robot.corrections[joint.training.joint]);
  };
  add(fitted_together(index, declared, candidates));
  for (int i = 0; i < kChosenAnew; ++i)
    add(fitted_together(index, select_corrections(data, fitted, selecting, declared, candidates).robot, no_others));
}

}  // namespace demecal::inline distal
