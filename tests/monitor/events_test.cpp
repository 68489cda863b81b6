// Events as lines: JSON that says all that the page needs, read back to the same page.
#include "monitor/events.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "errors/input_error.hpp"
#include "made_up_run.hpp"
#include "terminal/monitor_page.hpp"

namespace demecal {
namespace {

using Json = nlohmann::json;

std::vector<Message> all_kinds() {
  std::vector<Message> messages = made_up_messages(made_up_data());
  messages.emplace_back(Control{kRun, Control::State::cancelled, "note"});
  for (Message& found : made_up_findings()) messages.push_back(std::move(found));
  messages.emplace_back(CalibrationLost{kCalibration});
  return messages;
}

TEST(EventLine, IsOneLineOfJsonWithAWordAndATime) {
  for (const Message& message : all_kinds()) {
    const std::string line = event_line(message, 1.25);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const Json json = Json::parse(line);
    EXPECT_FALSE(json.at("event").get<std::string>().empty());
    EXPECT_EQ(json.at("t_s"), 1.25);
  }
}

TEST(EventLine, ReadBackGivesTheSamePage) {
  Watched told, read;
  const std::vector<Message> messages = all_kinds();
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const double now_s = 0.5 * static_cast<double>(i);
    told.take(messages[i], now_s);
    const auto event = read_event(event_line(messages[i], now_s), "events.jsonl", 1);
    ASSERT_TRUE(event.has_value());
    EXPECT_EQ(event->time_s, now_s);
    read.take(event->message, now_s);
    const PageOptions options{.columns = 140, .lines = 0, .colours = false, .now_s = now_s, .place = "here"};
    EXPECT_EQ(monitor_page(read, options), monitor_page(told, options));
  }
  EXPECT_EQ(read.run()->islands, told.run()->islands);
  EXPECT_EQ(read.calibration()->causes.size(), told.calibration()->causes.size());
}

TEST(EventLine, NumbersOfRunsSurviveReadersOfDoubles) {
  Control control{std::numeric_limits<RunId>::max() - 1, Control::State::finished, ""};
  const std::string line = event_line(control, 0.0);
  EXPECT_EQ(Json::parse(line).at("run"), "18446744073709551614");
  EXPECT_EQ(std::get<Control>(read_event(line, "", 1)->message), control);
}

TEST(EventLine, WhatIsNotFiniteIsNullAndComesBack) {
  RandomStream random{3};
  Progress progress = made_up_progress(random, {1, 1}, 20);
  progress.figures.best = std::numeric_limits<double>::infinity();
  const std::string line = event_line(progress, 0.0);
  EXPECT_TRUE(Json::parse(line).at("best_fitness").is_null());
  EXPECT_EQ(std::get<Progress>(read_event(line, "", 1)->message), progress);
}

TEST(EventLine, OfWhatWasFoundIsInMillimetresAndUnknownFiguresAreNull) {
  const std::vector<Message> found = made_up_findings();
  const Json cause = Json::parse(event_line(found[0], 0.0)), of_the_arm = Json::parse(event_line(found[1], 0.0)),
             figures = Json::parse(event_line(found[2], 0.0));
  EXPECT_EQ(cause["event"], "cause");
  EXPECT_EQ(cause["calibration"], std::to_string(kCalibration));
  EXPECT_EQ(cause["number"], 1);
  EXPECT_EQ(cause["joint"], 2);
  EXPECT_DOUBLE_EQ(cause["without_mm"], 0.417);
  EXPECT_DOUBLE_EQ(cause["with_mm"], 0.262);
  EXPECT_EQ(cause["share_of_error"], 0.4);
  for (const char* const unknown : {"joint", "without_mm", "with_mm", "share_of_error"})
    EXPECT_TRUE(of_the_arm.at(unknown).is_null()) << unknown;
  EXPECT_EQ(figures["event"], "final_figures");
  EXPECT_EQ(figures["causes"], 2);
  EXPECT_DOUBLE_EQ(figures["validation_after_mm"], 0.262);
  EXPECT_TRUE(figures.at("accept_before_mm").is_null() && figures.at("accept_after_mm").is_null());
  const auto back = std::get<CauseFound>(read_event(event_line(found[1], 0.0), "", 1)->message);
  EXPECT_TRUE(back.joint == 0 && std::isnan(back.without_m) && std::isnan(back.with_m));
  const auto figures_back = std::get<FinalFigures>(read_event(event_line(found[2], 0.0), "", 1)->message);
  EXPECT_DOUBLE_EQ(figures_back.validation_before_m, 0.417e-3);
  EXPECT_TRUE(std::isnan(figures_back.accept_after_m));
}

TEST(EventLine, TextThatIsNoUtf8DoesNotBreakTheLine) {
  const std::string line = event_line(WorkerLost{"wor\xFFker\n"}, 0.0);
  EXPECT_NO_THROW(Json::parse(line));
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST(EventLine, IsEmptyForWhatDoesNotConcernPeople) {
  for (const Message& message : std::vector<Message>{IslandTask{}, Migrants{}, Checkpoint{}, Outcome{}}) {
    EXPECT_EQ(event_line(message, 1.0), "");
  }
}

TEST(ReadEvent, PassesOverTheFirstLineAndOverWordsOfLaterVersions) {
  EXPECT_EQ(read_event(first_event_line(), "", 1), std::nullopt);
  EXPECT_EQ(read_event(R"({"event": "sunset", "t_s": 3})", "", 1), std::nullopt);
}

TEST(ReadEvent, NamesFileLineAndKeyOfWhatIsWrong) {
  for (const auto& [line, word] : std::vector<std::pair<std::string, std::string>>{
           {R"({"event": "begin", "demecal_events": 2})", "demecal_events"},
           {R"({"t_s": 1})", "event"},
           {R"({"event": "progress", "joint": 0, "island": 1})", "joint"},
           {R"({"event": "progress", "joint": 1, "island": 1, "epoch": -1})", "epoch"},
           {R"({"event": "run_state", "state": "walking"})", "state"},
           {R"({"event": "run_state", "run": "7x", "state": "running"})", "run"},
           {R"({"event": "worker", "slots": 1e30})", "slots"},
           {R"(no JSON)", "JSON"}}) {
    try {
      read_event(line, "events.jsonl", 17);
      ADD_FAILURE() << line;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find("events.jsonl:17"), 0u) << error.what();
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace demecal
