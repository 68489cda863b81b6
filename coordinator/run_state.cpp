#include "coordinator/run_state.hpp"

#include <algorithm>
#include <set>

#include "protocol/faults.hpp"

namespace demecal {

RunState::RunState(CalibrationData data) : data_(std::move(data)) {
  for (const IslandKey island : islands(data_.archipelago)) isles_[island];
}

void RunState::rename(RunId run) {
  data_.run = run;
  for (auto& [island, isle] : isles_) {
    for (Migrants& migrants : isle.recent) migrants.run = run;
    for (auto& [epoch, progress] : isle.progress) progress.run = run;
  }
  for (auto& [island, outcome] : outcomes_) outcome.run = run;
}

bool RunState::take(const Progress& progress) {
  if (find_fault(progress, data_)) return false;
  std::map<std::uint32_t, Progress>& known = isles_.at(progress.island).progress;
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

bool RunState::all_told() const {
  const auto generations = static_cast<std::uint32_t>(data_.parameters.number_generations);
  return std::ranges::all_of(isles_, [generations](const auto& entry) {
    const auto& progress = entry.second.progress;
    return !progress.empty() && progress.rbegin()->second.generation == generations;
  });
}

bool RunState::take(const Checkpoint& checkpoint) {
  if (find_fault(checkpoint, data_)) return false;
  Isle& isle = isles_.at(checkpoint.island);
  // Whoever computed it: the state after an epoch is the same from every attempt.
  if (checkpoint.state.epoch <= isle.reached.epoch) return false;
  isle.reached = checkpoint.state;
  isle.recent = checkpoint.recent;
  return true;
}

bool RunState::take(const Outcome& outcome) {
  if (find_fault(outcome, data_)) return false;
  return outcomes_.try_emplace(outcome.island, outcome).second;
}

IslandTask RunState::task(IslandKey island, std::uint32_t attempt, const std::string& worker) const {
  const Isle& isle = isles_.at(island);
  return {data_.run, island, attempt, worker, isle.reached, isle.recent};
}

bool RunState::any_out_of_reach() const {
  if (data_.archipelago.asynchronous) return false;
  return std::ranges::any_of(isles_, [this](const auto& entry) {
    return std::ranges::any_of(sources(data_.archipelago, entry.first), [&](const IslandKey& source) {
      return isles_.at(source).reached.epoch >= entry.second.reached.epoch + kMigrantEpochs;
    });
  });
}

std::vector<Progress> RunState::progress() const {
  std::vector<Progress> all;
  for (const auto& [island, isle] : isles_)
    for (const auto& [epoch, progress] : isle.progress) all.push_back(progress);
  return all;
}

std::vector<Checkpoint> RunState::checkpoints() const {
  std::vector<Checkpoint> all;
  for (const auto& [island, isle] : isles_)
    if (isle.reached.epoch > 0) all.push_back({data_.run, 0, island, isle.reached, isle.recent});
  return all;
}

std::vector<Outcome> RunState::outcomes() const {
  std::vector<Outcome> all;
  for (const auto& [island, outcome] : outcomes_) all.push_back(outcome);
  return all;
}

RunResult RunState::result(RunEnd end) const {
  RunResult result;
  result.end = end;
  std::set<std::string> workers;
  for (const auto& [island, isle] : isles_) {
    const auto outcome = outcomes_.find(island);
    const bool done = outcome != outcomes_.end();
    result.fronts[island] = done ? outcome->second.front : isle.reached.front;
    result.generations += done ? outcome->second.generations : isle.reached.generation;
    result.evaluations += done ? outcome->second.evaluations : isle.reached.evaluations;
    result.migrations += done ? outcome->second.migrants_taken : isle.reached.migrants_taken;
    if (done) workers.insert(outcome->second.worker);
  }
  result.history = progress();
  result.workers = workers.size();
  return result;
}

}  // namespace demecal
