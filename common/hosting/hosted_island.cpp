#include "hosting/hosted_island.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "effect_sets/set_training.hpp"
#include "errors/check.hpp"
#include "expression/text.hpp"

namespace demecal::inline hosting {

namespace {

AnyIsland make_island(const RunData& run, IslandKey key) {
  const CalibrationData& data = run.data;
  if (data.breeds == Breeds::sets) return SetIsland(run.problem, search_of(data.sets), key);
  if (data.breeds == Breeds::work) return PieceIsland(*run.work, key);
  return Island(data.parameters, data.archipelago, run.table(key.joint), key, data.seed);
}

/// What is best on an island, for people.
std::string best_text(const Island& island, const RunData& run) {
  const Individual* const best = island.best();
  if (best == nullptr) return {};
  VariableNames names = theta_only();
  const std::size_t variables = run.table(island.key().joint).variables.size();
  while (names.size() < variables) names.push_back("x" + std::to_string(names.size() + 1));
  return to_string(best->tree, names);
}

std::string best_text(const SetIsland& island, const RunData& run) {
  std::string text;
  for (const std::size_t cause : island.causes_of_best())
    text += (text.empty() ? "" : "; ") + run.problem.cause_names[cause];
  return text;
}

std::string best_text(const PieceIsland&, const RunData&) {
  return {};
}

}  // namespace

/// The matrices are held once: as those of the problem or of the work.
RunData::RunData(CalibrationData received) : data(std::move(received)) {
  if (data.breeds == Breeds::work) {
    work = received_work(data.work);
    data.work.lists = {};
    data.work.tables = {};
  }
  if (data.breeds != Breeds::sets) return;
  problem = problem_of(data.sets);
  data.sets.gram = {};
  data.sets.moment = {};
}

const TrainingTable& RunData::table(std::uint32_t joint) const {
  const auto& joints = data.archipelago.joints;
  const auto found = std::find(joints.begin(), joints.end(), joint);
  DEMECAL_CHECK(found != joints.end(), "joint " << joint << " is not in the run");
  return data.tables[static_cast<std::size_t>(found - joints.begin())];
}

HostedIsland::HostedIsland(std::shared_ptr<const RunData> run, const IslandTask& task)
    : run_(std::move(run)),
      key_(task.island),
      island_(make_island(*run_, task.island)),
      attempt_(task.attempt),
      sources_(demecal::sources(run_->data.archipelago, task.island)),
      consumers_(demecal::consumers(run_->data.archipelago, task.island)),
      first_epoch_(task.start.epoch),
      recent_(task.recent.begin(), task.recent.end()),
      checkpoint_epoch_(task.start.epoch),
      checkpoint_sent_(std::chrono::steady_clock::now()) {
  if (task.start.epoch > 0) std::visit([&](auto& island) { island.restore(task.start); }, island_);
  for (const Migrants& sent : recent_) migrants_sent_ += sent.individuals.size();
}

bool HostedIsland::is_ready(const MigrantStore& arrived) const {
  return epoch() == 0 || run_->data.archipelago.asynchronous || arrived.holds(sources_, epoch());
}

Population HostedIsland::immigrants(const MigrantStore& arrived) {
  if (epoch() == 0) return {};
  if (run_->data.archipelago.asynchronous) return arrived.collect_new(sources_, taken_);
  return arrived.collect(sources_, epoch()).value_or(Population{});
}

void HostedIsland::run_epoch(const Population& immigrants, const std::function<void()>& heartbeat) {
  const std::uint64_t evaluations = state().evaluations;
  const auto begin = std::chrono::steady_clock::now();
  std::visit([&](auto& island) { island.run_epoch(immigrants, heartbeat); }, island_);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  const IslandState& after = state();
  evaluations_per_s_ = static_cast<double>(after.evaluations - evaluations) / std::max(elapsed.count(), 1e-9);
  const IslandFigures figures = std::visit([](const auto& island) { return island.figures(); }, island_);
  unreported_.push_back({after.epoch, after.generation, figures, after.evaluations, after.migrants_taken});
  Population emigrants = std::visit([](const auto& island) { return island.emigrants(); }, island_);
  recent_.push_back({run_->data.run, island(), epoch(), std::move(emigrants), {}});
  migrants_sent_ += recent_.back().individuals.size();
  while (recent_.size() > kMigrantEpochs) recent_.pop_front();
  epoch_ended_ = std::chrono::steady_clock::now();
}

std::vector<Migrants> HostedIsland::unsent() {
  if (std::exchange(all_recent_unsent_, false)) return {recent_.begin(), recent_.end()};
  return {recent_.back()};
}

std::optional<Progress> HostedIsland::due_progress(const std::string& worker, std::chrono::milliseconds interval) {
  const auto now = std::chrono::steady_clock::now();
  if (unreported_.empty()) return std::nullopt;
  if (!finished() && unreported_.size() < kMostReportedEpochs && now - progress_reported_ < interval)
    return std::nullopt;
  progress_reported_ = now;
  const EpochFigures present = unreported_.back();
  unreported_.pop_back();
  return Progress{.run = run_->data.run,
                  .island = island(),
                  .worker = worker,
                  .epoch = present.epoch,
                  .generation = present.generation,
                  .figures = present.figures,
                  .evaluations = present.evaluations,
                  .evaluations_per_s = evaluations_per_s_,
                  .migrants_taken = present.migrants_taken,
                  .migrants_sent = migrants_sent_,
                  .waited_share = waited_.at(now),
                  .best_formula = best_formula(),
                  .before = std::exchange(unreported_, {})};
}

/// What is too long is cut, and shows it.
std::string HostedIsland::best_formula() const {
  std::string text = std::visit([&](const auto& island) { return best_text(island, *run_); }, island_);
  constexpr std::string_view kEllipsis = "...";
  if (text.size() > kMostFormulaText) text.replace(kMostFormulaText - kEllipsis.size(), std::string::npos, kEllipsis);
  return text;
}

std::optional<Checkpoint> HostedIsland::due_checkpoint(const std::string& worker, std::chrono::milliseconds interval) {
  constexpr std::uint32_t kCheckpointEpochs = kMigrantEpochs / 2;
  const auto now = std::chrono::steady_clock::now();
  if (now - checkpoint_sent_ < interval && epoch() - checkpoint_epoch_ < kCheckpointEpochs) return std::nullopt;
  checkpoint_epoch_ = epoch();
  checkpoint_sent_ = now;
  return checkpoint(worker);
}

Checkpoint HostedIsland::checkpoint(const std::string& worker) const {
  return {run_->data.run, attempt_, island(), state(), {recent_.begin(), recent_.end()}, worker};
}

Outcome HostedIsland::outcome(const std::string& worker) const {
  return {.run = run_->data.run,
          .attempt = attempt_,
          .island = island(),
          .worker = worker,
          .generations = state().generation,
          .evaluations = state().evaluations,
          .migrants_taken = state().migrants_taken,
          .front = state().front,
          .numbers = state().numbers};
}

}  // namespace demecal::inline hosting
