// The journal of a calibration: which job it is of and how far each of its evolutions is, so that another process can
// go on after this one died.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "evolution/archipelago.hpp"
#include "protocol/messages.hpp"
#include "scheduling/evolution_run.hpp"
#include "scheduling/journal_file.hpp"
#include "scheduling/run_state.hpp"

namespace demecal::inline scheduling {

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

/// Watches the evolutions of a calibration, one after the other, and writes what they reach: every outcome at once, and
/// of all islands that made progress a snapshot, as often as takes little of the time. A snapshot is one record, so
/// that what is read back is what was true at one moment. When much of the file is out of date it is written anew.
class RunJournal : public RunObserver {
 public:
  enum class Start { anew, resume };

  /// The journal in `folder`. `anew` forgets what it holds; `resume` takes that up, and throws InputError where it is
  /// of another job. Other errors are those of JournalFile, here and in all that writes.
  /// It is written anew when it has grown to `shorten_from_bytes`, and to several times what it was after the last
  /// time.
  RunJournal(const std::string& folder, const JobIdentity& identity, Start start,
             std::size_t shorten_from_bytes = 64 << 20);

  /// What was found, for people: one sentence.
  const std::string& found() const { return found_; }

  /// How far an evolution of these data was, under the number it last ran under; nothing where none is recorded.
  std::optional<RunState> recorded(const CalibrationData& data) const;
  /// The last runs that were recorded when this began, which may still be worked at; given once.
  std::vector<RunId> take_left() { return std::exchange(left_, {}); }
  /// What is observed from now on is of this evolution, until the next begins.
  void begin(const CalibrationData& data);
  /// What was recorded of the present evolution leads nowhere; it will begin again.
  void forget();
  /// Writes what has not been written yet.
  void finish();
  /// The results are there: the file goes.
  void remove() { file_.remove(); }

  void on_progress(const Progress& progress) override;
  void on_checkpoint(const Checkpoint& checkpoint) override;
  void on_outcome(const Outcome& outcome) override;
  void on_tick() override;

 private:
  using Clock = std::chrono::steady_clock;

  void begin_anew();
  void take_up();
  void write_snapshot();
  void sync_where_due();
  void shorten();

  JournalFile file_;
  JobIdentity identity_;
  std::string found_;
  std::vector<RunState> evolutions_;  ///< as recorded when this began; of those begun since, their beginnings
  std::vector<RunId> left_;
  std::uint32_t present_ = 0;
  std::string unwritten_;                    ///< records
  std::map<IslandKey, Checkpoint> reached_;  ///< since the last snapshot
  std::size_t shorten_from_bytes_;
  std::size_t shortened_bytes_ = 0;  ///< size of the file when it was last written anew
  Clock::time_point next_snapshot_{}, next_sync_{};
};

}  // namespace demecal::inline scheduling
