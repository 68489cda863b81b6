// One island as this worker hosts it: its work, whose attempt it is, what its neighbours may still need, and how long
// it waited for them.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "effect_sets/fitted_set.hpp"
#include "effect_sets/set_island.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/island.hpp"
#include "evolution/population.hpp"
#include "fitness/fitness.hpp"
#include "hosting/migrants.hpp"
#include "hosting/piece_island.hpp"
#include "protocol/messages.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline hosting {

/// Counts how much of something could work and how much of it waited: an island that is there or not, the slots of a
/// worker. Times are arguments and never go back.
class WaitedShare {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// From `now` on, `waiting` of `all` wait (0 <= waiting <= all); where `all` is 0 the time does not count.
  void set(Time now, double waiting, double all) {
    count_until(now);
    waiting_ = waiting;
    all_ = all;
  }

  /// Something waited for some time that was counted, though not as waiting.
  void add_waited(Time::duration time) { waited_s_ += std::chrono::duration<double>(time).count(); }

  /// 0 to 1, of the time so far; 0 before any has counted.
  double at(Time now) const {
    WaitedShare until = *this;
    until.count_until(now);
    return until.counted_s_ > 0.0 ? std::min(until.waited_s_ / until.counted_s_, 1.0) : 0.0;
  }

 private:
  void count_until(Time now) {
    const double elapsed_s = std::chrono::duration<double>(now - last_).count();
    waited_s_ += waiting_ * elapsed_s;
    counted_s_ += all_ * elapsed_s;
    last_ = now;
  }

  Time last_{};
  double waiting_ = 0.0, all_ = 0.0;
  double waited_s_ = 0.0, counted_s_ = 0.0;
};

inline constexpr std::chrono::milliseconds kAtOnce{0};  ///< an interval of what is always due

/// The data of a run, shared by all its islands here.
struct RunData {
  explicit RunData(CalibrationData received);

  CalibrationData data;
  ExplanationProblem problem;        ///< where sets of effects are bred
  std::unique_ptr<SharedWork> work;  ///< where pieces of it are done
  const TrainingTable& table(std::uint32_t joint) const;
};

/// An island of formulas, one of sets of effects, or a piece of work.
using AnyIsland = std::variant<Island, SetIsland, PieceIsland>;

class HostedIsland {
 public:
  /// Starts or goes on as the task says. `run` outlives the island's work by shared ownership.
  HostedIsland(std::shared_ptr<const RunData> run, const IslandTask& task);

  RunId run() const { return run_->data.run; }
  IslandKey island() const { return key_; }
  std::uint32_t attempt() const { return attempt_; }
  std::uint32_t epoch() const { return state().epoch; }
  bool finished() const {
    return std::visit([](const auto& island) { return island.finished(); }, island_);
  }
  const std::vector<IslandKey>& sources() const { return sources_; }
  const std::vector<IslandKey>& consumers() const { return consumers_; }
  /// Whether its next epoch can begin; not where it waits for its neighbours.
  bool is_ready(const MigrantStore& arrived) const;
  /// What its next epoch takes in.
  Population immigrants(const MigrantStore& arrived);

  /// Breeds one epoch; called from one thread at a time. `heartbeat` is called after every generation or set.
  void run_epoch(const Population& immigrants, const std::function<void()>& heartbeat);
  WaitedShare::Time epoch_ended() const { return epoch_ended_; }

  /// Whether the island waits for its neighbours from `now` on.
  void set_waiting(WaitedShare::Time now, bool waiting) { waited_.set(now, waiting ? 1.0 : 0.0, 1.0); }

  /// What its neighbours may lack of it, but for who says it: the last emigration, or all that are kept where one of
  /// them has got a worker that has received none.
  std::vector<Migrants> unsent();
  void send_all_recent() { all_recent_unsent_ = true; }
  bool is_sending_all_recent() const { return all_recent_unsent_; }
  const Migrants& last_migrants() const { return recent_.back(); }
  const std::deque<Migrants>& recent() const { return recent_; }
  /// How it stands, where that is due: after its first epoch here and its last, and an interval after the last time.
  /// Not where nothing is new.
  std::optional<Progress> due_progress(const std::string& worker, std::chrono::milliseconds interval);
  /// Where an interval has passed since the last, or half as many epochs as neighbours keep migrants of: checkpoints
  /// are the largest messages by far, and a worker that takes over breeds what is missing again.
  std::optional<Checkpoint> due_checkpoint(const std::string& worker, std::chrono::milliseconds interval);
  Checkpoint checkpoint(const std::string& worker) const;
  /// Whether it has bred since its task.
  bool has_progressed() const { return epoch() > first_epoch_; }
  Outcome outcome(const std::string& worker) const;

 private:
  const IslandState& state() const {
    return std::visit([](const auto& island) -> const IslandState& { return island.state(); }, island_);
  }
  std::string best_formula() const;

  std::shared_ptr<const RunData> run_;
  IslandKey key_;
  AnyIsland island_;
  std::uint32_t attempt_;
  std::vector<IslandKey> sources_, consumers_;
  std::uint32_t first_epoch_;
  std::deque<Migrants> recent_;
  bool all_recent_unsent_ = false;
  std::map<IslandKey, std::uint32_t> taken_;  ///< the last epoch of each source that came in, where nobody waits
  double evaluations_per_s_ = 0.0;
  std::vector<EpochFigures> unreported_;
  std::uint64_t migrants_sent_ = 0;  ///< those of `recent` that the task brought among them
  WaitedShare waited_;
  WaitedShare::Time epoch_ended_{};
  WaitedShare::Time progress_reported_{};
  std::uint32_t checkpoint_epoch_;
  WaitedShare::Time checkpoint_sent_;
};

}  // namespace demecal::inline hosting
