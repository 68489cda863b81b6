// The messages between coordinator, workers and watchers as plain values (idl/calibration.idl is their wire form), and
// the topics that they travel on: who reads and writes each, and which values belong together.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "effect_sets/fitted_set.hpp"
#include "effect_sets/set_island.hpp"
#include "effect_sets/set_training.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/island.hpp"
#include "evolution/population.hpp"
#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"
#include "protocol/findings.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline protocol {

/// How many epochs of an island's emigrants are kept for slower neighbours.
/// More than neighbours can drift apart (an island waits for its sources, so along a ring of n demes by n - 1 at most)
/// and the epochs between two checkpoints together.
inline constexpr int kMigrantEpochs = 128;

/// More epochs than one progress reports.
inline constexpr std::size_t kMostReportedEpochs = 256;

/// Letters of the formula that a progress shows.
inline constexpr std::size_t kMostFormulaText = 511;

/// Names one evolution of one job; a coordinator that evolves again uses a new one.
using RunId = std::uint64_t;

/// What individuals are, or that none are bred: the islands are pieces of other work.
enum class Breeds { formulas, sets, work };

/// Coordinator -> workers, once per run: all that islands need to know but which of them to work on.
struct CalibrationData {
  RunId run = 0;
  std::string job;  ///< the job's name, for those who watch
  std::uint64_t seed = 0;
  GpParameters parameters;
  Archipelago archipelago;
  std::vector<TrainingTable> tables;  ///< parallel to archipelago.joints; none where no formulas are bred
  Breeds breeds = Breeds::formulas;
  SetTraining sets{};  ///< where these are bred, on islands of joint 0
  WorkInputs work{};   ///< where pieces of it are done: deme i of joint 0 makes piece i in its last epoch

  bool operator==(const CalibrationData&) const = default;
};

/// The data of a run that breeds sets of effects, without its number, the job and the seed.
CalibrationData data_of_search(const ExplanationProblem& problem, const SetSearch& search);

/// The same of one whose islands do work in pieces.
CalibrationData data_of_work(const SharedWork& work);

/// Worker -> workers: the elites of an island after an epoch.
struct Migrants {
  RunId run = 0;
  IslandKey island;
  std::uint32_t epoch = 0;  ///< epochs completed when they left: 1 after the first
  Population individuals;
  std::string worker{};  ///< who sends them; empty within another message

  bool operator==(const Migrants&) const = default;
};

/// Coordinator -> the named worker: work on this island, from this state on. A higher attempt replaces a lower one,
/// whoever it names.
struct IslandTask {
  RunId run = 0;
  IslandKey island;
  std::uint32_t attempt = 0;
  std::string worker;
  IslandState start;             ///< epoch 0 and empty for a fresh island
  std::vector<Migrants> recent;  ///< of that island, published again by the worker that goes on with it

  bool operator==(const IslandTask&) const = default;
};

/// How an island stood after an epoch.
struct EpochFigures {
  std::uint32_t epoch = 0;
  std::uint32_t generation = 0;
  IslandFigures figures;
  std::uint64_t evaluations = 0;  ///< since the island began
  std::uint64_t migrants_taken = 0;

  bool operator==(const EpochFigures&) const = default;
};

/// Worker -> coordinator and watchers, from time to time: figures of an island, with those of the epochs since its
/// last.
struct Progress {
  RunId run = 0;
  IslandKey island;
  std::string worker;
  std::uint32_t epoch = 0;
  std::uint32_t generation = 0;
  IslandFigures figures;
  std::uint64_t evaluations = 0;   ///< since the island began
  double evaluations_per_s = 0.0;  ///< of the last epoch
  std::uint64_t migrants_taken = 0;
  std::uint64_t migrants_sent = 0;     ///< where its worker took it over: with those of at most kMigrantEpochs before
  double waited_share = 0.0;           ///< of the time its worker has had it: spent waiting for neighbours
  std::string best_formula{};          ///< the text of its best, cut to kMostFormulaText; for people
  std::vector<EpochFigures> before{};  ///< ascending, of epochs not reported yet; less than kMostReportedEpochs

  bool operator==(const Progress&) const = default;
};

/// Worker -> coordinator, from time to time: where another worker can go on, with the emigrants that slower neighbours
/// may still need.
struct Checkpoint {
  RunId run = 0;
  std::uint32_t attempt = 0;
  IslandKey island;
  IslandState state;
  std::vector<Migrants> recent;  ///< its last kMigrantEpochs emigrations
  std::string worker{};

  bool operator==(const Checkpoint&) const = default;
};

/// Worker -> coordinator, when an island has bred all its generations.
struct Outcome {
  RunId run = 0;
  std::uint32_t attempt = 0;
  IslandKey island;
  std::string worker;
  std::uint32_t generations = 0;
  std::uint64_t evaluations = 0;
  std::uint64_t migrants_taken = 0;
  Population front;               ///< best of each length
  std::vector<double> numbers{};  ///< of a piece of work

  bool operator==(const Outcome&) const = default;
};

/// Worker -> coordinator and watchers: who I am; repeated as a sign of life.
struct WorkerStatus {
  std::string worker;  ///< unique: host, process id and start time
  std::string host;
  std::uint32_t process = 0;
  std::uint32_t slots = 1;  ///< islands it computes at once
  std::string version;
  bool leaving = false;
  RunId only_run = 0;         ///< 0: serves every run; else those of this one's coordinator alone
  double waited_share = 0.0;  ///< of its slots' time while it had islands to breed: without work

