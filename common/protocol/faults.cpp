#include "protocol/faults.hpp"

#include "effect_sets/set_training.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/island.hpp"
#include "expression/tree.hpp"
#include "fitness/fitness.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace demecal::inline protocol {
namespace {

constexpr std::size_t kMostVariables = 255;

Fault size_fault(const GpParameters& p) {
  if (p.population_size > kMostIndividuals)
    return "more individuals than the limit, " + std::to_string(kMostIndividuals);
  if (p.number_generations > kMostGenerations)
    return "more generations than the limit, " + std::to_string(kMostGenerations);
  if (p.invalid_attempts > kMostAttempts)
    return "more attempts at an offspring than the limit, " + std::to_string(kMostAttempts);
  return std::nullopt;
}

Fault archipelago_fault(const Archipelago& a) {
  if (a.joints.empty() || a.joints.size() > kMostJoints) return "no joints, or too many";
  if (std::adjacent_find(a.joints.begin(), a.joints.end(), std::greater_equal<>()) != a.joints.end())
    return "joints are not ascending";
  if (a.joints.back() >= kMostJoints) return "a joint's number is too high";
  if (a.demes_per_joint < 1 || a.demes_per_joint > kMostDemes) return "no demes, or too many";
  if (a.topology != Topology::none && a.topology != Topology::ring && a.topology != Topology::full)
    return "unknown topology";
  if (a.replacement != Replacement::worst && a.replacement != Replacement::random) return "unknown replacement";
  if (!(a.spread >= 0.0 && a.spread <= 1.0)) return "a spread outside 0 to 1";
  if (a.migration_interval < 1) return "migration interval is 0";
  return std::nullopt;
}

Fault table_fault(const TrainingTable& table, const GpParameters& parameters) {
  const std::size_t rows = table.target.size();
  if (rows == 0 || rows > kMostRows) return "a table without rows, or with too many";
  if (table.variables.empty() || table.variables.size() > kMostVariables)
    return "a table without variables, or with too many";
  for (const auto& column : table.variables)
    if (!is_finite_column(column, rows)) return "a column of variables is not finite, or of another length";
  if (!is_finite_column(table.target, rows)) return "a target is not finite";
  if (!is_finite_column(table.weight, rows)) return "a weight is not finite, or there is not one per row";
  if (std::any_of(table.weight.begin(), table.weight.end(), [](double w) { return w < 0.0 || w > 1.0; }))
    return "a weight lies outside 0 to 1";
  if (table.loss != Loss::absolute && table.loss != Loss::squared) return "an unknown loss";
  if (table.seeds.size() > static_cast<std::size_t>(parameters.population_size)) return "more seeds than individuals";
  const auto variables = static_cast<int>(table.variables.size());
  if (!std::all_of(table.seeds.begin(), table.seeds.end(), [&](const Tree& seed) { return is_valid(seed, variables); }))
    return "a seed is no complete formula";
  if (!(table.limit >= 0.0)) return "a limit that is no size";
  if (variables > 1 && std::isfinite(table.limit)) return "a limit on formulas of several variables";
  return std::nullopt;
}

/// What an island of this run can reach.
struct Bounds {
  const GpParameters& parameters;
  const Archipelago& archipelago;
  const SetTraining* sets;  ///< where these are bred
  int variables;            ///< of the island's joint
  bool work = false;        ///< where pieces of it are done: nothing is bred
  std::size_t numbers = 0;  ///< that the island ends with

