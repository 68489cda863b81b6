#include "monitor/watched.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evolution/archipelago.hpp"
#include "fitness/parameters.hpp"
#include "protocol/messages.hpp"

namespace demecal::inline monitor {
namespace {

/// The islands of one worker that are not finished.
struct Share {
  double islands = 0.0;
  double speed_sum = 0.0;
};

/// Slots of a worker that are at work on average; of an unknown one, one.
double busy_slots(const WatchedWorker* worker) {
  if (worker == nullptr) return 1.0;
  if (worker->presence != WatchedWorker::Presence::here) return 0.0;
  return worker->status.slots * (1.0 - std::clamp(worker->status.waited_share, 0.0, 1.0));
}

double generations_total(const WatchedRun& run) {
  return static_cast<double>(run.data.archipelago.joints.size()) * run.data.archipelago.demes_per_joint *
         run.data.parameters.number_generations;
}

double generations_bred(const WatchedRun& run) {
  double bred = 0.0;
  for (const auto& [key, island] : run.islands) bred += island.generation;
  return bred;
}

/// What a generation costs; before any is bred, as much as the population.
double evaluations_per_generation(const WatchedRun& run) {
  const double founders = run.data.parameters.population_size, bred = generations_bred(run);
  if (bred <= 0.0) return founders;
  double evaluations = 0.0;
  for (const auto& [key, island] : run.islands) {
    evaluations += std::max(0.0, static_cast<double>(island.evaluations) - founders);
  }
  return evaluations / bred;
}

/// By what each worker reports of its epochs; what passes between epochs is not in it.
std::map<std::string, double> reported_per_s(const Watched& watched, const WatchedRun& run) {
  std::map<std::string, Share> shares;
  for (const auto& [key, island] : run.islands) {
    if (run.has_finished(island) || !(island.evaluations_per_s > 0.0)) continue;
    Share& share = shares[island.worker];
    share.islands += 1.0;
    share.speed_sum += island.evaluations_per_s;
  }
  std::map<std::string, double> reported;
  for (const auto& [name, share] : shares) {
    reported[name] = share.speed_sum / share.islands * std::min(share.islands, busy_slots(watched.worker(name)));
  }
  return reported;
}

double total_per_s(const std::map<std::string, double>& reported) {
  double sum = 0.0;
  for (const auto& [name, speed] : reported) sum += speed;
  return sum;
}

std::optional<double> seen_per_s(const WatchedRun& run, double now_s) {
  constexpr double kLeast_s = 1.0;
  if (run.marks.empty() || now_s - run.marks.front().time_s < kLeast_s) return std::nullopt;
  const WorkMark& first = run.marks.front();
  return static_cast<double>(run.evaluations - first.evaluations) / (now_s - first.time_s);
}

}  // namespace

double evaluations_per_s(const Watched& watched, const WatchedRun& run, double now_s) {
  if (run.state != Control::State::running || share_done(run) >= 1.0) return 0.0;
  return seen_per_s(run, now_s).value_or(total_per_s(reported_per_s(watched, run)));
}

double evaluations_per_s(const Watched& watched, const WatchedRun& run, const WatchedWorker& worker, double now_s) {
  const auto reported = reported_per_s(watched, run);
  const auto own = reported.find(worker.status.worker);
  if (own == reported.end() || own->second <= 0.0) return 0.0;
  return evaluations_per_s(watched, run, now_s) * own->second / total_per_s(reported);
}

double share_done(const WatchedRun& run) {
  return run.has_data() ? std::clamp(generations_bred(run) / generations_total(run), 0.0, 1.0) : 0.0;
}

std::optional<double> time_left_s(const Watched& watched, const WatchedRun& run, double now_s) {
  if (!run.has_data()) return std::nullopt;
  const double left = generations_total(run) - generations_bred(run);
  const double speed = evaluations_per_s(watched, run, now_s);
  if (left <= 0.0) return 0.0;
  if (!(speed > 0.0)) return std::nullopt;
  return left * evaluations_per_generation(run) / speed;
}

}  // namespace demecal::inline monitor
