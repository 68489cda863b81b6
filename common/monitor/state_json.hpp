// Events as JSON values, and what a watcher has seen so far as one JSON document, for programs and pages.
#pragma once

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "monitor/watched.hpp"
#include "protocol/messages.hpp"

namespace demecal::inline monitor {

/// What event_line() writes; null where that is empty.
nlohmann::ordered_json event_json(const Message& message, double time_s);

/// The value in one line, without its end.
std::string one_line(const nlohmann::ordered_json& json);

inline constexpr int kStateVersion = 1;

/// How far the run is, how fast, and how long it will take: share_done, evaluations, evaluations_per_s, time_left_s
/// (null where that is not known).
nlohmann::ordered_json run_figures(const Watched& watched, const WatchedRun& run, double now_s);

/// The shown calibration with its rounds, its run with its islands, and the workers; members are named as those of
/// events. `place` says for people where one watches.
std::string state_json(const Watched& watched, double now_s, const std::string& place);

}  // namespace demecal::inline monitor