  bool operator==(const WorkerStatus&) const = default;
};

/// Coordinator -> workers and watchers.
struct Control {
  enum class State { running, finished, cancelled };
  RunId run = 0;
  State state = State::running;
  std::string note;  ///< for those who watch

  bool operator==(const Control&) const = default;
};

/// Coordinator -> watchers: how a calibration stands (round 0), and what became of each round of its closed loop.
struct LoopNews {
  enum class Stage { preparing, evolving, closing, finished, interrupted, failed };
  enum class Verdict { added, rejected, none };
  std::uint64_t calibration = 0;  ///< a number used once
  std::uint32_t round = 0;        ///< from 1; 0: none, but the stage
  RunId run = 0;                  ///< the evolution that goes on, or the last one; 0 before the first
  Stage stage = Stage::preparing;
  std::string job;   ///< its name
  std::string text;  ///< of a stage what is done; of a round the diagnosis, or why the effect was not added
  Verdict verdict = Verdict::none;
  std::string kind;                  ///< of the effect, a word of the catalogue; empty where there was none
  std::uint32_t joint = 0;           ///< of the effect, from 1; 0: of the whole arm or of the instrument
  std::string label;                 ///< the effect in words: "backlash, joint 2"
  double validation_before_m = 0.0;  ///< mean tool error on the validation poses; NaN where there are none
  double validation_after_m = 0.0;

  bool operator==(const LoopNews&) const = default;
};

/// Made by the transport, never sent: who wrote a calibration's LoopNews is gone.
struct CalibrationLost {
  std::uint64_t calibration = 0;

  bool operator==(const CalibrationLost&) const = default;
};

/// Made by the transport, never sent: a worker's sign of life stopped.
struct WorkerLost {
  std::string worker;

  bool operator==(const WorkerLost&) const = default;
};

/// Made by the transport: a piece of a message that is too large for a datagram.
struct MessagePart {
  std::uint32_t place = 0;    ///< of the message among those that its writer keeps
  std::uint32_t index = 0;    ///< from 0
  std::uint32_t count = 0;    ///< of the message's parts; 0: the place is vacant
  std::uint64_t message = 0;  ///< a number that its writer gives to one message only, ascending
  std::vector<std::uint8_t> bytes;

  bool operator==(const MessagePart&) const = default;
};

/// Made by the transport: a Progress as it travels.
struct PlacedProgress {
  std::string writer;       ///< the name of the participant
  std::uint32_t place = 0;  ///< as of a MessagePart
  bool over = false;        ///< the run is over: the place is vacant
  Progress progress;        ///< where it is over, of the run and nothing more

  bool operator==(const PlacedProgress&) const = default;
};

using Message = std::variant<CalibrationData, IslandTask, Migrants, Progress, Checkpoint, Outcome, WorkerStatus,
                             Control, LoopNews, CauseFound, FinalFigures, WorkerLost, CalibrationLost>;

/// Whether messages of this type travel; the others are made by the transport that delivers them.
template <class Plain>
inline constexpr bool kTravels = !std::is_same_v<Plain, WorkerLost> && !std::is_same_v<Plain, CalibrationLost>;

/// What a participant reads and writes: coordinators write data, tasks and control and read the rest but migrants;
/// workers the reverse, with migrants both ways; a reporter writes a calibration's loop news, causes and final figures,
/// and progress where no worker will, and reads nothing; watchers read what it writes, data, control and worker status,
/// and write nothing.
enum class Role { coordinator, worker, reporter, watcher };

enum class Topic { data, task, control, migrants, progress, checkpoint, outcome, worker, loop, cause, final_figures };
inline constexpr std::array kTopics{Topic::data,     Topic::task,       Topic::control,      Topic::migrants,
                                    Topic::progress, Topic::checkpoint, Topic::outcome,      Topic::worker,
                                    Topic::loop,     Topic::cause,      Topic::final_figures};

/// Whether a message travels; the others are made by the transport that delivers them.
bool is_sent(const Message& message);
/// The topic of a message; a WorkerLost has none, and asking for it fails a check.
Topic topic_of(const Message& message);

bool writes(Role role, Topic topic);
bool reads(Role role, Topic topic);
/// Whether this role's reader of the topic asks for what it missed, and acknowledges.
bool reads_reliably(Role role, Topic topic);
/// Whether a writer that leaves waits until what it wrote is acknowledged. No topic that watchers read reliably is.
bool is_awaited(Topic topic);

/// What a value is the latest of: its topic with those of the key fields that the topic has.
struct TopicKey {
  Topic topic = Topic::data;
  RunId run = 0;
  IslandKey island;
  std::string worker;
  std::uint64_t calibration = 0;
  std::uint32_t number = 0;  ///< of a round or cause
  auto operator<=>(const TopicKey&) const = default;
};
TopicKey key_of(const Message& message);
/// Whether messages of the topic belong to a run and are withdrawn at its end; Control, which reports the end, stays.
bool ends_with_run(Topic topic);
/// Whether a message of the topic may not fit into a datagram.
bool is_large(Topic topic);

/// How many of a key's values wait for those who come late.
int values_kept(Topic topic);

/// Breaks off where a participant of this role and name may not publish under this key.
void check_may_publish(Role role, const std::string& name, const TopicKey& key);

/// The run that this message ends, or 0.
RunId ended_run(const Message& message);

}  // namespace demecal::inline protocol
