// What people may want to know of a calibration or diagnosis while it goes on: published to watchers, and recorded in
// events.jsonl for `demecal monitor --replay`.
#pragma once

#include <chrono>
#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "diagnosis/outcome.hpp"
#include "evolution/archipelago.hpp"
#include "monitor/events.hpp"
#include "protocol/messages.hpp"
#include "report/report.hpp"
#include "scheduling/run_state.hpp"
#include "transport/transport.hpp"
#include "workflows/workflows.hpp"

namespace demecal {

inline constexpr const char* kEventFile = "events.jsonl";

/// Appends events as they happen, each at once. It is for people alone: where it cannot be written nothing is, and the
/// run goes on.
class EventFile {
 public:
  /// `resume` goes on after the whole events that the file holds, in their time; otherwise it begins anew.
  EventFile(const std::string& path, bool resume);

  void note(const Message& message);

 private:
  std::ofstream file_;
  std::chrono::steady_clock::time_point begin_;
};

/// The events of a recorded run, in the order of the file; a last line that was not written to its end is left out.
/// Throws InputError naming file and line where the file cannot be read or holds something else.
std::vector<Event> read_events(const std::string& path);

/// Nothing depends on it. Workers publish themselves how their islands fare; of them it records, and says once more at
/// the end of a run, since workers go and what they published goes with them.
class EventLog final : public CalibrationObserver {
 public:
  /// `reporter` has the role of that name. Events go to the file in `folder`, after those that are there where
  /// `resume`.
  EventLog(const std::string& folder, bool resume, std::string job, std::unique_ptr<Transport> reporter);
  /// Says that the calibration failed, unless finish() has said how it ended.
  ~EventLog() override;
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  void on_run_begins(const CalibrationData& data, const std::vector<Progress>& reached, bool shown) override;
  void on_run_ends(RunEnd end) override;
  void on_workers_end() override;
  void on_progress(const Progress& progress) override;
  void on_worker(const WorkerStatus& status) override;
  void on_lost(const std::string& worker) override { file_.note(WorkerLost{worker}); }
  void on_round(const Round& round, const Robot& described) override;
  /// What was found, before the last stage; rounds again whose effects the last fit changed.
  void tell_of(const Report& report);
  /// The same, and that the calibration is over: finished, with the figures it is judged by, or interrupted.
  void finish(const Report& report, bool interrupted);
  /// The last stage, with what is to be said of it.
  void finish(LoopNews::Stage stage, const std::string& text);

 private:
  void tell_of_rounds(const Report& report);
  void publish_stage(LoopNews::Stage stage, const std::string& text);
  void publish(const Message& message);

  EventFile file_;
  std::unique_ptr<Transport> reporter_;
  LoopNews stage_;
  std::map<IslandKey, Progress> reached_;  ///< in the present run
  std::uint32_t evolutions_ = 0;
  bool of_sets_ = false;                         ///< whether the present run breeds sets of effects
  std::map<std::uint32_t, LoopNews> rounds_;     ///< as told, by number
  std::map<std::string, WorkerStatus> workers_;  ///< as recorded
};

}  // namespace demecal
