// Events at a pace that a page can follow for hours: of each island no more than some a second, of a worker what is
// new.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "evolution/archipelago.hpp"
#include "monitor/watched.hpp"
#include "protocol/messages.hpp"

namespace demecal::inline monitor {

/// Whether a worker's status says what the one before did not; less of a change in what it waited than 5 % is nothing
/// new.
bool is_news(const WorkerStatus& status, const WorkerStatus& before);

/// A line as event_line() gives it, and what it is the latest state of: an island, a worker, the figures of a run.
/// Empty of what happens once.
struct PacedLine {
  std::string text;
  std::string key;
};

/// Times are seconds since the caller began to count, and do not fall.
class PacedEvents {
 public:
  /// Figures of an island, and those of a run, come at most once in `interval_s`.
  explicit PacedEvents(double interval_s) : interval_s_(interval_s) {}

  /// What is to be told now that `message` came. Nothing is lost: what an island reports between is told by due(), or
  /// before the next stage or end of a run, unless a later report replaced it.
  std::vector<PacedLine> take(const Message& message, double now_s);

  /// What has become due since; to be called some times a second.
  std::vector<PacedLine> due(double now_s);

  const Watched& watched() const { return watched_; }

 private:
  using Island = std::pair<RunId, IslandKey>;
  struct Paced {
    Progress latest;
    double told_s = 0.0;
    bool is_new = false;  ///< not told yet
  };

  void take_progress(const Progress& progress, double now_s, std::vector<PacedLine>& lines);
  bool is_repeated(const WorkerStatus& status);
  void emit(Paced& paced, double now_s, std::vector<PacedLine>& lines) const;
  void emit_figures(double now_s, std::vector<PacedLine>& lines);

  double interval_s_;
  Watched watched_;
  std::map<Island, Paced> islands_;
  std::map<std::string, WorkerStatus> workers_;
  double figures_told_s_ = 0.0;
  std::string figures_;  ///< as told last, without their time
};

}  // namespace demecal::inline monitor
