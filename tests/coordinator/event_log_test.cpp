// The recorded run as a file: written as it happens, gone on with after a break, read back.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "coordinator/event_log.hpp"
#include "errors/input_error.hpp"
#include "monitor/watched.hpp"
#include "report/report.hpp"
#include "scheduling/in_memory_run.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

class EventFiles : public ::testing::Test {
 protected:
  EventFiles() { std::filesystem::create_directories(folder); }
  ~EventFiles() override { std::filesystem::remove_all(folder); }

  const std::string folder = ::testing::TempDir() + "demecal-events-" + std::to_string(::getpid());
  const std::string path = folder + "/" + kEventFile;
};

std::vector<Message> messages_in(const std::string& path) {
  std::vector<Message> messages;
  for (const Event& event : read_events(path)) messages.push_back(event.message);
  return messages;
}

TEST_F(EventFiles, HoldWhatWasNotedAsSoonAsItWas) {
  EventFile file(path, false);
  file.note(WorkerLost{"one"});
  EXPECT_EQ(messages_in(path), std::vector<Message>{WorkerLost{"one"}});
  file.note(Checkpoint{});
  file.note(WorkerLost{"two"});
  EXPECT_EQ(messages_in(path), (std::vector<Message>{WorkerLost{"one"}, WorkerLost{"two"}}));
}

TEST_F(EventFiles, GoOnAfterATornLineInTheSameTime) {
  write_file(path, first_event_line() + "\n" + event_line(WorkerLost{"one"}, 1000.0) + "\n{\"event\": \"wor");
  EventFile(path, true).note(WorkerLost{"two"});
  const std::vector<Event> events = read_events(path);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[1].message, Message(WorkerLost{"two"}));
  EXPECT_GE(events[1].time_s, 1000.0);
  EXPECT_LT(events[1].time_s, 1900.0);
}

TEST_F(EventFiles, BeginAnewWhereTheyAreNotResumedOrCannotBe) {
  EventFile(path, false).note(WorkerLost{"one"});
  EventFile(path, false).note(WorkerLost{"two"});
  EXPECT_EQ(messages_in(path), std::vector<Message>{WorkerLost{"two"}});
  write_file(path, "something else\n");
  EventFile(path, true).note(WorkerLost{"three"});
  EXPECT_EQ(messages_in(path), std::vector<Message>{WorkerLost{"three"}});
}

TEST_F(EventFiles, NameTheLineThatIsNone) {
  write_file(path, first_event_line() + "\nsomething else\n");
  try {
    read_events(path);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().line, 2u);
  }
}

/// The calibration that a watcher of the recorded run would be shown.
const WatchedCalibration& shown(Watched& watched, const std::string& path) {
  for (const Event& event : read_events(path)) watched.take(event.message, event.time_s);
  return *watched.calibration();
}

TEST_F(EventFiles, TellOfARunThatWasBrokenOffAndResumed) {
  const auto exchange = make_exchange();
  const auto reporter = [&] { return join(exchange, Role::reporter, "reporter"); };
  {
    EventLog broken(folder, false, "job", reporter());
    broken.on_run_begins(small_run(5), {}, true);
    // What a killed process leaves.
    std::filesystem::copy_file(path, path + ".killed");
  }
  Watched failed;
  EXPECT_EQ(shown(failed, path).stage.stage, LoopNews::Stage::failed);
  std::filesystem::rename(path + ".killed", path);
  Watched unended;
  EXPECT_TRUE(shown(unended, path).is_live());
  const auto watcher = join(exchange, Role::watcher, "watcher");
  EventLog resumed(folder, true, "job", reporter());
  const CalibrationData data = small_run(6);
  Progress reached;
  reached.run = data.run;
  reached.worker = "one";
  resumed.on_run_begins(data, {reached}, true);
  resumed.on_run_ends(RunEnd::finished);
  resumed.finish(LoopNews::Stage::finished, "finished");
  Watched finished;
  EXPECT_EQ(shown(finished, path).stage.stage, LoopNews::Stage::finished);
  EXPECT_EQ(finished.other_calibrations(), 0u);
  Watched live;
  while (const auto message = watcher->receive(std::chrono::milliseconds{0})) live.take(*message, 1.0);
  EXPECT_EQ(live.calibration()->stage.text, "finished");
  ASSERT_NE(live.run(), nullptr);
  EXPECT_EQ(live.run()->islands.size(), 1u) << "what no worker will tell again";
}

