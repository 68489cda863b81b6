// Distal learning's rounds over real processes: one set of workers serves them all, and may lose members.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using Json = nlohmann::json;

std::vector<std::string> learn_distally(const SmallJob& job, const std::string& out, int workers) {
  return {"calibrate", job.job(),           "--out",    job.path(out), "--workers",     std::to_string(workers),
          "--domain",  private_domain(300), "--method", "distal",      "--max-effects", "0"};
}

/// What a recorded calibration tells of its runs and workers, as far as its file is written.
struct Recorded {
  std::vector<std::string> runs;                         ///< as they began
  std::set<std::string> joined, left;                    ///< workers
  std::map<std::string, std::set<std::string>> bred_by;  ///< workers, by run
};

Recorded recorded(const SmallJob& job, const std::string& out) {
  Recorded all;
  std::istringstream lines(job.text(out + "/events.jsonl"));
  for (std::string line; std::getline(lines, line) && !lines.eof();) {
    const Json event = Json::parse(line);
    if (event["event"] == "run") all.runs.push_back(event["run"]);
    if (event["event"] == "worker") (event["leaving"] ? all.left : all.joined).insert(event["worker"]);
    if (event["event"] == "progress") all.bred_by[event["run"]].insert(event["worker"]);
  }
  return all;
}

/// Waits until so many runs have begun.
bool await_runs(const SmallJob& job, const std::string& out, std::size_t runs) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (recorded(job, out).runs.size() < runs) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::yield();
  }
  return true;
}

TEST(Distal, RoundsAreBredByTheSameTwoProcessesWhichLeaveInTheEnd) {
  const SmallJob job(400);  // longer than a second process takes to come
  ASSERT_EQ(run("demecal", learn_distally(job, "two", 2)).code, 0);
  const Recorded two = recorded(job, "two");
  EXPECT_GT(two.runs.size(), 2U);
  EXPECT_EQ(two.joined.size(), 2U);
  EXPECT_EQ(two.left, two.joined);
  for (const auto& [run, workers] : two.bred_by)
    for (const std::string& worker : workers) EXPECT_TRUE(two.joined.contains(worker));
  ASSERT_EQ(run("demecal", learn_distally(job, "one", 1)).code, 0);
  EXPECT_FALSE(job.text("one/model.yaml").empty());
  EXPECT_EQ(job.text("one/model.yaml"), job.text("two/model.yaml"));
}

TEST(Distal, ALocalWorkerThatDiesLeavesTheOtherAndTheSameModel) {
  const SmallJob job(4000);
  ASSERT_EQ(run("demecal", learn_distally(job, "calm", 2)).code, 0);
  StartedProgram coordinator("demecal", learn_distally(job, "killed", 2));
  ASSERT_TRUE(await_runs(job, "killed", 2));
  const std::vector<pid_t> workers = coordinator.children();
  ASSERT_EQ(workers.size(), 2U);
  ::kill(workers.front(), SIGKILL);
  const Ended ended = coordinator.wait();
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(recorded(job, "killed").joined.size(), 2U);
  EXPECT_EQ(job.text("calm/model.yaml"), job.text("killed/model.yaml"));
  EXPECT_EQ(job.text("calm/distal.csv"), job.text("killed/distal.csv"));
}

TEST(Distal, AWorkerStartedElsewhereServesEveryRound) {
  const SmallJob job(40);
  const StartedProgram elsewhere("demecal-worker", {"--domain", private_domain(300)});
  ASSERT_EQ(run("demecal", learn_distally(job, "elsewhere", 0)).code, 0);
  const Recorded all = recorded(job, "elsewhere");
  EXPECT_GT(all.runs.size(), 2U);
  EXPECT_EQ(all.joined.size(), 1U);
  EXPECT_TRUE(all.left.empty());
}

}  // namespace
}  // namespace demecal
