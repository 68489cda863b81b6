#include "protocol/messages.hpp"

#include "errors/check.hpp"

namespace demecal::inline protocol {
namespace {

struct KeyOf {
  TopicKey operator()(const CalibrationData& m) const { return {Topic::data, m.run, {}, {}}; }
  TopicKey operator()(const IslandTask& m) const { return {Topic::task, m.run, m.island, {}}; }
  TopicKey operator()(const Control& m) const { return {Topic::control, m.run, {}, {}}; }
  TopicKey operator()(const Migrants& m) const { return {Topic::migrants, m.run, m.island, {}}; }
  TopicKey operator()(const Progress& m) const { return {Topic::progress, m.run, m.island, {}}; }
  TopicKey operator()(const Checkpoint& m) const { return {Topic::checkpoint, m.run, m.island, {}}; }
  TopicKey operator()(const Outcome& m) const { return {Topic::outcome, m.run, m.island, {}}; }
  TopicKey operator()(const WorkerStatus& m) const { return {Topic::worker, 0, {}, m.worker}; }
  TopicKey operator()(const LoopNews& m) const { return {Topic::loop, 0, {}, {}, m.calibration, m.round}; }
  TopicKey operator()(const CauseFound& m) const { return {Topic::cause, 0, {}, {}, m.calibration, m.number}; }
  TopicKey operator()(const FinalFigures& m) const { return {Topic::final_figures, 0, {}, {}, m.calibration}; }
  TopicKey operator()(const WorkerLost& m) const {
    DEMECAL_CHECK(false, "WorkerLost is never sent; worker=" << m.worker);
    return {};
  }
  TopicKey operator()(const CalibrationLost& m) const {
    DEMECAL_CHECK(false, "CalibrationLost is never sent; calibration=" << m.calibration);
    return {};
  }
};

/// What a reporter says of a calibration, which has no run.
bool is_of_calibration(Topic topic) {
  return topic == Topic::loop || topic == Topic::cause || topic == Topic::final_figures;
}

}  // namespace

CalibrationData data_of_search(const ExplanationProblem& problem, const SetSearch& search) {
  CalibrationData data;
  data.breeds = Breeds::sets;
  data.sets = set_training(problem, search);
  data.parameters.population_size = static_cast<int>(data.sets.most_kept());
  data.parameters.number_generations = static_cast<int>(kSetEpochs) - 1;
  data.archipelago.joints = {0};
  data.archipelago.demes_per_joint = kSetIslands;
  data.archipelago.topology = Topology::ring;
  data.archipelago.migration_interval = 1;
  data.archipelago.migrants = static_cast<std::uint32_t>(data.sets.most_sent());
  return data;
}

CalibrationData data_of_work(const SharedWork& work) {
  CalibrationData data;
  data.breeds = Breeds::work;
  data.work = work.inputs();
  data.parameters.number_generations = 1;
  data.archipelago.joints = {0};
  data.archipelago.demes_per_joint = static_cast<std::uint32_t>(work.pieces());
  data.archipelago.topology = Topology::none;
  data.archipelago.migration_interval = 1;
  data.archipelago.migrants = 0;
  return data;
}

TopicKey key_of(const Message& message) {
  return std::visit(KeyOf{}, message);
}

bool is_sent(const Message& message) {
  return !std::holds_alternative<WorkerLost>(message) && !std::holds_alternative<CalibrationLost>(message);
}

Topic topic_of(const Message& message) {
  return key_of(message).topic;
}

bool writes(Role role, Topic topic) {
  const bool of_coordinator = topic == Topic::data || topic == Topic::task || topic == Topic::control;
  switch (role) {
    case Role::coordinator:
      return of_coordinator;
    case Role::worker:
      return !of_coordinator && !is_of_calibration(topic);
    case Role::reporter:
      return is_of_calibration(topic) || topic == Topic::progress;
    case Role::watcher:
      break;
  }
  return false;
}

bool reads(Role role, Topic topic) {
  switch (role) {
    case Role::coordinator:
      return writes(Role::worker, topic) && topic != Topic::migrants;
    case Role::worker:
      return writes(Role::coordinator, topic) || topic == Topic::migrants;
    case Role::watcher:
      return topic == Topic::control || topic == Topic::worker || reads_reliably(role, topic);
    case Role::reporter:
      break;
  }
  return false;
}

bool reads_reliably(Role role, Topic topic) {
  return role != Role::watcher || !is_awaited(topic);
}

bool is_awaited(Topic topic) {
  return topic != Topic::data && topic != Topic::progress && !is_of_calibration(topic);
}

bool ends_with_run(Topic topic) {
  return topic != Topic::control && topic != Topic::worker && !is_of_calibration(topic);
}

bool is_large(Topic topic) {
  return ends_with_run(topic) && topic != Topic::progress;
}

int values_kept(Topic topic) {
  return topic == Topic::migrants ? kMigrantEpochs : 1;
}

void check_may_publish(Role role, const std::string& name, const TopicKey& key) {
  DEMECAL_CHECK(writes(role, key.topic),
                "role=" << static_cast<int>(role) << " topic=" << static_cast<int>(key.topic) << " name=" << name);
  DEMECAL_CHECK(key.topic != Topic::worker || key.worker == name,
                "'" << name << "' publishes as '" << key.worker << "'");
}

RunId ended_run(const Message& message) {
  const auto* control = std::get_if<Control>(&message);
  return control != nullptr && control->state != Control::State::running ? control->run : 0;
}

}  // namespace demecal::inline protocol