  std::uint32_t generations() const { return static_cast<std::uint32_t>(parameters.number_generations); }
  /// The founding epoch and those that breed; the last may be shorter.
  std::uint32_t epochs() const {
    const std::uint32_t interval = archipelago.migration_interval;
    return 1 + generations() / interval + (generations() % interval != 0);
  }
  /// Generations bred after so many epochs.
  std::uint64_t generations_after(std::uint32_t epoch) const {
    if (epoch == 0) return 0;
    return std::min<std::uint64_t>(generations(), std::uint64_t{epoch - 1} * archipelago.migration_interval);
  }
};

/// The bounds of an island, or the fault that it is none of this run's.
template <class IslandMessage>
Fault island_fault(const IslandMessage& message, const CalibrationData& data) {
  const auto& joints = data.archipelago.joints;
  if (message.run != data.run) return "of another run";
  if (!std::binary_search(joints.begin(), joints.end(), message.island.joint))
    return "of a joint that is not in the run";
  if (message.island.deme >= data.archipelago.demes_per_joint) return "of a deme that is not in the run";
  return std::nullopt;
}

Bounds bounds_of(const IslandKey& island, const CalibrationData& data) {
  const auto& joints = data.archipelago.joints;
  const auto place = std::lower_bound(joints.begin(), joints.end(), island.joint) - joints.begin();
  if (data.breeds == Breeds::sets) return {data.parameters, data.archipelago, &data.sets, 0};
  if (data.breeds == Breeds::work)
    return {data.parameters, data.archipelago, nullptr, 0, true, data.work.numbers_of_pieces[island.deme]};
  const auto variables = static_cast<int>(data.tables[static_cast<std::size_t>(place)].variables.size());
  return {data.parameters, data.archipelago, nullptr, variables};
}

Fault population_fault(const Population& population, const Bounds& bounds) {
  if (bounds.work) return population.empty() ? Fault{} : Fault{"individuals where nothing is bred"};
  return bounds.sets != nullptr ? find_fault(population, *bounds.sets)
                                : find_fault(population, bounds.parameters, bounds.variables);
}

Fault front_fault(const Population& front, const Bounds& bounds) {
  if (bounds.sets != nullptr) {
    if (front.size() > bounds.sets->most_sent()) return "a front with too many members";
    return population_fault(front, bounds);
  }
  if (front.size() > ParetoFront::kMostMembers) return "a front with too many members";
  for (const Individual& member : front)
    if (!std::isfinite(member.fitness)) return "a front with an individual of infinite fitness";
  for (std::size_t i = 1; i < front.size(); ++i)
    if (front[i].tree.size() <= front[i - 1].tree.size() || front[i].fitness >= front[i - 1].fitness)
      return "a front that is not ascending in length and falling in fitness";
  return population_fault(front, bounds);
}

/// Formulas are as many as the job says; of sets it depends on how many numbers of causes are reached.
bool is_full(const Population& population, const Bounds& bounds) {
  if (bounds.work) return population.empty();
  if (bounds.sets != nullptr) return !population.empty() && population.size() <= bounds.sets->most_kept();
  return population.size() == static_cast<std::size_t>(bounds.parameters.population_size);
}

Fault numbers_fault(const std::vector<double>& numbers, std::size_t count) {
  if (numbers.size() != count) return "more or fewer numbers than the piece gives";
  if (std::ranges::any_of(numbers, [](double number) { return std::isnan(number); }))
    return "a number of a piece is none";
  return std::nullopt;
}

Fault state_fault(const IslandState& state, const Bounds& bounds) {
  if (state.epoch > bounds.epochs()) return "more epochs than the run has";
  if (state.without_gain > state.epoch) return "more epochs without gain than epochs";
  if (state.generation != bounds.generations_after(state.epoch)) return "generations do not agree with epochs";
  if (state.epoch == 0 ? !state.population.empty() : !is_full(state.population, bounds))
    return "a population of the wrong size";
  if (auto fault = population_fault(state.population, bounds)) return fault;
  if (state.draws > (bounds.sets == nullptr ? 0 : bounds.sets->most_draws()))
    return "more random numbers than an island draws";
  if (auto fault = numbers_fault(state.numbers, state.epoch == bounds.epochs() ? bounds.numbers : 0)) return fault;
  return front_fault(state.front, bounds);
}

Fault recent_fault(const std::vector<Migrants>& recent, const IslandKey& island, std::uint32_t epoch,
                   const CalibrationData& data) {
  if (recent.size() > static_cast<std::size_t>(kMigrantEpochs)) return "too many recent emigrations";
  std::uint32_t before = 0;
  for (const Migrants& migrants : recent) {
    if (migrants.island != island) return "an emigration from another island";
    if (auto fault = find_fault(migrants, data)) return fault;
    if (migrants.epoch <= before || migrants.epoch > epoch) return "emigrations of impossible or unordered epochs";
    before = migrants.epoch;
  }
  return std::nullopt;
}

bool is_share(double value) {
  return value >= 0.0 && value <= 1.0;
}

Fault figures_fault(const IslandFigures& figures) {
  if (!(figures.best >= 0.0) || !(figures.median >= 0.0)) return "a fitness is negative or not a number";
  if (!is_share(figures.diversity)) return "a share outside 0 to 1";
  return std::nullopt;
}

Fault before_fault(const Progress& progress) {
  if (progress.before.size() >= kMostReportedEpochs) return "too many epochs at once";
  std::uint32_t last = 0;
  for (const EpochFigures& one : progress.before) {
    if (one.epoch <= last || one.epoch >= progress.epoch || one.generation > progress.generation)
      return "epochs that are impossible or unordered";
    if (auto fault = figures_fault(one.figures)) return fault;
    last = one.epoch;
  }
  return std::nullopt;
}

}  // namespace

