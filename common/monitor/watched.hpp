// What one who watches has seen so far: calibrations, their evolutions, the islands and the workers; and how fast an
// evolution is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evolution/archipelago.hpp"
#include "protocol/findings.hpp"
#include "protocol/messages.hpp"
#include "protocol/stages.hpp"

namespace demecal::inline monitor {

/// How many evaluations a run's islands had done when.
struct WorkMark {
  double time_s = 0.0;
  std::uint64_t evaluations = 0;
};

struct WatchedRun {
  std::uint64_t order = 0;  ///< of appearance
  double seen_s = 0.0;      ///< when it was first heard of
  CalibrationData data;     ///< without tables; run is 0 until it has come
  Control::State state = Control::State::running;
  std::map<IslandKey, Progress> islands;  ///< the last figures of those that have given any
  std::uint64_t evaluations = 0;          ///< of these together
  std::deque<WorkMark> marks;             ///< of the last ten seconds or so, a second apart; none of what came at once

  bool has_data() const { return data.run != 0; }
  /// All generations of the island are bred.
  bool has_finished(const Progress& island) const;
};

/// What evolutions have cost so far.
struct Effort {
  std::uint64_t evaluations = 0, sets = 0;  ///< formulas, and sets of effects, that were judged
  std::uint64_t migrants = 0;               ///< taken from other islands
};

struct WatchedWorker {
  enum class Presence { here, left, lost };
  std::uint64_t order = 0;
  WorkerStatus status;
  Presence presence = Presence::here;
  double gone_s = 0.0;  ///< when it left or was lost
};

struct WatchedCalibration {
  std::uint64_t order = 0;
  double seen_s = 0.0;
  bool lost = false;                             ///< its coordinator is dead
  LoopNews stage;                                ///< round 0
  std::map<std::uint32_t, LoopNews> rounds;      ///< by number
  std::vector<RunId> runs;                       ///< its evolutions that were seen, in order
  std::map<std::uint32_t, CauseFound> causes{};  ///< by number
  std::optional<FinalFigures> figures{};

  bool is_live() const { return !lost && !is_over(stage.stage); }
};

/// A sentence for people about something that happened.
struct Notice {
  double time_s = 0.0;
  std::string text;
};

/// The fold of messages into a present state; whatever it is given, it keeps no more than a few runs of believable
/// size. Times are seconds since whenever the caller began to count, and do not fall.
class Watched {
 public:
  void take(const Message& message, double now_s);

  /// What deserves to be shown: the calibration that began last among those that go on, or else among all. Null where
  /// none was seen.
  const WatchedCalibration* calibration() const;
  /// Its present or last evolution; without any calibration the run seen last. Null where none was seen.
  const WatchedRun* run() const;
  /// Of all evolutions of the shown calibration that were seen; without one, of the shown run.
  Effort effort() const;
  /// Calibrations beside the shown one that go on.
  std::size_t other_calibrations() const;
  /// Workers that are here, or that have to do with the shown run: bred an island of it, or were lost since it began.
  /// In the order of their appearance.
  std::vector<const WatchedWorker*> workers() const;
  /// Null where it was never heard of.
  const WatchedWorker* worker(const std::string& name) const;
  /// The last few, oldest first.
  const std::deque<Notice>& notices() const { return notices_; }
  bool has_seen_anything() const { return !calibrations_.empty() || !runs_.empty() || !workers_.empty(); }

 private:
  void note(const CalibrationData& data, double now_s);
  void note(const Progress& progress, double now_s);
  void note(const Control& control, double now_s);
  void note(const WorkerStatus& status, double now_s);
  void note(const WorkerLost& lost, double now_s);
  void note(const LoopNews& news, double now_s);
  void note(const CauseFound& cause, double now_s);
  void note(const FinalFigures& figures, double now_s);
  void note(const CalibrationLost& lost, double now_s);
  void note_effort(const WatchedRun& run, RunId id);
  WatchedRun& run_of(RunId run, double now_s);
  WatchedCalibration& calibration_of(std::uint64_t calibration, double now_s);
  void add_notice(double now_s, std::string text);

  std::uint64_t order_ = 0;
  std::map<RunId, WatchedRun> runs_;
  std::map<RunId, Effort> efforts_;  ///< of more runs than those
  std::map<std::uint64_t, WatchedCalibration> calibrations_;
  std::map<std::string, WatchedWorker> workers_;
  std::deque<Notice> notices_;
};

/// Evaluations of all workers together: as many as were seen to be done in the last ten seconds or, before one can
/// tell, of each worker its islands' mean speed, times as many as it computes at once. 0 where nothing is left to breed
/// or nothing is known.
double evaluations_per_s(const Watched& watched, const WatchedRun& run, double now_s);

/// The part of one worker in that, by what it reports of its islands.
double evaluations_per_s(const Watched& watched, const WatchedRun& run, const WatchedWorker& worker, double now_s);

/// Generations bred of those to be bred, over all islands; 0 to 1.
double share_done(const WatchedRun& run);

/// Seconds until all islands have bred their generations, at the present speed; nothing where that is not known.
std::optional<double> time_left_s(const Watched& watched, const WatchedRun& run, double now_s);

}  // namespace demecal::inline monitor
