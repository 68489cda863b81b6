// docs/FORMATS.md has every key that the live page tells programs.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "formats_document.hpp"
#include "monitor/made_up_run.hpp"
#include "monitor/paced_events.hpp"
#include "monitor/state_json.hpp"

namespace demecal {
namespace {

using Told = nlohmann::ordered_json;

/// Every key as a path, after `path`.
void collect_keys(const Told& json, const std::string& path, std::set<std::string>& keys) {
  if (json.is_array()) {
    for (const Told& item : json) collect_keys(item, path + "[]", keys);
  }
  if (!json.is_object()) return;
  for (const auto& [key, value] : json.items()) {
    const std::string child = path.empty() ? key : path + '.' + key;
    keys.insert(child);
    collect_keys(value, child, keys);
  }
}

/// Less those that the page documents among events of this word.
void leave_out_those_of(const std::string& word, const std::string& at, std::set<std::string>& keys) {
  const std::set<std::string> events = formats_section("Events").keys();
  std::erase_if(keys, [&](const std::string& key) {
    return key.starts_with(at) && events.contains(word + '.' + key.substr(at.size()));
  });
}

TEST(LivePageFormats, StateAndFiguresHaveTheKeysOfThePage) {
  PacedEvents events(0.5);
  for (const Message& message : made_up_messages(made_up_data())) events.take(message, 1.0);
  for (const Message& found : made_up_findings()) events.take(found, 1.0);
  std::set<std::string> keys;
  collect_keys(Told::parse(state_json(events.watched(), 2.0, "domain 3")), "", keys);
  leave_out_those_of("stage", "calibration.", keys);
  leave_out_those_of("round", "calibration.rounds[].", keys);
  leave_out_those_of("cause", "calibration.causes[].", keys);
  leave_out_those_of("final_figures", "calibration.final_figures.", keys);
  leave_out_those_of("run", "run.", keys);
  leave_out_those_of("progress", "run.islands[].", keys);
  leave_out_those_of("worker", "workers[].", keys);
  for (const PacedLine& line : events.due(2.0)) collect_keys(Told::parse(line.text), "figures", keys);
  // As tests/processes/live_page_test.cpp finds them.
  keys.insert({"arm.event", "arm.t_s", "arm.data", "arm.arms_mm", "arm.poses_mm", "arm.before_mm", "arm.after_mm"});
  expect_documented(formats_section("monitor --http"), keys);
}

}  // namespace
}  // namespace demecal
