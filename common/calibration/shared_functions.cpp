#include "calibration/shared_functions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <ranges>
#include <utility>

#include "evolution/building_blocks.hpp"
#include "evolution/model_archive.hpp"
#include "evolution/population.hpp"
#include "expression/simplify.hpp"
#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"

namespace demecal::inline calibration {
namespace {

constexpr std::size_t kGoodFormulas = 8;
constexpr std::size_t kStageSeedShare = 4;  // one in so many individuals may come from the stage before
constexpr double kLeastFitness = 1e-300;

/// See description_length_nats(): for absolute errors the mean takes the place of the root of the mean square.
double description_nats_of_fit(const Tree& tree, double fitness, const TrainingTable& table) {
  const double weights = std::accumulate(table.weight.begin(), table.weight.end(), 0.0);
  const double mean = std::max(fitness, kLeastFitness) / weights;
  return description_length_nats(tree, table.loss == Loss::squared ? mean : mean * mean, weights);
}

/// The front's fittest, as many as may be.
std::vector<Tree> stage_seeds(const Population& front, const Job& job) {
  const std::size_t most = static_cast<std::size_t>(job.gp.population_size) / kStageSeedShare;
  std::vector<Tree> seeds;
  for (auto one = front.rbegin(); one != front.rend() && seeds.size() < most; ++one) seeds.push_back(one->tree);
  return seeds;
}

void gather_best(std::vector<JointCandidates> found, std::vector<JointCandidates>& best) {
  if (best.empty()) {
    best = std::move(found);
    return;
  }
  for (std::size_t i = 0; i < best.size(); ++i) {
    ParetoFront front(std::move(best[i].front));
    for (const Individual& member : found[i].front) front.offer(member);
    best[i].front = std::move(front).release();
  }
}

}  // namespace

std::vector<Tree> good_formulas(const JointCandidates& candidates) {
  const TrainingTable& table = candidates.training.table;
  std::vector<std::pair<double, Tree>> by_nats;
  for (const Individual& member : candidates.front) {
    Tree brief = simplified_over(member.tree, table.variables);
    const double nats = description_nats_of_fit(brief, member.fitness, table);
    by_nats.emplace_back(nats, std::move(brief));
  }
  std::ranges::stable_sort(by_nats, {}, [](const auto& entry) { return entry.first; });
  std::vector<Tree> good;
  for (auto& [nats, tree] : by_nats) {
    if (good.size() == kGoodFormulas) break;
    if (std::ranges::find(good, tree) == good.end()) good.push_back(std::move(tree));
  }
  return good;
}

std::vector<SharedFunction> shared_functions(std::span<const JointCandidates> candidates,
                                             const SharingOptions& options) {
  if (options.functions == 0) return {};
  std::vector<std::vector<Tree>> formulas;
  for (const JointCandidates& joint : candidates) formulas.push_back(good_formulas(joint));
  return find_shared_functions(formulas, static_cast<std::size_t>(options.functions));
}

StagedOutcome learn_in_stages(const std::vector<JointTraining>& training, const Job& job, Evolver& evolver) {
  const int stages = std::min(job.corrections.sharing.stages, job.gp.number_generations);
  StagedOutcome outcome;
  std::vector<JointTraining> present = training;
  for (int stage = 0; stage < stages; ++stage) {
    if (stage > 0) {
      outcome.functions = shared_functions(outcome.candidates, job.corrections.sharing);
      for (std::size_t i = 0; i < present.size(); ++i)
        present[i].table.seeds = stage_seeds(outcome.candidates[i].front, job);
    }
    EvolutionTerms terms = terms_of_round(job.seed, job.gp.number_generations, stages, stage);
    terms.functions = outcome.functions;
    EvolvedJoints evolved = evolver.evolve(present, terms);
    gather_best(std::move(evolved.joints), outcome.candidates);
    if (!evolved.is_complete) break;
  }
  return outcome;
}

FoldedFormula folded_correction(const JointCorrection& correction, const KnownFunctions& functions) {
  if (!functions) return {correction.formula(), 1, {}};
  return folded(correction.formula(), *functions);
}

std::vector<int> joints_calling(const CorrectedRobot& robot, const std::vector<SharedFunction>& functions,
                                std::size_t place) {
  std::vector<int> joints;
  for (std::size_t joint = 0; joint < robot.corrections.size(); ++joint) {
    if (robot.corrections[joint].is_neutral()) continue;
    const FoldedFormula calling = folded_correction(robot.corrections[joint], functions);
    if (std::ranges::binary_search(functions_called(calling), place)) joints.push_back(static_cast<int>(joint));
  }
  return joints;
}

}  // namespace demecal::inline calibration
