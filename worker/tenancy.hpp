// One island as this worker holds it: its work, whose attempt it is, and what its neighbours may still need.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "protocol/messages.hpp"

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

  /// Breeds one epoch; called from one thread at a time. `beat` is called after every generation.
  void run_epoch(const Population& immigrants, const std::function<void()>& beat);

  /// What there is to say after an epoch (after the start: recent migrants that a slower neighbour may lack).
  std::vector<Migrants> recent() const { return {recent_.begin(), recent_.end()}; }
  Migrants migrants() const;
  Progress progress(const std::string& worker) const;
  Checkpoint checkpoint() const;
  Outcome outcome(const std::string& worker) const;

 private:
  std::shared_ptr<const RunData> run_;
  Island island_;
  std::uint32_t attempt_;
  std::vector<IslandKey> sources_;
  std::deque<Migrants> recent_;
  double evaluations_per_s_ = 0.0;
};

}  // namespace demecal
