// The real programs over real DDS: a job gives one model, whoever works on it and whenever they come.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using Json = nlohmann::json;

std::vector<std::string> calibrate(const SmallJob& job, const std::string& out, int workers) {
  return {"calibrate", job.job(),       "--out", job.path(out), "--workers", std::to_string(workers),
          "--domain",  private_domain()};
}

std::vector<std::string> with_shared_work(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--share-work", "0"});
  return arguments;
}

std::unique_ptr<StartedProgram> worker() {
  return std::make_unique<StartedProgram>("demecal-worker", std::vector<std::string>{"--domain", private_domain()});
}

TEST(Calibrate, WritesModelReportAndHistoryAndPrintsTheErrors) {
  const SmallJob job;
  const Ended ended = run("demecal", calibrate(job, "out", 2));
  ASSERT_EQ(ended.code, 0) << ended.err;
  for (const char* expected : {"mean", "rms", "P95", "max", "validation", "joint"}) {
    EXPECT_NE(ended.out.find(expected), std::string::npos) << expected;
  }
  EXPECT_NE(ended.err.find("generation"), std::string::npos);
  const Json report = Json::parse(job.text("out/report.json"));
  EXPECT_EQ(report["demecal_report"], 1);
  EXPECT_EQ(report["poses"]["calibration"], 40);
  EXPECT_EQ(report["runtime"]["islands"], 12);
  EXPECT_EQ(report["runtime"]["generations"], 12 * 20);
  EXPECT_GT(report["runtime"]["migrations"], 0);
  EXPECT_LT(report["error_mm"]["before"]["validation"]["rms"], report["error_mm"]["registered"]["validation"]["rms"]);
  EXPECT_FALSE(job.text("out/report.html").empty());
  EXPECT_EQ(job.text("out/history.csv").substr(0, 24), "joint,island,generation,");
}

TEST(Calibrate, GivesTheSameModelForOneTwoAndTwelveWorkersAndWorkersStartedBeforeOrAfter) {
  const SmallJob job;
  ASSERT_EQ(run("demecal", calibrate(job, "one", 1)).code, 0);
  ASSERT_EQ(run("demecal", calibrate(job, "two", 2)).code, 0);
  const std::string model = job.text("one/model.yaml");
  ASSERT_FALSE(model.empty());
  EXPECT_EQ(model, job.text("two/model.yaml"));
  ASSERT_EQ(run("demecal", with_shared_work(calibrate(job, "twelve", 12))).code, 0);
  EXPECT_EQ(model, job.text("twelve/model.yaml"));
  {
    const auto first = worker(), second = worker();
    const Ended ended = run("demecal", with_shared_work(calibrate(job, "before", 0)));
    ASSERT_EQ(ended.code, 0);
    EXPECT_NE(ended.err.find("scans, draws and resamplings"), std::string::npos) << ended.err;
  }
  EXPECT_EQ(model, job.text("before/model.yaml"));
  StartedProgram coordinator("demecal", calibrate(job, "after", 0));
  ASSERT_TRUE(coordinator.wait_for_err("waiting"));
  const auto first = worker(), second = worker();
  ASSERT_EQ(coordinator.wait().code, 0);
  EXPECT_EQ(model, job.text("after/model.yaml"));
}

TEST(Calibrate, SurvivesTheDeathOfAWorkerWithTheSameModel) {
  const SmallJob job(200);
  ASSERT_EQ(run("demecal", calibrate(job, "whole", 2)).code, 0);
  auto victim = worker();
  StartedProgram coordinator("demecal", with_shared_work(calibrate(job, "killed", 0)));
  ASSERT_TRUE(coordinator.wait_for_err("joined"));
  const auto survivor = worker();
  victim->signal(SIGKILL);
  ASSERT_EQ(coordinator.wait().code, 0);
  EXPECT_EQ(job.text("whole/model.yaml"), job.text("killed/model.yaml"));
}

TEST(Calibrate, EndsWithTwentyWhereNoWorkerComes) {
  const SmallJob job;
  std::vector<std::string> arguments = calibrate(job, "out", 0);
  arguments.insert(arguments.end(), {"--worker-timeout-s", "1"});
  const Ended ended = run("demecal", arguments);
  EXPECT_EQ(ended.code, 20);
  EXPECT_NE(ended.err.find("no worker for 1 s"), std::string::npos) << ended.err;
}

