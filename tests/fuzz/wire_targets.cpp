#include <cstring>

#include "../protocol/small_run.hpp"
#include "../transport/random_messages.hpp"
#include "coordinator/run_state.hpp"
#include "evolution/island.hpp"
#include "monitor/event_line.hpp"
#include "monitor/watched.hpp"
#include "protocol/faults.hpp"
#include "protocol/printable.hpp"
#include "targets.hpp"
#include "transport/dds_types.hpp"
#include "transport/message_bytes.hpp"
#include "transport/wire_form.hpp"
#include "worker/tenancy.hpp"

namespace demecal::fuzz {
namespace {

const CalibrationData& the_run() {
  static const CalibrationData data = small_run();
  return data;
}

// What is done with a message that is believed: nothing of it may break a promise further in.

void use(const CalibrationData& data) {
  std::size_t cells = 0;
  for (const TrainingTable& table : data.tables) cells += table.variables.size() * table.target.size();
  const bool is_small = data.parameters.population_size <= 50 && cells <= 10000 && data.tables.size() <= 4;
  if (find_fault(data) || !is_small) return;
  const RunState state(data);
  for (std::size_t i = 0; i < data.tables.size(); ++i) {
    const IslandKey key{data.archipelago.joints[i], 0};
    Island island(data.parameters, data.archipelago, data.tables[i], key, data.seed);
    if (data.parameters.max_tree_depth <= 9 && data.parameters.invalid_attempts <= 50) island.run_epoch({});
    demand(!find_fault(Checkpoint{data.run, 1, key, island.state(), {}, "w"}, data), "an island's own state is sound");
  }
}

void use(const IslandTask& task) {
  if (find_fault(task, the_run())) return;
  static const auto run = std::make_shared<RunData>(RunData{the_run()});
  Tenancy tenancy(run, task);
  if (!tenancy.finished()) {
    tenancy.run_epoch({}, [] {});
    demand(!find_fault(tenancy.last_migrants(), the_run()), "what an island sends is sound");
    const auto progress = tenancy.due_progress("w", std::chrono::milliseconds(0));
    demand(progress && !find_fault(*progress, the_run()), "what an island tells is sound");
  }
  demand(!find_fault(tenancy.outcome("w"), the_run()) || !tenancy.finished(), "what an island ends with is sound");
}

void use(const Migrants& migrants) {
  if (find_fault(migrants, the_run())) return;
  const auto joint = static_cast<std::size_t>(migrants.island.joint == the_run().archipelago.joints[1]);
  Island island(the_run().parameters, the_run().archipelago, the_run().tables[joint], migrants.island, 1);
  island.run_epoch({});
  island.run_epoch(migrants.individuals);
}

template <class OfIsland>
void grow(const OfIsland& message) {
  if (find_fault(message, the_run())) return;
  RunState state(the_run());
  state.take(message);
  state.result(RunEnd::interrupted);
  demand(!find_fault(state.task(message.island, 1, "w"), the_run()), "a task made of what was taken is sound");
}
void use(const Progress& message) {
  grow(message);
}
void use(const Checkpoint& message) {
  grow(message);
}
void use(const Outcome& message) {
  grow(message);
}

void use(const WorkerStatus& status) {
  demand(is_printable(status.worker) && is_printable(status.host), "printable");
}
void use(const Control& control) {
  demand(is_printable(control.note), "printable");
}
void use(const LoopNews& news) {
  demand(is_printable(news.text) && is_printable(news.label), "printable");
}

/// As Fast DDS hands it over, little endian or big as the bytes say.
template <class Wire>
void read_sample(Topic topic, std::string_view bytes) {
  static const auto type = topic_type(topic);
  eprosima::fastrtps::rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size() + 1));
  std::memcpy(payload.data, bytes.data(), bytes.size());
  payload.length = static_cast<std::uint32_t>(bytes.size());
  Wire sample;
  demand(type.get()->deserialize(&payload, &sample), "a sample is read, or is empty");
  const auto message = decode(sample);
  if (!message) return;
  // To the bit, since a number that is none equals nothing.
  demand(to_bytes(*message) == to_bytes(*message_of<std::decay_t<decltype(*message)>>(to_bytes(*message))),
         "what was decoded comes back from its bytes");
  use(*message);
  Watched watched;
  watched.take(*message, 1.0);
  event_line(*message, 1.0);
}

/// Behind the encapsulation that says little endian.
template <class Plain>
std::string sample_of(const Plain& message) {
  return std::string("\0\1\0\0", 4) + to_bytes(message);
}

template <class Plain>
Target target(const std::string& name, Topic topic, const std::vector<Plain>& messages) {
  Target made{name, {}, [topic](std::string_view bytes) { read_sample<decltype(encode(Plain{}))>(topic, bytes); }};
  for (const Plain& message : messages) made.seeds.push_back(sample_of(message));
  return made;
}

IslandTask task_after(std::uint32_t epochs) {
  const Checkpoint checkpoint = checkpoint_after(the_run(), epochs);
  return {checkpoint.run, checkpoint.island, 1, "w", checkpoint.state, checkpoint.recent};
}

Checkpoint told_after(std::uint32_t epochs) {
  Checkpoint checkpoint = checkpoint_after(the_run(), epochs);
  checkpoint.worker = "w";
  return checkpoint;
}

Migrants migrants_of(const Checkpoint& checkpoint) {
  Migrants migrants = checkpoint.recent.back();
  migrants.worker = "w";
  return migrants;
}

Outcome outcome_of(const Checkpoint& last) {
  return {last.run, 1, last.island, "w", last.state.generation, last.state.evaluations, 0, last.state.front};
}

Progress progress_of(const Checkpoint& checkpoint) {
  RandomMessages random(5, "w");
  Progress progress = random.progress();
  progress.run = checkpoint.run;
  progress.island = checkpoint.island;
  progress.epoch = checkpoint.state.epoch;
  progress.generation = checkpoint.state.generation;
  return progress;
}

}  // namespace

std::vector<Target> wire_targets() {
  RandomMessages random(3, "w");
  const Checkpoint last = told_after(kEpochsOfSmallRun);
  CalibrationData sharing = the_run();
  sharing.parameters.shared_functions = {parse_definition("F1(c1, a1, a2) = c1 * SIN(a1) + a2", 0)};
  return {target<CalibrationData>("sample_data", Topic::data, {the_run(), sharing, random.data()}),
          target<IslandTask>("sample_task", Topic::task, {task_after(0), task_after(1), random.task()}),
          target<Migrants>("sample_migrants", Topic::migrants, {migrants_of(last), random.migrants()}),
          target<Progress>("sample_progress", Topic::progress, {progress_of(last), random.progress()}),
          target<Checkpoint>("sample_checkpoint", Topic::checkpoint, {told_after(1), random.checkpoint()}),
          target<Outcome>("sample_outcome", Topic::outcome, {outcome_of(last), random.outcome()}),
          target<WorkerStatus>("sample_worker", Topic::worker, {random.status()}),
          target<Control>("sample_control", Topic::control, {random.control()}),
          target<LoopNews>("sample_loop", Topic::loop, {random.news()})};
}

}  // namespace demecal::fuzz
