// Events at a page's pace: few enough, and never without the last figures.
#include "monitor/paced_events.hpp"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "made_up_run.hpp"
#include "monitor/events.hpp"
#include "monitor/state_json.hpp"

namespace demecal {
namespace {

using Json = nlohmann::json;

std::vector<Json> of_word(const std::vector<PacedLine>& lines, const std::string& word) {
  std::vector<Json> found;
  for (const PacedLine& line : lines) {
    Json json = Json::parse(line.text);
    if (json["event"] == word) found.push_back(std::move(json));
  }
  return found;
}

/// A minute in which every island reports ten times a second, and its end.
std::vector<PacedLine> told_of_a_minute(const CalibrationData& data, std::map<IslandKey, Progress>& last) {
  RandomStream random{12};
  PacedEvents events(0.5);
  std::vector<PacedLine> told;
  const auto add = [&](std::vector<PacedLine> lines) { told.insert(told.end(), lines.begin(), lines.end()); };
  add(events.take(made_up_stage(LoopNews::Stage::evolving, "evolving"), 0.0));
  add(events.take(data, 0.0));
  for (int tick = 0; tick < 600; ++tick) {
    const double now_s = 0.1 * tick;
    for (const IslandKey island : islands(data.archipelago)) {
      last[island] = made_up_progress(random, island, static_cast<std::uint32_t>(tick / 3));
      add(events.take(last[island], now_s));
    }
    add(events.take(made_up_worker(1), now_s));
    add(events.due(now_s));
  }
  add(events.take(Control{kRun, Control::State::finished, ""}, 60.0));
  return told;
}

TEST(PacedEvents, AreFewAndEndWithTheLastFiguresOfEveryIsland) {
  const CalibrationData data = made_up_data();
  std::map<IslandKey, Progress> last;
  const std::vector<PacedLine> told = told_of_a_minute(data, last);
  const auto progress = of_word(told, "progress");
  EXPECT_LE(progress.size(), 12u * 122u);
  EXPECT_GE(progress.size(), 12u * 90u);
  std::map<std::string, std::string> of_key;
  for (const PacedLine& line : told) of_key[line.key] = line.text;
  std::size_t found = 0;
  for (const auto& [key, text] : of_key) {
    const auto event = read_event(text, "line", 1);
    const Progress* seen = event ? std::get_if<Progress>(&event->message) : nullptr;
    if (seen == nullptr) continue;
    ++found;
    EXPECT_EQ(*seen, last.at(seen->island)) << key;
  }
  EXPECT_EQ(found, 12u);
  EXPECT_EQ(of_word({told.end() - 1, told.end()}, "run_state").size(), 1u);
  EXPECT_EQ(of_word(told, "worker").size(), 1u);
  const auto figures = of_word(told, "figures");
  EXPECT_GE(figures.size(), 50u);
  EXPECT_LE(figures.size(), 61u);
  EXPECT_GT(figures.back()["share_done"], 0.9);
}

TEST(PacedEvents, TellOfAWorkerWhatIsNew) {
  PacedEvents events(0.5);
  WorkerStatus status = made_up_worker(1);
  EXPECT_EQ(events.take(status, 0.0).size(), 1u);
  status.waited_share += 0.01;
  EXPECT_EQ(events.take(status, 1.0).size(), 0u);
  status.waited_share += 0.2;
  EXPECT_EQ(events.take(status, 2.0).size(), 1u);
  status.leaving = true;
  EXPECT_EQ(events.take(status, 3.0).size(), 1u);
  EXPECT_EQ(events.take(WorkerLost{status.worker}, 4.0).size(), 1u);
}

TEST(PacedEvents, SayNothingOfWhatDoesNotConcernPeople) {
  PacedEvents events(0.5);
  EXPECT_TRUE(events.take(IslandTask{}, 0.0).empty());
  EXPECT_TRUE(events.take(Checkpoint{}, 0.0).empty());
  EXPECT_TRUE(events.due(5.0).empty());
}

TEST(StateJson, HoldsWhatWasSeenByTheNamesOfEvents) {
  Watched watched = watched_after(made_up_messages(made_up_data()));
  EXPECT_TRUE(Json::parse(state_json(watched, 2.5, "domain 3"))["calibration"]["final_figures"].is_null());
  for (const Message& found : made_up_findings()) watched.take(found, 1.0);
  const Json state = Json::parse(state_json(watched, 2.5, "domain 3"));
  EXPECT_EQ(state["demecal_state"], kStateVersion);
  EXPECT_EQ(state["t_s"], 2.5);
  EXPECT_EQ(state["place"], "domain 3");
  EXPECT_EQ(state["calibration"]["stage"], "evolving");
  EXPECT_EQ(state["calibration"]["rounds"].size(), 2u);
  ASSERT_EQ(state["calibration"]["causes"].size(), 2u);
  EXPECT_EQ(state["calibration"]["causes"][0]["label"], "lost motion of joint 2");
  EXPECT_EQ(state["calibration"]["final_figures"]["effects"], 3);
  EXPECT_EQ(state["run"]["islands"].size(), 12u);
  EXPECT_DOUBLE_EQ(state["run"]["share_done"].get<double>(), share_done(*watched.run()));
  ASSERT_EQ(state["workers"].size(), 3u);
  EXPECT_EQ(state["workers"][1]["presence"], "lost");
  for (const Json& island : state["run"]["islands"]) {
    const IslandKey key{island["joint"].get<std::uint32_t>() - 1, island["island"].get<std::uint32_t>() - 1};
    EXPECT_EQ(island["generation"], watched.run()->islands.at(key).generation);
  }
}

TEST(StateJson, IsThereBeforeAnythingIsSeen) {
  const Json state = Json::parse(state_json(Watched{}, 0.0, "domain 3"));
  EXPECT_TRUE(state["calibration"].is_null());
  EXPECT_TRUE(state["run"].is_null());
  EXPECT_TRUE(state["workers"].empty());
}

}  // namespace
}  // namespace demecal
