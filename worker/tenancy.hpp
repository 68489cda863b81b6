// One island as this worker holds it: its work, whose attempt it is, and what its neighbours may still need.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "protocol/messages.hpp"
#include "worker/inbox.hpp"
#include "worker/waited_share.hpp"

namespace demecal {

/// The data of a run, shared by all its islands here.
struct RunData {
  CalibrationData data;
  const TrainingTable& table(std::uint32_t joint) const;
};

class Tenancy {
 public:
  /// Starts or goes on as the task says. `run` outlives the tenancy's work by shared ownership.
  Tenancy(std::shared_ptr<const RunData> run, const IslandTask& task);

  RunId run() const { return run_->data.run; }
  IslandKey island() const { return island_.key(); }
  std::uint32_t attempt() const { return attempt_; }
  std::uint32_t epoch() const { return island_.state().epoch; }
  bool finished() const { return island_.finished(); }
  const std::vector<IslandKey>& sources() const { return sources_; }
  /// Whether its next epoch can begin; not where it waits for its neighbours.
  bool is_ready(const Inbox& inbox) const;
  /// What its next epoch takes in.
  Population immigrants(const Inbox& inbox);

  /// Breeds one epoch; called from one thread at a time. `beat` is called after every generation.
  void run_epoch(const Population& immigrants, const std::function<void()>& beat);
  WaitedShare::Time epoch_ended() const { return epoch_ended_; }

  /// Whether the island waits for its neighbours from `now` on.
  void set_waiting(WaitedShare::Time now, bool waiting) { waited_.set(now, waiting ? 1.0 : 0.0, 1.0); }

  /// What there is to say after an epoch, but for who says it (after the start: recent migrants that a slower neighbour
  /// may lack).
  std::vector<Migrants> recent() const { return {recent_.begin(), recent_.end()}; }
  Migrants migrants() const;
  Progress progress(const std::string& worker) const;
  /// A checkpoint after the first epoch here, then whenever eight epochs or a quarter of a second have passed since
  /// the last: they are the largest messages by far, and a worker that takes over breeds what is missing again.
  std::optional<Checkpoint> due_checkpoint();
  Outcome outcome(const std::string& worker) const;

 private:
  std::shared_ptr<const RunData> run_;
  Island island_;
  std::uint32_t attempt_;
  std::vector<IslandKey> sources_;
  std::deque<Migrants> recent_;
  std::map<IslandKey, std::uint32_t> taken_;  ///< the last epoch of each source that came in, where nobody waits
  double evaluations_per_s_ = 0.0;
  std::uint64_t migrants_sent_ = 0;  ///< those of `recent` that the task brought among them
  WaitedShare waited_;
  WaitedShare::Time epoch_ended_{};
  std::optional<std::uint32_t> checkpoint_epoch_;
  WaitedShare::Time checkpoint_sent_{};
};

}  // namespace demecal
