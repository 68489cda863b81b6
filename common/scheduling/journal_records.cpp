#include "effect_sets/set_training.hpp"
#include "scheduling/run_journal.hpp"

#include <fmt/format.h>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/archipelago.hpp"
#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"
#include "protocol/faults.hpp"
#include "protocol/message_bytes.hpp"
#include "protocol/messages.hpp"
#include "scheduling/journal_file.hpp"
#include "scheduling/run_state.hpp"

namespace demecal::inline scheduling {
namespace {

// What a record's content begins with; an evolution's number follows, but in the first.
constexpr char kIdentity = 'I', kBegin = 'B', kForget = 'F', kProgress = 'P', kOutcome = 'O', kSnapshot = 'S';

std::string record(char kind, std::uint32_t evolution, const std::string& content) {
  return record_of(kind + bytes_of(evolution) + content);
}

/// The first `size` bytes, which are taken off `bytes`; nothing where there are fewer.
std::optional<std::string_view> take_off(std::string_view& bytes, std::size_t size) {
  if (bytes.size() < size) return std::nullopt;
  const std::string_view taken = bytes.substr(0, size);
  bytes.remove_prefix(size);
  return taken;
}

std::optional<std::uint32_t> take_number(std::string_view& bytes) {
  const auto taken = take_off(bytes, 4);
  if (!taken) return std::nullopt;
  return number_of(*taken);
}

std::optional<JobIdentity> parse_identity(std::string_view content) {
  std::istringstream lines{std::string(content)};
  JobIdentity identity;
  lines >> identity.data_sha256 >> identity.job_sha256 >> identity.seed >> identity.asynchronous >> identity.version;
  if (!lines) return std::nullopt;
  return identity;
}

/// Grows the evolutions by one record; whether the record makes sense.
class Reading {
 public:
  explicit Reading(RecordedJob& job) : job_(job) {}

  bool take(std::string_view content) {
    const auto kind = take_off(content, 1);
    if (!kind) return false;
    if (kind->front() == kIdentity) {
      job_.identity = parse_identity(content);
      return job_.identity.has_value();
    }
    const auto evolution = take_number(content);
    if (!evolution || !job_.identity) return false;
    if (kind->front() == kBegin) return begin(*evolution, content);
    if (*evolution >= job_.evolutions.size()) return false;
    RunState& state = job_.evolutions[*evolution];
    if (kind->front() == kForget) return forget(state);
    if (kind->front() == kProgress) return grow<Progress>(state, content);
    if (kind->front() == kOutcome) return grow<Outcome>(state, content);
    return kind->front() == kSnapshot && snapshot(state, content);
  }

 private:
  bool begin(std::uint32_t evolution, std::string_view content) {
    const auto data = from_bytes<CalibrationData>(content);
    if (!data || find_fault(*data) || evolution > job_.evolutions.size()) return false;
    if (evolution == job_.evolutions.size()) job_.evolutions.emplace_back(*data);
    job_.evolutions[evolution].rename(data->run);
    job_.runs.push_back(data->run);
    return same_evolution(*data, job_.evolutions[evolution].data());
  }

  static bool forget(RunState& state) {
    state = RunState(state.data());
    return true;
  }

  template <class Plain>
  bool grow(RunState& state, std::string_view content) {
    const auto message = from_bytes<Plain>(content);
    if (!message || find_fault(*message, state.data())) return false;
    state.take(*message);
    return true;
  }

  bool snapshot(RunState& state, std::string_view content) {
    while (!content.empty()) {
      const auto size = take_number(content);
      const auto checkpoint = size ? take_off(content, *size) : std::nullopt;
      if (!checkpoint || !grow<Checkpoint>(state, *checkpoint)) return false;
    }
    return true;
  }

  RecordedJob& job_;
};

}  // namespace

std::optional<std::string> difference(const JobIdentity& recorded, const JobIdentity& present) {
  if (recorded.data_sha256 != present.data_sha256) return "the poses, the data set or the robot have changed since";
  if (recorded.job_sha256 != present.job_sha256) return "the job, or an option that overrides it, has changed since";
  if (recorded.seed != present.seed) return fmt::format("its seed is {}, not {}", recorded.seed, present.seed);
  if (recorded.version != present.version)
    return fmt::format("it was written by demecal {}, and this is {}", recorded.version, present.version);
  if (recorded.asynchronous != present.asynchronous)
    return fmt::format("it is of {} run", recorded.asynchronous ? "an asynchronous" : "a synchronous");
  return std::nullopt;
}

std::string identity_record(const JobIdentity& identity) {
  return record_of(kIdentity + fmt::format("{}\n{}\n{}\n{}\n{}\n", identity.data_sha256, identity.job_sha256,
                                           identity.seed, identity.asynchronous ? 1 : 0, identity.version));
}

std::string begin_record(std::uint32_t evolution, const CalibrationData& data) {
  return record(kBegin, evolution, to_bytes(data));
}

std::string forget_record(std::uint32_t evolution) {
  return record(kForget, evolution, "");
}

std::string progress_record(std::uint32_t evolution, const Progress& progress) {
  return record(kProgress, evolution, to_bytes(progress));
}

std::string outcome_record(std::uint32_t evolution, const Outcome& outcome) {
  return record(kOutcome, evolution, to_bytes(outcome));
}

std::string snapshot_record(std::uint32_t evolution, const std::vector<Checkpoint>& checkpoints) {
  std::string content;
  for (const Checkpoint& checkpoint : checkpoints) {
    const std::string bytes = to_bytes(checkpoint);
    content += bytes_of(static_cast<std::uint32_t>(bytes.size())) + bytes;
  }
  return record(kSnapshot, evolution, content);
}

RecordedJob read_journal(std::string_view journal) {
  const JournalRecords records = read_records(journal);
  RecordedJob job;
  job.end = records.end;
  Reading reading(job);
  for (const std::string_view content : records.contents) {
    if (!reading.take(content)) {
      job.end = JournalEnd::corrupt;
      job.sound_bytes = static_cast<std::size_t>(content.data() - journal.data()) - record_of({}).size();
      return job;
    }
  }
  job.sound_bytes = records.sound_bytes;
  return job;
}

std::string journal_of(const JobIdentity& identity, const std::vector<RunState>& evolutions) {
  std::string journal = std::string(kJournalHead) + identity_record(identity);
  std::uint32_t number = 0;
  for (const RunState& state : evolutions) {
    journal += begin_record(number, state.data());
    for (const Progress& progress : state.progress()) journal += progress_record(number, progress);
    for (const Outcome& outcome : state.outcomes()) journal += outcome_record(number, outcome);
    journal += snapshot_record(number, state.checkpoints());
    ++number;
  }
  return journal;
}

bool same_evolution(const CalibrationData& a, const CalibrationData& b) {
  return a.seed == b.seed && a.parameters == b.parameters && a.archipelago == b.archipelago && a.tables == b.tables &&
         a.breeds == b.breeds && a.sets == b.sets && a.work == b.work;
}

}  // namespace demecal::inline scheduling
