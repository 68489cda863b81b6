// What the records of a calibration's journal say: which job it is of, and how far each of its evolutions is.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "coordinator/run_state.hpp"
#include "journal/records.hpp"

namespace demecal {

/// What a result is a function of: a journal serves nothing else.
struct JobIdentity {
  std::string data_sha256;  ///< of poses, data set and robot
  std::string job_sha256;   ///< of the job as it is run, its data and seed apart
  std::uint64_t seed = 0;
  std::string version;        ///< of the program
  bool asynchronous = false;  ///< whether islands wait for their neighbours

  bool operator==(const JobIdentity&) const = default;
};

/// How `present` differs from `recorded`, a sentence; nothing where it does not.
std::optional<std::string> difference(const JobIdentity& recorded, const JobIdentity& present);

// Records, ready to be appended. Evolutions are numbered from 0 in the order in which they first began.
std::string identity_record(const JobIdentity& identity);
/// An evolution begins, or goes on under another run's number.
std::string begin_record(std::uint32_t evolution, const CalibrationData& data);
/// What was recorded of an evolution counts no longer: it begins again at its start.
std::string forget_record(std::uint32_t evolution);
std::string progress_record(std::uint32_t evolution, const Progress& progress);
std::string outcome_record(std::uint32_t evolution, const Outcome& outcome);
/// One record for many islands: either all of it is read back or nothing. Islands that were known at different moments
/// might not find each other's migrants.
std::string snapshot_record(std::uint32_t evolution, const std::vector<Checkpoint>& checkpoints);

struct RecordedJob {
  std::optional<JobIdentity> identity;  ///< nothing where not even that was written whole
  std::vector<RunState> evolutions;
  std::vector<RunId> runs;      ///< under which they began or went on; the first of them may have ended
  std::size_t sound_bytes = 0;  ///< of the journal, up to the first record that is torn, corrupt or makes no sense
  JournalEnd end = JournalEnd::clean;
};
RecordedJob read_journal(std::string_view journal);

/// The shortest journal from which the same is read.
std::string journal_of(const JobIdentity& identity, const std::vector<RunState>& evolutions);

/// Whether two evolutions have the same result: equal but for the run and the job's name.
bool same_evolution(const CalibrationData& a, const CalibrationData& b);

}  // namespace demecal