TEST(Calibrate, InterruptedSavesWhatItReached) {
  const SmallJob job(1000000);
  StartedProgram coordinator("demecal", calibrate(job, "out", 2));
  ASSERT_TRUE(coordinator.wait_for_err("generation"));
  coordinator.signal(SIGINT);
  const Ended ended = coordinator.wait(std::chrono::seconds(30));
  EXPECT_EQ(ended.code, 130) << ended.err;
  EXPECT_NE(ended.out.find(job.path("out")), std::string::npos);
  EXPECT_TRUE(Json::parse(job.text("out/report.json"))["runtime"]["interrupted"]);
  EXPECT_EQ(run("demecal", {"evaluate", job.path("out/model.yaml"), job.data()}).code, 0);
}

TEST(Calibrate, DoesNotReadTheTruth) {
  const SmallJob job;
  ASSERT_EQ(run("demecal", calibrate(job, "with", 2)).code, 0);
  ASSERT_FALSE(job.text("data/truth.yaml").empty());
  std::filesystem::remove(job.path("data/truth.yaml"));
  ASSERT_EQ(run("demecal", calibrate(job, "without", 2)).code, 0);
  EXPECT_EQ(job.text("with/model.yaml"), job.text("without/model.yaml"));
}

TEST(Calibrate, WithoutEvolutionNeedsNoWorkerAndWritesNoHistory) {
  const SmallJob job;
  const Ended ended = run("demecal", {"calibrate", job.job(), "--out", job.path("out"), "--no-evolution", "--workers",
                                      "0", "--domain", private_domain()});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("nothing was evolved"), std::string::npos) << ended.out;
  EXPECT_TRUE(job.text("out/history.csv").empty());
  EXPECT_NE(job.text("out/model.yaml").find("method: diagnose"), std::string::npos);
  const Json report = Json::parse(job.text("out/report.json"));
  EXPECT_EQ(report["runtime"]["evaluations"], 0);
  const Ended contradiction = run("demecal", {"calibrate", DEMECAL_SOURCE_DIR "/configs/jobs/structural.yaml", "--out",
                                              job.path("other"), "--no-evolution"});
  EXPECT_EQ(contradiction.code, 11);
  EXPECT_NE(contradiction.err.find("--no-evolution"), std::string::npos) << contradiction.err;
}

TEST(Evaluate, ReproducesTheReportFromTheModelAlone) {
  const SmallJob job;
  ASSERT_EQ(run("demecal", calibrate(job, "out", 2)).code, 0);
  const Ended ended = run("demecal", {"evaluate", job.path("out/model.yaml"), job.data(), "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(Json::parse(ended.out)["error_mm"], Json::parse(job.text("out/report.json"))["error_mm"]["after"]);
}

TEST(Report, RebuildsTheSamePage) {
  const SmallJob job;
  ASSERT_EQ(run("demecal", calibrate(job, "out", 1)).code, 0);
  const std::string page = job.text("out/report.html");
  std::filesystem::remove(job.path("out/report.html"));
  EXPECT_EQ(run("demecal", {"report", job.path("out")}).code, 0);
  EXPECT_EQ(page, job.text("out/report.html"));
}

TEST(CommandLine, WrongArgumentsEndWithTen) {
  EXPECT_EQ(run("demecal", {}).code, 10);
  EXPECT_EQ(run("demecal", {"calibrate"}).code, 10);
  EXPECT_EQ(run("demecal", {"calibrate", "job.yaml", "--out", "x", "--workers", "-1"}).code, 10);
  EXPECT_EQ(run("demecal", {"paint"}).code, 10);
  EXPECT_EQ(run("demecal-worker", {"--slots", "0"}).code, 10);
  EXPECT_EQ(run("demecal", {"--help"}).code, 0);
}

TEST(CommandLine, BadInputEndsWithElevenAndOneSentence) {
  const SmallJob job;
  const Ended missing = run("demecal", {"calibrate", job.path("nothing.yaml"), "--out", job.path("out")});
  EXPECT_EQ(missing.code, 11);
  EXPECT_NE(missing.err.find("nothing.yaml"), std::string::npos);
  EXPECT_EQ(std::count(missing.err.begin(), missing.err.end(), '\n'), 1) << missing.err;
  const Ended unwritable = run("demecal", {"calibrate", job.job(), "--out", "/proc/none"});
  EXPECT_EQ(unwritable.code, 11);
}

}  // namespace
}  // namespace demecal
