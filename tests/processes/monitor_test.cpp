// The monitor over real DDS: it sees a run that goes on, outlives its coordinator, and nothing depends on it.
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using Json = nlohmann::json;

/// Domains of this file alone: what is killed in one is not met in the next.
std::string domain(int which) {
  return private_domain(100 + which);
}

std::vector<std::string> calibrate_on(const SmallJob& job, const std::string& out, int which) {
  return {"calibrate", job.job(),     "--out",         job.path(out), "--workers", "2",
          "--domain",  domain(which), "--max-effects", "0",           "--quiet"};
}

std::vector<std::string> monitor(int which, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"monitor", "--domain", domain(which)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Every line parses, and has a word and a time.
std::vector<Json> events_of(const std::string& text) {
  std::vector<Json> events;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const Json event = Json::parse(line);
    if (event.at("event") == "begin") continue;
    EXPECT_TRUE(event.at("t_s").is_number());
    events.push_back(event);
  }
  return events;
}

std::size_t islands_in(const std::vector<Json>& events) {
  std::set<std::pair<int, int>> islands;
  for (const Json& event : events) {
    if (event["event"] == "progress") islands.emplace(event["joint"], event["island"]);
  }
  return islands.size();
}

/// Whether the monitor hears how far all twelve islands are, however long the first of them take.
bool hears_all_islands(StartedProgram& listening) {
  for (int joint = 1; joint <= 6; ++joint)
    for (const char* const island : {"1", "2"})
      if (!listening.wait_for_out("\"joint\":" + std::to_string(joint) + ",\"island\":" + island + ",")) return false;
  return true;
}

bool has(const std::vector<Json>& events, const char* word, const char* key, const char* value) {
  return std::any_of(events.begin(), events.end(),
                     [&](const Json& event) { return event["event"] == word && event.at(key) == value; });
}

TEST(Monitor, ComesLateSeesAllThatIsThereAndOutlivesTheCoordinator) {
  const SmallJob job(100000, 2);
  StartedProgram watching("demecal", monitor(1)), listening("demecal", monitor(1, {"--json"}));
  ASSERT_TRUE(watching.wait_for_out("nobody is calibrating"));
  StartedProgram coordinator("demecal", calibrate_on(job, "out", 1));
  ASSERT_TRUE(hears_all_islands(listening)) << listening.out_so_far();
  const Ended once = run("demecal", monitor(1, {"--once"}));
  EXPECT_EQ(once.code, 0) << once.err;
  for (const char* const shown : {"evolving", "joint 1", "joint 6", "eval/s", "w1", "w2", "worker's host"}) {
    EXPECT_NE(once.out.find(shown), std::string::npos) << shown << "\n" << once.out;
  }
  EXPECT_EQ(once.out.find('\033'), std::string::npos);
  const Ended lines = run("demecal", monitor(1, {"--once", "--json"}));
  EXPECT_EQ(lines.code, 0) << lines.err;
  const std::vector<Json> present = events_of(lines.out);
  EXPECT_EQ(islands_in(present), 12u);
  EXPECT_TRUE(has(present, "stage", "stage", "evolving"));
  EXPECT_TRUE(has(present, "run", "job", "job"));

  coordinator.signal(SIGKILL);
  EXPECT_TRUE(watching.wait_for_out("coordinator is gone: waiting for the next calibration"));
  EXPECT_TRUE(listening.wait_for_out("calibration_lost"));
  const SmallJob next;
  ASSERT_EQ(run("demecal", calibrate_on(next, "out", 1)).code, 0);
  EXPECT_TRUE(listening.wait_for_out("\"finished\""));
  EXPECT_TRUE(watching.wait_for_out("finished"));
  for (StartedProgram* program : {&watching, &listening}) {
    program->signal(SIGINT);
    const Ended ended = program->wait(std::chrono::seconds(20));
    EXPECT_EQ(ended.code, 0) << ended.err;
  }
  EXPECT_GE(events_of(listening.out_so_far()).size(), present.size());
}

TEST(Monitor, SaysThatNobodyIsThere) {
  const Ended ended = run("demecal", monitor(2, {"--once", "--wait", "0.5"}));
  EXPECT_EQ(ended.code, 20);
  EXPECT_NE(ended.out.find("nobody is calibrating in domain " + domain(2)), std::string::npos) << ended.out;
}

