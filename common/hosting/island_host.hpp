// The islands that a worker hosts, and who breeds what: the slots, what each is given at a go, and which islands are
// free.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "evolution/archipelago.hpp"
#include "hosting/hosted_island.hpp"
#include "hosting/migrants.hpp"
#include "protocol/messages.hpp"

namespace demecal::inline hosting {

/// Thrown out of work by its own heartbeat() when the slots are going away: what it computed so far is dropped.
struct SlotsClosing {};

/// Runs pieces of work named by `Label` on a fixed number of threads. All calls come from one thread.
template <typename Label>
class Slots {
 public:
  /// `on_finished` is called from a slot's thread after each piece of work.
  Slots(std::uint32_t count, std::function<void()> on_finished) : on_finished_(std::move(on_finished)) {
    for (std::uint32_t i = 0; i < count; ++i) threads_.emplace_back([this](std::stop_token stop) { run(stop); });
  }
  ~Slots() {
    closing_ = true;
    for (std::jthread& thread : threads_) thread.request_stop();
    wake_.notify_all();
  }
  Slots(const Slots&) = delete;
  Slots& operator=(const Slots&) = delete;

  /// Whether there is a thread for more work, or none waits yet: who ends a piece then begins the next at once.
  bool has_room() const { return running_ <= threads_.size(); }
  bool is_idle() const { return running_ == 0; }

  void start(Label label, std::function<void()> work) {
    ++running_;
    {
      const std::lock_guard lock(mutex_);
      queue_.emplace_back(std::move(label), std::move(work));
    }
    wake_.notify_one();
  }

  /// The label of a finished piece, or nothing where none is finished.
  std::optional<Label> finished() {
    const std::lock_guard lock(mutex_);
    if (done_.empty()) return std::nullopt;
    Label label = std::move(done_.front());
    done_.pop_front();
    --running_;
    return label;
  }

  /// Work calls this as it makes progress; a count that stands still while slots are busy means that they hang.
  void heartbeat() {
    if (closing_.load(std::memory_order_relaxed)) throw SlotsClosing{};
    heartbeats_.fetch_add(1, std::memory_order_relaxed);
  }
  std::uint64_t heartbeats() const { return heartbeats_.load(std::memory_order_relaxed); }

 private:
  void run(std::stop_token stop) {
    while (true) {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, stop, [this] { return !queue_.empty(); });
      if (stop.stop_requested()) return;
      auto [label, work] = std::move(queue_.front());
      queue_.pop_front();
      lock.unlock();
      try {
        work();
      } catch (const SlotsClosing&) {
        return;
      }
      lock.lock();
      done_.push_back(std::move(label));
      lock.unlock();
      on_finished_();
    }
  }

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::function<void()> on_finished_;
  std::deque<std::pair<Label, std::function<void()>>> queue_;
  std::deque<Label> done_;
  std::size_t running_ = 0;  ///< started and not yet collected
  std::atomic<std::uint64_t> heartbeats_{0};
  std::atomic<bool> closing_{false};
  std::vector<std::jthread> threads_;  // last: stopped before what they use goes
};

/// Handing an island to a slot and back costs as much as a good part of a short epoch, so a slot keeps islands that
/// need nobody else for a while: each finds its neighbours' migrants within the batch.
class EpochBatch {
 public:
  /// What an island of the batch did in it.
  struct Member {
    std::shared_ptr<HostedIsland> island;
    bool is_awaited;                ///< by an island of another worker: the batch ends after an epoch of it
    std::uint32_t first_epoch = 0;  ///< its epoch before the batch
  };

  /// `arrived` has what the members lack of others. No other thread may touch the members until the batch is over.
  EpochBatch(std::vector<Member> members, MigrantStore arrived);

  /// Breeds whichever island is farthest behind of those that can go on, until `budget` is over, none can, an awaited
  /// island has bred or one has bred kMostEpochs; at least one epoch where any can. `heartbeat` as for
  /// HostedIsland::run_epoch.
  void breed(std::chrono::steady_clock::duration budget, const std::function<void()>& heartbeat);

  /// Ends after the present epoch; from any thread.
  void end_soon() { ends_ = true; }

