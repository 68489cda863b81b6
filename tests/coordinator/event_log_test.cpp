// The recorded run as a file: written as it happens, gone on with after a break, read back.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <variant>
#include <vector>

#include "coordinator/event_log.hpp"
#include "errors/input_error.hpp"
#include "monitor/watched.hpp"
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