TEST(Monitor, ChangesNothingOfTheModelWhetherItWatchesOrIsStopped) {
  const SmallJob job(1000, 2);  // longer than it takes to find each other
  ASSERT_EQ(run("demecal", calibrate_on(job, "alone", 3)).code, 0);
  StartedProgram watching("demecal", monitor(3, {"--json"}));
  ASSERT_TRUE(watching.wait_for_out("begin"));
  ASSERT_EQ(run("demecal", calibrate_on(job, "watched", 3)).code, 0);
  ASSERT_TRUE(watching.wait_for_out("\"finished\""));
  EXPECT_EQ(islands_in(events_of(watching.out_so_far())), 12u);

  StartedProgram stopped("demecal", monitor(3, {"--json"}));
  ASSERT_TRUE(stopped.wait_for_out("begin"));
  StartedProgram coordinator("demecal", calibrate_on(job, "stopped", 3));
  ASSERT_TRUE(stopped.wait_for_out("\"progress\""));
  stopped.signal(SIGSTOP);
  EXPECT_EQ(coordinator.wait().code, 0);
  const std::string alone = job.text("alone/model.yaml");
  ASSERT_FALSE(alone.empty());
  EXPECT_EQ(job.text("watched/model.yaml"), alone);
  EXPECT_EQ(job.text("stopped/model.yaml"), alone);
}

TEST(Monitor, ShowsARecordedRun) {
  const SmallJob job;
  ASSERT_EQ(run("demecal", calibrate_on(job, "out", 4)).code, 0);
  const std::vector<Json> recorded = events_of(job.text("out/events.jsonl"));
  EXPECT_EQ(islands_in(recorded), 12u);
  EXPECT_TRUE(has(recorded, "stage", "stage", "finished"));
  const Ended once = run("demecal", {"monitor", "--replay", job.path("out"), "--once"});
  EXPECT_EQ(once.code, 0) << once.err;
  for (const char* const shown : {"finished", "joint 6", "100%"}) {
    EXPECT_NE(once.out.find(shown), std::string::npos) << once.out;
  }
  const Ended lines = run("demecal", {"monitor", "--replay", job.path("out/events.jsonl"), "--json", "--speed", "100"});
  EXPECT_EQ(events_of(lines.out), recorded);
  const Ended frames = run("demecal", {"monitor", "--replay", job.path("out"), "--speed", "100"});
  EXPECT_EQ(frames.code, 0);
  EXPECT_TRUE(frames.out.ends_with(once.out + "\n")) << frames.out;
  EXPECT_EQ(run("demecal", {"monitor", "--replay", job.path("data")}).code, 11);
  EXPECT_EQ(run("demecal", {"monitor", "--replay", job.job()}).code, 11);
}

/// The words of a calibration's news, in their order, each as often as it comes.
std::vector<std::string> words_of(const std::vector<Json>& events) {
  std::vector<std::string> words;
  for (const Json& event : events) words.push_back(event["event"]);
  return words;
}

TEST(Monitor, HearsOfACalibrationThatBeganWithAnOlderModelAsOfAnyOther) {
  const SmallJob job;
  ASSERT_EQ(run("demecal", calibrate_on(job, "old", 5)).code, 0);
  const auto with_prior = [&](const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(), {"calibrate", job.job(), "--prior", job.path("old/model.yaml"), "--out", job.path(out)});
    return more;
  };
  StartedProgram watching("demecal", monitor(5, {"--json"}));
  ASSERT_TRUE(watching.wait_for_out("begin"));
  const Ended ended = run("demecal", with_prior("out", {"--domain", domain(5), "--quiet"}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  ASSERT_TRUE(watching.wait_for_out("\"finished\""));
  const std::vector<Json> recorded = events_of(job.text("out/events.jsonl"));
  EXPECT_EQ(words_of(recorded), (std::vector<std::string>{"stage", "final_figures", "stage"}));
  EXPECT_TRUE(has(recorded, "stage", "stage", "finished"));
  const Json figures = recorded.at(1), report = Json::parse(job.text("out/report.json"));
  EXPECT_EQ(figures["job"], "job");
  EXPECT_NEAR(figures["accept_after_mm"], report["error_mm"]["after"]["accept"]["rms"], 1e-9);
  EXPECT_NE(watching.out_so_far().find("\"final_figures\""), std::string::npos) << watching.out_so_far();
  const Ended once = run("demecal", {"monitor", "--replay", job.path("out"), "--once"});
  EXPECT_EQ(once.code, 0) << once.err;
  EXPECT_NE(once.out.find("finished"), std::string::npos) << once.out;

  ASSERT_EQ(run("demecal", with_prior("unheard", {"--workers", "in-process"})).code, 0);
  EXPECT_EQ(words_of(events_of(job.text("unheard/events.jsonl"))), words_of(recorded));
  ASSERT_FALSE(job.text("out/model.yaml").empty());
  EXPECT_EQ(job.text("unheard/model.yaml"), job.text("out/model.yaml"));
}

}  // namespace
}  // namespace demecal
