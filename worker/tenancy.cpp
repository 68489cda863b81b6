#include "worker/tenancy.hpp"

#include <algorithm>
#include <chrono>

#include "errors/check.hpp"

namespace demecal {

const TrainingTable& RunData::table(std::uint32_t joint) const {
  const auto& joints = data.archipelago.joints;
  const auto found = std::find(joints.begin(), joints.end(), joint);
  DEMECAL_CHECK(found != joints.end(), "joint " << joint << " is not in the run");
  return data.tables[static_cast<std::size_t>(found - joints.begin())];
}

Tenancy::Tenancy(std::shared_ptr<const RunData> run, const IslandTask& task)
    : run_(std::move(run)),
      island_(run_->data.parameters, run_->data.archipelago, run_->table(task.island.joint), task.island,
              run_->data.seed),
      attempt_(task.attempt),
      sources_(demecal::sources(run_->data.archipelago, task.island)),
      recent_(task.recent.begin(), task.recent.end()) {
  if (task.start.epoch > 0) island_.restore(task.start);
  for (const Migrants& sent : recent_) migrants_sent_ += sent.individuals.size();
}

bool Tenancy::is_ready(const Inbox& inbox) const {
  return epoch() == 0 || run_->data.archipelago.asynchronous || inbox.holds(sources_, epoch());
}

Population Tenancy::immigrants(const Inbox& inbox) {
  if (epoch() == 0) return {};
  if (run_->data.archipelago.asynchronous) return inbox.collect_new(sources_, taken_);
  return inbox.collect(sources_, epoch()).value_or(Population{});
}

void Tenancy::run_epoch(const Population& immigrants, const std::function<void()>& beat) {
  const std::uint64_t evaluations = island_.state().evaluations;
  const auto begin = std::chrono::steady_clock::now();
  island_.run_epoch(immigrants, beat);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  evaluations_per_s_ = static_cast<double>(island_.state().evaluations - evaluations) / std::max(elapsed.count(), 1e-9);
  recent_.push_back(migrants());
  migrants_sent_ += recent_.back().individuals.size();
  while (recent_.size() > kMigrantEpochs) recent_.pop_front();
  epoch_ended_ = std::chrono::steady_clock::now();
}

Migrants Tenancy::migrants() const {
  return {run_->data.run, island(), epoch(), island_.emigrants(), {}};
}

Progress Tenancy::progress(const std::string& worker) const {
  const IslandState& state = island_.state();
  return {.run = run_->data.run,
          .island = island(),
          .worker = worker,
          .epoch = state.epoch,
          .generation = state.generation,
          .figures = island_.figures(),
          .evaluations = state.evaluations,
          .evaluations_per_s = evaluations_per_s_,
          .migrants_taken = state.migrants_taken,
          .migrants_sent = migrants_sent_,
          .waited_share = waited_.at(std::chrono::steady_clock::now())};
}

std::optional<Checkpoint> Tenancy::due_checkpoint() {
  // Far fewer epochs than those whose migrants are kept: whoever takes the island over must find its neighbours'.
  constexpr std::uint32_t kCheckpointEpochs = kMigrantEpochs / 4;
  constexpr std::chrono::milliseconds kCheckpointInterval{250};
  const auto now = std::chrono::steady_clock::now();
  const bool due = !checkpoint_epoch_ || finished() || epoch() - *checkpoint_epoch_ >= kCheckpointEpochs ||
                   now - checkpoint_sent_ >= kCheckpointInterval;
  if (!due) return std::nullopt;
  checkpoint_epoch_ = epoch();
  checkpoint_sent_ = now;
  return Checkpoint{run_->data.run, attempt_, island(), island_.state(), recent(), {}};
}

Outcome Tenancy::outcome(const std::string& worker) const {
  const IslandState& state = island_.state();
  return {.run = run_->data.run,
          .attempt = attempt_,
          .island = island(),
          .worker = worker,
          .generations = state.generation,
          .evaluations = state.evaluations,
          .migrants_taken = state.migrants_taken,
          .front = state.front};
}

}  // namespace demecal