bool is_finite_column(const std::vector<double>& column, std::size_t rows) {
  return column.size() == rows && std::all_of(column.begin(), column.end(), [](double x) { return std::isfinite(x); });
}

Fault find_fault(const CalibrationData& data) {
  if (data.run == 0) return "run 0 names no run";
  if (const auto fault = find_fault(data.parameters)) return fault->key + " = " + fault->value + " " + fault->rule;
  if (auto fault = size_fault(data.parameters)) return fault;
  if (auto fault = archipelago_fault(data.archipelago)) return fault;
  if (data.archipelago.migrants > static_cast<std::uint32_t>(data.parameters.population_size))
    return "more migrants than individuals";
  if (data.breeds != Breeds::work && data.work != WorkInputs{}) return "work where individuals are bred";
  if (data.breeds == Breeds::sets) return find_set_fault(data);
  if (!data.sets.columns.empty()) return "effects of sets where none are bred";
  if (data.breeds == Breeds::work) return find_work_fault(data);
  if (data.tables.size() != data.archipelago.joints.size()) return "not one table per joint";
  for (const TrainingTable& table : data.tables)
    if (auto fault = table_fault(table, data.parameters)) return fault;
  return std::nullopt;
}

Fault find_fault(const Population& population, const GpParameters& parameters, int variables) {
  for (const Individual& individual : population) {
    if (!is_valid(individual.tree, variables)) return "a tree is no complete formula";
    if (depth(individual.tree) > parameters.max_tree_depth) return "a tree is too deep";
    if (parameters.max_tree_nodes != 0 && individual.tree.size() > static_cast<std::size_t>(parameters.max_tree_nodes))
      return "a tree has too many nodes";
    if (!individual.effects.empty()) return "a formula with effects of a set";
    if (!(individual.fitness >= 0.0)) return "a fitness is negative or not a number";
  }
  return std::nullopt;
}

Fault find_fault(const Migrants& migrants, const CalibrationData& data) {
  if (auto fault = island_fault(migrants, data)) return fault;
  const Bounds bounds = bounds_of(migrants.island, data);
  if (migrants.epoch < 1 || migrants.epoch > bounds.epochs()) return "an epoch that the run does not have";
  if (migrants.individuals.size() > data.archipelago.migrants) return "more migrants than agreed";
  return population_fault(migrants.individuals, bounds);
}

Fault find_fault(const IslandTask& task, const CalibrationData& data) {
  if (auto fault = island_fault(task, data)) return fault;
  if (task.attempt == 0) return "attempt 0";
  if (task.worker.empty()) return "a task for nobody";
  if (auto fault = state_fault(task.start, bounds_of(task.island, data))) return fault;
  return recent_fault(task.recent, task.island, task.start.epoch, data);
}

Fault find_fault(const Progress& progress, const CalibrationData& data) {
  if (auto fault = island_fault(progress, data)) return fault;
  if (progress.worker.empty()) return "no worker is named";
  const Bounds bounds = bounds_of(progress.island, data);
  if (progress.epoch > bounds.epochs() || progress.generation > bounds.generations())
    return "more epochs or generations than the run has";
  if (!is_share(progress.waited_share)) return "a share outside 0 to 1";
  if (!(progress.evaluations_per_s >= 0.0) || !std::isfinite(progress.evaluations_per_s))
    return "a speed that is negative or not finite";
  if (auto fault = figures_fault(progress.figures)) return fault;
  return before_fault(progress);
}

Fault find_fault(const Checkpoint& checkpoint, const CalibrationData& data) {
  if (auto fault = island_fault(checkpoint, data)) return fault;
  if (auto fault = state_fault(checkpoint.state, bounds_of(checkpoint.island, data))) return fault;
  return recent_fault(checkpoint.recent, checkpoint.island, checkpoint.state.epoch, data);
}

Fault find_fault(const Outcome& outcome, const CalibrationData& data) {
  if (auto fault = island_fault(outcome, data)) return fault;
  if (outcome.worker.empty()) return "no worker is named";
  const Bounds bounds = bounds_of(outcome.island, data);
  if (outcome.generations != bounds.generations()) return "not all generations are bred";
  if (auto fault = numbers_fault(outcome.numbers, bounds.numbers)) return fault;
  return front_fault(outcome.front, bounds);
}

Fault find_fault(const WorkerStatus& status) {
  if (status.worker.empty()) return "no worker is named";
  if (status.slots < 1 || status.slots > kMostSlots) return "a worker without slots, or with too many";
  if (!is_share(status.waited_share)) return "a share outside 0 to 1";
  return std::nullopt;
}

}  // namespace demecal::inline protocol
