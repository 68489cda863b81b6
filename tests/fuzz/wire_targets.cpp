#include <cstring>

#include "../effect_sets/deceptive.hpp"
#include "../protocol/random_messages.hpp"
#include "../protocol/small_run.hpp"
#include "../shared_work/random_works.hpp"
#include "dds/participant.hpp"
#include "dds/parts.hpp"
#include "evolution/island.hpp"
#include "hosting/hosted_island.hpp"
#include "monitor/events.hpp"
#include "monitor/watched.hpp"
#include "protocol/faults.hpp"
#include "protocol/message_bytes.hpp"
#include "scheduling/run_state.hpp"
#include "targets.hpp"

namespace demecal::fuzz {
namespace {

const CalibrationData& the_run() {
  static const CalibrationData data = small_run();
  return data;
}

const CalibrationData& the_set_run() {
  static const CalibrationData data = [] {
    CalibrationData sets = data_of_search(deceptive(51), {.known = {1, 7}, .search = {.variations = 40}, .stream = 1});
    sets.run = 7;
    return sets;
  }();
  return data;
}

// What is done with a message that is accepted: nothing of it may break a precondition further in.

void breed_sets(const CalibrationData& data) {
  if (data.sets.moment.size() > 50 || data.sets.variations > 4000) return;
  HostedIsland island(std::make_shared<RunData>(data), {data.run, {0, 1}, 1, "w", {}, {}});
  island.run_epoch({}, [] {});
  demand(!find_fault(island.checkpoint("w"), data), "an island's own state is sound");
  HostedIsland another(std::make_shared<RunData>(data), {data.run, {0, 1}, 2, "v", island.checkpoint("w").state, {}});
  another.run_epoch(island.last_migrants().individuals, [] {});
}

void do_pieces(const CalibrationData& data) {
  constexpr std::size_t kMost = 20'000;  // numbers
  std::size_t numbers = data.work.numbers_of_pieces.size();
  for (const WorkTable& table : data.work.tables) numbers += table.numbers.size();
  for (const std::uint32_t count : data.work.numbers_of_pieces) numbers += count;
  if (numbers > kMost || find_fault(data)) return;
  const auto run = std::make_shared<RunData>(data);
  for (std::uint32_t piece = 0; piece < data.work.numbers_of_pieces.size(); ++piece) {
    HostedIsland island(run, {data.run, {0, piece}, 1, "w", {}, {}});
    while (!island.finished()) island.run_epoch({}, [] {});
    demand(island.outcome("w").numbers.size() == data.work.numbers_of_pieces[piece], "a piece gives what it says");
  }
}

void use(const CalibrationData& data) {
  if (data.breeds == Breeds::work) return do_pieces(data);
  std::size_t cells = 0;
  for (const TrainingTable& table : data.tables) cells += table.variables.size() * table.target.size();
  const bool is_small = data.parameters.population_size <= 50 && cells <= 10000 && data.tables.size() <= 4;
  if (find_fault(data) || !is_small) return;
  if (data.breeds == Breeds::sets) return breed_sets(data);
  const RunState state(data);
  for (std::size_t i = 0; i < data.tables.size(); ++i) {
    const IslandKey key{data.archipelago.joints[i], 0};
    Island island(data.parameters, data.archipelago, data.tables[i], key, data.seed);
    if (data.parameters.max_tree_depth <= 9 && data.parameters.invalid_attempts <= 50) island.run_epoch({});
    demand(!find_fault(Checkpoint{data.run, 1, key, island.state(), {}, "w"}, data), "an island's own state is sound");
  }
}

void host(const IslandTask& task, const std::shared_ptr<RunData>& run, const CalibrationData& data) {
  if (find_fault(task, data)) return;
  HostedIsland island(run, task);
  if (!island.finished()) {
    island.run_epoch({}, [] {});
    demand(!find_fault(island.last_migrants(), data), "what an island sends is sound");
    const auto progress = island.due_progress("w", std::chrono::milliseconds(0));
    demand(progress && !find_fault(*progress, data), "what an island reports is sound");
  }
  demand(!find_fault(island.outcome("w"), data) || !island.finished(), "what an island ends with is sound");
}
void use(const IslandTask& task) {
  static const auto run = std::make_shared<RunData>(the_run()), set_run = std::make_shared<RunData>(the_set_run());
  host(task, run, the_run());
  host(task, set_run, the_set_run());
}

void use_sets(const Migrants& migrants) {
  if (find_fault(migrants, the_set_run())) return;
  static const ExplanationProblem problem = problem_of(the_set_run().sets);
  SetIsland island(problem, search_of(the_set_run().sets), migrants.island);
  island.run_epoch({});
  island.run_epoch(migrants.individuals);
}
void use(const Migrants& migrants) {
  use_sets(migrants);
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
void use(const CauseFound& cause) {
  demand(is_printable(cause.label) && is_printable(cause.advice), "printable");
}
void use(const FinalFigures& figures) {
  demand(is_printable(figures.job), "printable");
}

template <class Plain>
void use_decoded(const Plain& message) {
  // To the bit, since a number that is none equals nothing.
  demand(to_bytes(message) == to_bytes(*from_bytes<Plain>(to_bytes(message))),
         "what was decoded comes back from its bytes");
  use(message);
  Watched watched;
  watched.take(message, 1.0);
  event_line(message, 1.0);
}

/// As Fast DDS hands it over, little endian or big as the bytes say.
template <class Plain>
Sample<Plain> sample_from(Topic topic, std::string_view bytes) {
  static const auto type = topic_type(topic);
  eprosima::fastrtps::rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size() + 1));
  std::memcpy(payload.data, bytes.data(), bytes.size());
  payload.length = static_cast<std::uint32_t>(bytes.size());
  Sample<Plain> sample;
  demand(type.get()->deserialize(&payload, &sample), "a sample is read, or is empty");
  return sample;
}

/// Of a message that is a sample.
template <class Plain>
Target sample_target(const std::string& name, Topic topic, const Plain& message) {
  return {name, {to_sample(message)}, [topic](std::string_view bytes) {
            if (const auto read = sample_from<Plain>(topic, bytes)) use_decoded(*read);
          }};
}

Target progress_target(const Progress& progress) {
  return {"sample_progress", {to_sample(PlacedProgress{"w", 7, false, progress})}, [](std::string_view bytes) {
            if (const auto read = sample_from<PlacedProgress>(Topic::progress, bytes)) use_decoded(read->progress);
          }};
}

/// Of a message that travels in parts, when these have been put together.
template <class Plain>
Target target(const std::string& name, const std::vector<Plain>& messages) {
  Target made{name, {}, [](std::string_view bytes) {
                if (const auto read = from_bytes<Plain>(bytes)) use_decoded(*read);
              }};
  for (const Plain& message : messages) made.seeds.push_back(to_bytes(message));
  return made;
}

// Samples one after the other: a byte says of which of two writers, two how long it is.

std::string stream_of(const std::vector<MessagePart>& parts) {
  std::string stream;
  for (const MessagePart& part : parts) {
    const std::string sample = to_sample(part);
    stream += '\0';
    stream += static_cast<char>(sample.size() % 256);
    stream += static_cast<char>(sample.size() / 256);
    stream += sample;
  }
  return stream;
}

void put_together(std::string_view stream) {
  constexpr std::size_t kFew_bytes = 200'000, kHead_bytes = 3;
  MessageAssembler assembly(kFew_bytes);
  int departures = 0;
  while (stream.size() > kHead_bytes) {
    WriterId writer{};
    writer[0] = static_cast<std::uint8_t>(stream[0]) % 2;
    const std::size_t size = static_cast<std::uint8_t>(stream[1]) + 256u * static_cast<std::uint8_t>(stream[2]);
    const std::string_view sample = stream.substr(kHead_bytes, size);
    stream.remove_prefix(kHead_bytes + sample.size());
    const auto part = sample_from<MessagePart>(Topic::task, sample);
    const auto result = part ? assembly.take(writer, *part) : MessageAssembler::Result{};
    demand(result.bytes.empty() || result.verdict == MessageAssembler::Verdict::whole,
           "only what is whole is handed over");
    demand(result.bytes.size() <= kFew_bytes, "no more than may be kept is put together");
    if (sample.empty()) assembly.departed(writer, MessageAssembler::Time{} + departures++ * std::chrono::seconds{30});
  }
}

Target parts_target() {
  std::vector<MessagePart> parts;
  for (const std::size_t size : {std::size_t{40}, kPart_bytes + 5})
    for (const MessagePart& part : split_into_parts(std::string(size, 'x'), 3, 1 + parts.size())) parts.push_back(part);
  parts.push_back(vacant_part(3, 1, 9));
  return {"sample_parts", {stream_of(parts)}, put_together};
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

/// A run for each kind of work.
std::vector<CalibrationData> work_runs() {
  std::vector<CalibrationData> runs;
  for (const WorkInputs& inputs : inputs_of_all_kinds(5)) {
    runs.push_back(data_of_work(*received_work(inputs)));
    runs.back().run = 7;
    demand(!find_fault(runs.back()), "work as it is made is sound");
  }
  return runs;
}

}  // namespace

std::vector<Target> wire_targets() {
  RandomMessages random(3, "w");
  const Checkpoint last = told_after(kEpochsOfSmallRun);
  CalibrationData sharing = the_run();
  sharing.parameters.shared_functions = {parse_definition("F1(c1, a1, a2) = c1 * SIN(a1) + a2", 0)};
  HostedIsland of_sets(std::make_shared<RunData>(the_set_run()), {7, {0, 2}, 1, "w", {}, {}});
  for (int i = 0; i < 3; ++i) of_sets.run_epoch({}, [] {});
  const Checkpoint set_checkpoint = of_sets.checkpoint("w");
  const IslandTask set_task{7, {0, 2}, 1, "w", set_checkpoint.state, set_checkpoint.recent};
  return {parts_target(),
          target<CalibrationData>("message_data", {the_run(), sharing, the_set_run(), random.data()}),
          target<CalibrationData>("message_work", work_runs()),
          target<IslandTask>("message_task", {task_after(0), task_after(1), set_task, random.task()}),
          target<Migrants>("message_migrants", {migrants_of(last), migrants_of(set_checkpoint), random.migrants()}),
          target<Progress>("message_progress", {progress_of(last), random.progress()}),
          target<Checkpoint>("message_checkpoint", {told_after(1), set_checkpoint, random.checkpoint()}),
          target<Outcome>("message_outcome", {outcome_of(last), random.outcome()}),
          progress_target(progress_of(last)),
          sample_target("sample_worker", Topic::worker, random.status()),
          sample_target("sample_control", Topic::control, random.control()),
          sample_target("sample_loop", Topic::loop, random.news()),
          sample_target("sample_cause", Topic::cause, random.cause()),
          sample_target("sample_final_figures", Topic::final_figures, random.figures())};
}

}  // namespace demecal::fuzz