  std::span<const Member> members() const { return members_; }
  /// When its last epoch ended.
  WaitedShare::Time ended() const { return ended_; }

 private:
  /// Of each island, before others receive of it: well below what neighbours keep migrants of.
  static constexpr std::uint32_t kMostEpochs = kMigrantEpochs / 4;

  const Member* next() const;

  std::vector<Member> members_;
  MigrantStore arrived_;
  WaitedShare::Time ended_{};
  std::atomic<bool> ends_{false};
};

/// Those of `islands`, all of one run, that `island` is linked with by who takes migrants from whom, over any
/// number of steps among them; itself first.
std::vector<std::shared_ptr<HostedIsland>> linked_with(
    const std::shared_ptr<HostedIsland>& island, const std::map<IslandKey, std::shared_ptr<HostedIsland>>& islands);

struct IslandHostOptions {
  std::uint32_t slots = 1;                   ///< islands computed at once
  std::chrono::milliseconds batch{100};      ///< about so long, islands that need nobody else breed without a message
  std::function<void()> after_generation{};  ///< or set, by the slot that bred it: for simulated work
};

/// Publishes nothing and reads no messages: that is its worker's part, from whose thread all calls come.
class IslandHost {
 public:
  using Islands = std::map<IslandOfRun, std::shared_ptr<HostedIsland>>;
  /// Whether an island of another worker waits for this one's migrants.
  using IsAwaited = std::function<bool(const HostedIsland&)>;

  /// `on_finished` is called from a slot's thread when a batch is finished.
  IslandHost(const IslandHostOptions& options, std::function<void()> on_finished);

  void begin_run(const CalibrationData& data);
  /// Drops all that is kept of the run; slots that are at it finish their batches.
  void forget_run(RunId run);
  /// Nothing where the run has not begun here, or was forgotten.
  const CalibrationData* data(RunId run) const;
  /// Migrants have arrived, for whichever island here takes them in.
  void put(const Migrants& migrants) { arrived_[migrants.run].put(migrants); }

  /// Hosts an island of a run that has begun, from where the task says.
  std::shared_ptr<HostedIsland> host(const IslandTask& task);
  /// Hosts the island no longer. Returns it where no slot is at it; otherwise its batch ends soon, and collect()
  /// returns that.
  std::shared_ptr<HostedIsland> release(const IslandOfRun& place);
  const Islands& islands() const { return islands_; }
  /// Nothing where it is not hosted here.
  std::shared_ptr<HostedIsland> find(const IslandOfRun& place) const;
  bool is_busy(const std::shared_ptr<HostedIsland>& island) const { return busy_.contains(island); }
  /// Whether an island of the run is left to breed, or bred.
  bool has_unfinished(RunId run) const;

  /// Gives work to every slot that has none, as far as islands have the migrants that they need.
  void start_ready(const IsAwaited& is_awaited);
  /// A batch that a slot has finished: its islands are free again. Nothing where none is.
  std::shared_ptr<EpochBatch> collect();

  bool is_idle() const { return slots_.is_idle(); }
  /// Whether a slot has no work, though islands are left to breed.
  bool waits_for_migrants() const { return waits_for_migrants_; }
  /// A count that stands still while slots are busy means that they hang.
  std::uint64_t heartbeats() const { return slots_.heartbeats(); }
  /// Of the slots' time while there were islands to breed, the share without work.
  double waited_share(WaitedShare::Time now) const { return slots_waited_.at(now); }

 private:
  WaitedShare::Time note_waiting();
  std::shared_ptr<HostedIsland> slowest_ready() const;
  std::map<IslandKey, std::shared_ptr<HostedIsland>> free_islands(RunId run) const;
  bool start_one(const IsAwaited& is_awaited);

  IslandHostOptions options_;
  std::map<RunId, std::shared_ptr<const RunData>> runs_;
  std::map<RunId, MigrantStore> arrived_;
  Islands islands_;
  std::map<std::shared_ptr<HostedIsland>, std::shared_ptr<EpochBatch>> busy_;
  WaitedShare slots_waited_;
  bool waits_for_migrants_ = false;
  Slots<std::shared_ptr<EpochBatch>> slots_;  // last: its threads stop before what they use goes
};

}  // namespace demecal::inline hosting
