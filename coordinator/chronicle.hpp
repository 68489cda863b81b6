// What people may want to know of a calibration while it goes on: told to watchers, and recorded.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "coordinator/event_file.hpp"
#include "diagnosis/outcome.hpp"
#include "transport/transport.hpp"

namespace demecal {

/// Nothing depends on it. Workers tell watchers themselves how their islands fare; of them it only records.
class Chronicle {
 public:
  /// `herald` has the role of that name. Events go to the file in `folder`, after those that are there where `resume`.
  Chronicle(const std::string& folder, bool resume, std::string job, std::unique_ptr<Transport> herald);
  /// Says that the calibration failed, unless its end was told.
  ~Chronicle();
  Chronicle(const Chronicle&) = delete;
  Chronicle& operator=(const Chronicle&) = delete;

  /// `reached`: figures of islands of a run that goes on from where it was broken off; no worker will give them again.
  void run_begins(const CalibrationData& data, const std::vector<Progress>& reached);
  void run_ends(Control::State state);
  /// The workers that serve this coordinator alone are let go.
  void fleet_ends();
  void heard(const Progress& progress) { file_.note(progress); }
  void heard(const WorkerStatus& status);
  void heard(const WorkerLost& lost) { file_.note(lost); }
  void round_ends(const Round& round, const Robot& described);
  /// The last stage, with what is to be said of it.
  void ends(LoopNews::Stage stage, const std::string& text);

 private:
  void tell_stage(LoopNews::Stage stage, const std::string& text);
  void tell(const LoopNews& news);

  EventFile file_;
  std::unique_ptr<Transport> herald_;
  LoopNews stage_;
  std::uint32_t evolutions_ = 0;
  std::map<std::string, WorkerStatus> workers_;  ///< as recorded
};

}  // namespace demecal
