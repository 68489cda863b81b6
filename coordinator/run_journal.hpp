// The journal of a calibration: how far each of its evolutions is, so that another process can go on after this one
// died.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coordinator/evolution_run.hpp"
#include "coordinator/journal_file.hpp"
#include "coordinator/journal_records.hpp"

namespace demecal {

/// Watches the evolutions of a calibration, one after the other, and writes what they reach: every outcome at once, and
/// of all islands that got on a snapshot, as often as takes little of the time. A snapshot is one record, so that what
/// is read back is what was true at one moment. When much of the file is out of date it is written anew.
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
  /// The last runs that were recorded when this began, which may still be worked at; told once.
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

}  // namespace demecal
