#include "forger.hpp"

#include <algorithm>

#include "evolution/island.hpp"

namespace demecal {

void Forger::hear(const Message& message) {
  if (const auto* data = std::get_if<CalibrationData>(&message)) {
    data_ = other_data_ = *data;
    other_data_->seed += 1;
    for (TrainingTable& table : other_data_->tables)
      for (double& target : table.target) target = -target;
    bred_.clear();
  }
  if (const auto* task = std::get_if<IslandTask>(&message))
    if (std::ranges::find(workers_, task->worker) == workers_.end()) workers_.push_back(task->worker);
}

const Checkpoint& Forger::bred(IslandKey key) {
  if (const auto known = bred_.find(key); known != bred_.end()) return known->second;
  const auto& joints = other_data_->archipelago.joints;
  const auto place = static_cast<std::size_t>(std::ranges::find(joints, key.joint) - joints.begin());
  Island island(other_data_->parameters, other_data_->archipelago, other_data_->tables[place], key, other_data_->seed);
  Checkpoint& checkpoint = bred_[key];
  while (!island.finished()) {
    island.run_epoch({});
    checkpoint.recent.push_back({data_->run, key, island.state().epoch, island.emigrants(), {}});
  }
  while (checkpoint.recent.size() > static_cast<std::size_t>(kMigrantEpochs))
    checkpoint.recent.erase(checkpoint.recent.begin());
  checkpoint.run = data_->run;
  checkpoint.island = key;
  checkpoint.state = island.state();
  for (Individual& individual : checkpoint.state.population) individual.fitness = 0.0;
  return checkpoint;
}

Message Forger::forge() {
  const std::string worker = workers_[random_.index(workers_.size())];
  if (!data_) return WorkerStatus{.worker = "intruder", .host = "elsewhere", .slots = 4000, .version = "\033[2J"};
  const std::vector<IslandKey> all = islands(data_->archipelago);
  return forge_about(all[random_.index(all.size())], worker);
}

Message Forger::forge_about(IslandKey island, const std::string& worker) {
  const RunId run = random_.chance(0.8) ? data_->run : data_->run + 1 + random_.index(1000);
  const auto attempt = static_cast<std::uint32_t>(1 + random_.index(3));
  const Checkpoint& state = bred(island);
  switch (random_.index(12)) {
    case 0: {
      CalibrationData data = *other_data_;
      data.run = run;
      return data;
    }
    case 1:
      return IslandTask{run, island, 0xFFFFFFF0U + attempt, worker, state.state, state.recent};
    case 2:
      return Control{run, random_.chance(0.5) ? Control::State::cancelled : Control::State::finished, "over"};
    case 3: {
      Migrants migrants = state.recent[random_.index(state.recent.size())];
      migrants.run = run;
      migrants.worker = worker;
      return migrants;
    }
    case 4: {
      Progress progress;
      progress.run = run;
      progress.island = island;
      progress.worker = worker;
      progress.epoch = state.state.epoch;
      return progress;
    }
    case 5: {
      Checkpoint checkpoint = state;
      checkpoint.run = run;
      checkpoint.attempt = attempt;
      checkpoint.worker = worker;
      return checkpoint;
    }
    case 6:
      return Outcome{run, attempt, island, worker, state.state.generation, 1, 1, state.state.front};
    case 7:
      return WorkerStatus{.worker = worker, .host = "elsewhere", .slots = 4000, .version = "v", .leaving = true};
    case 8:
      return WorkerStatus{.worker = worker, .host = "elsewhere", .slots = 4000, .version = "v"};
    case 9:
      return CauseFound{
          .calibration = run, .number = attempt, .cause = "formula", .label = "\033[2J", .advice = "stop"};
    case 10:
      return FinalFigures{.calibration = run, .job = "\033[2J", .causes = 0xFFFFFFFFU};
    default: {
      LoopNews news;
      news.calibration = news.run = run;
      news.stage = LoopNews::Stage::failed;
      return news;
    }
  }
}

}  // namespace demecal