/// Two causes, of which much or little is known, and no accept poses.
Report made_up_report() {
  Report report;
  report.causes.resize(2);
  CauseEntry& backlash = report.causes[0];
  backlash.cause = "lost_motion";
  backlash.joint = 2;
  backlash.name = "lost motion of joint 2";
  backlash.without_mm = 0.5;
  backlash.advice = "a";
  report.causes[1].name = "heat";
  report.causes[1].with_mm = 0.25;
  report.causes[1].share_of_error = 0.125;
  report.rounds.resize(3);
  report.rounds[0].verdict = report.rounds[1].verdict = "added";
  report.rounds[2].verdict = "rejected";
  report.before.validation.rms_mm = 0.5;
  report.after.validation.rms_mm = 0.25;
  return report;
}

TEST_F(EventFiles, TellOfEveryCauseAndTheFinalFiguresBeforeTheEnd) {
  const auto exchange = make_exchange();
  EventLog log(folder, false, "job", join(exchange, Role::reporter, "reporter"));
  log.tell_of(made_up_report());
  log.finish(LoopNews::Stage::finished, "finished");
  const auto late = join(exchange, Role::watcher, "late");
  std::vector<std::string> heard, recorded;
  std::vector<Message> messages;
  while (auto message = late->receive(std::chrono::milliseconds{0})) {
    heard.push_back(event_line(*message, 0.0));
    messages.push_back(std::move(*message));
  }
  for (const Message& message : messages_in(path)) recorded.push_back(event_line(message, 0.0));
  recorded.erase(recorded.begin());  // the first stage: the last one takes its place for who comes late
  EXPECT_EQ(recorded, heard);
  ASSERT_EQ(messages.size(), 4u);
  const std::uint64_t calibration = std::get<LoopNews>(messages[3]).calibration;
  const auto backlash = std::get<CauseFound>(messages[0]), heat = std::get<CauseFound>(messages[1]);
  const auto figures = std::get<FinalFigures>(messages[2]);
  EXPECT_TRUE(std::isnan(backlash.with_m) && std::isnan(backlash.share_of_error) && std::isnan(heat.without_m));
  CauseFound known = backlash;
  known.with_m = known.share_of_error = 0.0;
  EXPECT_EQ(known, (CauseFound{calibration, 1, "lost_motion", 2, "lost motion of joint 2", 0.5e-3, 0.0, 0.0, "a"}));
  EXPECT_EQ(heat.calibration, calibration);
  EXPECT_EQ(heat.number, 2u);
  EXPECT_EQ(heat.joint, 0u);
  EXPECT_EQ(heat.with_m, 0.25e-3);
  EXPECT_EQ(heat.share_of_error, 0.125);
  EXPECT_TRUE(std::isnan(figures.accept_before_m) && std::isnan(figures.accept_after_m));
  FinalFigures of_validation = figures;
  of_validation.accept_before_m = of_validation.accept_after_m = 0.0;
  EXPECT_EQ(of_validation, (FinalFigures{calibration, "job", 2, 2, 0.5e-3, 0.25e-3, 0.0, 0.0}));
}

TEST_F(EventFiles, TellWhoComesLateWhatARunReachedWhoseWorkersAreGone) {
  const auto exchange = make_exchange();
  EventLog log(folder, false, "job", join(exchange, Role::reporter, "reporter"));
  const CalibrationData data = small_run(7);
  Progress begun, reached;
  begun.run = reached.run = data.run;
  begun.worker = reached.worker = "one";
  reached.generation = 12;
  reached.evaluations = 500;
  log.on_run_begins(data, {}, true);
  log.on_progress(begun);
  log.on_progress(reached);
  log.on_run_ends(RunEnd::finished);
  const auto late = join(exchange, Role::watcher, "late");
  std::vector<Message> seen;
  while (const auto message = late->receive(std::chrono::milliseconds{0})) {
    if (std::holds_alternative<Progress>(*message)) seen.push_back(*message);
  }
  EXPECT_EQ(seen, std::vector<Message>{reached});
  const auto recorded = messages_in(path);
  EXPECT_EQ(std::ranges::count(recorded, Message(reached)), 1);
}

}  // namespace
}  // namespace demecal
