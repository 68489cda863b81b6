#include "monitor/state_json.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "monitor/events.hpp"
#include "protocol/findings.hpp"
#include "report/json.hpp"

namespace demecal::inline monitor {
namespace {

using Json = nlohmann::ordered_json;

/// The members of the event that the message is.
Json members_of(const Message& message) {
  Json json = event_json(message, 0.0);
  json.erase("event");
  json.erase("t_s");
  return json;
}

const char* to_string(WatchedWorker::Presence presence) {
  switch (presence) {
    case WatchedWorker::Presence::left:
      return "left";
    case WatchedWorker::Presence::lost:
      return "lost";
    case WatchedWorker::Presence::here:
      break;
  }
  return "here";
}

Json calibration_json(const WatchedCalibration& calibration) {
  Json json = members_of(calibration.stage);
  json["lost"] = calibration.lost;
  json["rounds"] = Json::array();
  for (const auto& [number, round] : calibration.rounds) json["rounds"].push_back(members_of(round));
  json["causes"] = Json::array();
  for (const auto& [number, cause] : calibration.causes) json["causes"].push_back(members_of(cause));
  json["final_figures"] = calibration.figures ? members_of(*calibration.figures) : Json();
  return json;
}

Json watched_run_json(const Watched& watched, const WatchedRun& run, double now_s) {
  Json json = members_of(run.data);
  json["state"] = to_string(run.state);
  json.update(run_figures(watched, run, now_s));
  json["islands"] = Json::array();
  for (const auto& [key, island] : run.islands) json["islands"].push_back(members_of(island));
  return json;
}

Json worker_json(const Watched& watched, const WatchedWorker& worker, double now_s) {
  Json json = members_of(worker.status);
  json["presence"] = to_string(worker.presence);
  const WatchedRun* run = watched.run();
  const bool is_here = worker.presence == WatchedWorker::Presence::here;
  json["evaluations_per_s"] = run != nullptr && is_here ? evaluations_per_s(watched, *run, worker, now_s) : 0.0;
  return json;
}

}  // namespace

Json run_figures(const Watched& watched, const WatchedRun& run, double now_s) {
  const auto left = run.state == Control::State::running ? time_left_s(watched, run, now_s) : std::nullopt;
  return {{"share_done", share_done(run)},
          {"evaluations", run.evaluations},
          {"evaluations_per_s", std::round(evaluations_per_s(watched, run, now_s))},
          {"time_left_s", left ? Json(std::round(*left)) : Json()}};
}

std::string state_json(const Watched& watched, double now_s, const std::string& place) {
  const WatchedCalibration* calibration = watched.calibration();
  const WatchedRun* run = watched.run();
  Json json{{"demecal_state", kStateVersion}, {"t_s", now_s}, {"place", place}};
  json["calibration"] = calibration == nullptr ? Json() : calibration_json(*calibration);
  json["run"] = run == nullptr ? Json() : watched_run_json(watched, *run, now_s);
  json["workers"] = Json::array();
  for (const WatchedWorker* worker : watched.workers()) json["workers"].push_back(worker_json(watched, *worker, now_s));
  json["other_calibrations"] = watched.other_calibrations();
  return one_line(json) + "\n";
}

}  // namespace demecal::inline monitor
