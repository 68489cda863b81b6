#include "scheduling/run_state.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "fitness/parameters.hpp"
#include "protocol/faults.hpp"

namespace demecal::inline scheduling {

RunState::RunState(CalibrationData data) : data_(std::move(data)) {
  for (const IslandKey key : islands(data_.archipelago)) islands_[key];
}

void RunState::rename(RunId run) {
  data_.run = run;
  for (auto& [key, island] : islands_) {
    for (Migrants& migrants : island.recent) migrants.run = run;
    for (auto& [epoch, progress] : island.progress) progress.run = run;
    if (island.outcome) island.outcome->run = run;
  }
}

bool RunState::take(const Progress& progress) {
  if (find_fault(progress, data_)) return false;
  std::map<std::uint32_t, Progress>& known = islands_.at(progress.island).progress;
  Progress one = progress;
  one.before.clear();
  const bool is_news = known.try_emplace(one.epoch, one).second;
  for (const EpochFigures& before : progress.before) {
    one.epoch = before.epoch;
    one.generation = before.generation;
    one.figures = before.figures;
    one.evaluations = before.evaluations;
    one.migrants_taken = before.migrants_taken;
    known.try_emplace(one.epoch, one);
  }
  return is_news;
}

bool RunState::has_all_progress() const {
  const auto generations = static_cast<std::uint32_t>(data_.parameters.number_generations);
  return std::ranges::all_of(islands_, [generations](const auto& entry) {
    const auto& progress = entry.second.progress;
    return !progress.empty() && progress.rbegin()->second.generation == generations;
  });
}

bool RunState::take(const Checkpoint& checkpoint) {
  if (find_fault(checkpoint, data_)) return false;
  IslandRecord& island = islands_.at(checkpoint.island);
  // Whoever computed it: the state after an epoch is the same from every attempt.
  if (checkpoint.state.epoch <= island.reached.epoch) return false;
  island.reached = checkpoint.state;
  island.recent = checkpoint.recent;
  return true;
}

bool RunState::take(const Outcome& outcome) {
  if (find_fault(outcome, data_)) return false;
  IslandRecord& island = islands_.at(outcome.island);
  if (island.outcome) return false;
  island.outcome = outcome;
  ++finished_;
  return true;
}

IslandTask RunState::task(IslandKey key, std::uint32_t attempt, const std::string& worker) const {
  const IslandRecord& island = islands_.at(key);
  return {data_.run, key, attempt, worker, island.reached, island.recent};
}

bool RunState::any_out_of_reach() const {
  if (data_.archipelago.asynchronous) return false;
  return std::ranges::any_of(islands_, [this](const auto& entry) {
    return std::ranges::any_of(sources(data_.archipelago, entry.first), [&](const IslandKey& source) {
      return islands_.at(source).reached.epoch >= entry.second.reached.epoch + kMigrantEpochs;
    });
  });
}

std::vector<Progress> RunState::progress() const {
  std::vector<Progress> all;
  for (const auto& [key, island] : islands_)
    for (const auto& [epoch, progress] : island.progress) all.push_back(progress);
  return all;
}

std::vector<Checkpoint> RunState::checkpoints() const {
  std::vector<Checkpoint> all;
  for (const auto& [key, island] : islands_)
    if (island.reached.epoch > 0) all.push_back({data_.run, 0, key, island.reached, island.recent});
  return all;
}

std::vector<Outcome> RunState::outcomes() const {
  std::vector<Outcome> all;
  for (const auto& [key, island] : islands_)
    if (island.outcome) all.push_back(*island.outcome);
  return all;
}

RunResult RunState::result(RunEnd end) const {
  RunResult result;
  result.end = end;
  std::set<std::string> workers;
  for (const auto& [key, island] : islands_) {
    const auto& outcome = island.outcome;
    result.fronts[key] = outcome ? outcome->front : island.reached.front;
    result.generations += outcome ? outcome->generations : island.reached.generation;
    result.evaluations += outcome ? outcome->evaluations : island.reached.evaluations;
    result.migrations += outcome ? outcome->migrants_taken : island.reached.migrants_taken;
    if (outcome) workers.insert(outcome->worker);
  }
  result.history = progress();
  result.workers = workers.size();
  return result;
}

}  // namespace demecal::inline scheduling
