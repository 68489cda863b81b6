// A calibration that was broken off goes on from its journal, and ends with the same model to the byte.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

constexpr int kGenerations = 6000;

Words calibrate_with(const SmallJob& job, const std::string& out, Words more = {}) {
  Words arguments{"calibrate", job.job(),  "--out",          job.path(out),   "--workers",
                  "2",         "--domain", private_domain(), "--max-effects", "0"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

Words resume(const SmallJob& job, const std::string& out, Words more = {}) {
  more.insert(more.end(), {"--resume", job.path(out)});
  return calibrate_with(job, out, std::move(more));
}

/// A calibration whose coordinator was killed when its islands had got on a little.
void leave_unfinished(const SmallJob& job, const std::string& out) {
  StartedProgram coordinator("demecal", calibrate_with(job, out));
  ASSERT_TRUE(coordinator.wait_for_err("generation"));
  coordinator.signal(SIGKILL);
  coordinator.wait();
  ASSERT_FALSE(job.text(out + "/run.journal").empty());
  ASSERT_TRUE(job.text(out + "/model.yaml").empty());
}

std::string calm_model(const SmallJob& job) {
  EXPECT_EQ(run("demecal", calibrate_with(job, "calm")).code, 0);
  return job.text("calm/model.yaml");
}

void goes_on_after_it_was_killed(const SmallJob& job, const std::string& model) {
  const Ended ended = run("demecal", resume(job, "out"));
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("going on from " + job.path("out/run.journal")));
  EXPECT_EQ(job.text("out/model.yaml"), model);
  EXPECT_TRUE(job.text("out/run.journal").empty());
  EXPECT_TRUE(Json::parse(job.text("out/report.json"))["runtime"]["resumed"]);
}

void needs_no_other_folder_and_takes_a_damaged_end(const SmallJob& job, const std::string& model) {
  std::ofstream(job.path("damaged/run.journal"), std::ios::app) << "half a rec";
  const Ended ended = run("demecal", {"calibrate", job.job(), "--resume", job.path("damaged"), "--domain",
                                      private_domain(), "--max-effects", "0"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("damaged record is left out"));
  EXPECT_EQ(job.text("damaged/model.yaml"), model);
}

void goes_on_after_ctrl_c(const SmallJob& job, const std::string& model) {
  StartedProgram coordinator("demecal", calibrate_with(job, "stopped"));
  ASSERT_TRUE(coordinator.wait_for_err("generation"));
  coordinator.signal(SIGINT);
  const Ended interrupted = coordinator.wait();
  ASSERT_EQ(interrupted.code, 130) << interrupted.err;
  EXPECT_THAT(interrupted.out, HasSubstr("--resume " + job.path("stopped")));
  ASSERT_EQ(run("demecal", resume(job, "stopped")).code, 0);
  EXPECT_EQ(job.text("stopped/model.yaml"), model);
}

void goes_on_after_the_disk_was_full(const SmallJob& job, const std::string& model) {
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit full{100'000, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &full);
  const Ended ended = run("demecal", calibrate_with(job, "full", {"--quiet"}));
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(ended.code, 21) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("the run failed: " + job.path("full/run.journal") +
                                   ": the journal cannot be written: File too large"));
  ASSERT_EQ(run("demecal", resume(job, "full")).code, 0);
  EXPECT_EQ(job.text("full/model.yaml"), model);
}

/// One job and one undisturbed run of it for all that may break a run off.
TEST(Resume, EndsWithTheModelOfTheUndisturbedRun) {
  const SmallJob job(kGenerations);
  const std::string model = calm_model(job);
  EXPECT_TRUE(job.text("calm/run.journal").empty());
  ASSERT_NO_FATAL_FAILURE(leave_unfinished(job, "out"));
  std::filesystem::copy(job.path("out"), job.path("damaged"), std::filesystem::copy_options::recursive);
  goes_on_after_it_was_killed(job, model);
  needs_no_other_folder_and_takes_a_damaged_end(job, model);
  goes_on_after_ctrl_c(job, model);
  goes_on_after_the_disk_was_full(job, model);
}

TEST(Resume, RefusesAnotherSeedOrJobAndSaysSo) {
  const SmallJob job(kGenerations);
  leave_unfinished(job, "out");
  const Ended seed = run("demecal", resume(job, "out", {"--seed", "4"}));
  EXPECT_EQ(seed.code, 11);
  EXPECT_THAT(seed.err, HasSubstr("its seed is 3, not 4"));
  const Ended effects = run("demecal", {"calibrate", job.job(), "--resume", job.path("out")});
  EXPECT_EQ(effects.code, 11);
  EXPECT_THAT(effects.err, HasSubstr("an option that overrides it"));
  std::ofstream(job.path("data/dataset.yaml"), std::ios::app) << "# changed\n";
  const Ended data = run("demecal", resume(job, "out"));
  EXPECT_EQ(data.code, 11);
  EXPECT_THAT(data.err, HasSubstr("the data set or the robot have changed"));
  EXPECT_EQ(run("demecal", {"calibrate", job.job(), "--out", job.path("a"), "--resume", job.path("b")}).code, 10);
}

TEST(Resume, BeginsNothingAmongFilesOfOthers) {
  const SmallJob job;
  std::filesystem::create_directory(job.path("notes"));
  std::ofstream(job.path("notes/notes.txt")) << "mine\n";
  const Ended ended = run("demecal", resume(job, "notes"));
  EXPECT_EQ(ended.code, 10) << ended.out;
  EXPECT_THAT(ended.err, HasSubstr("holds files, but no run that was begun there"));
  EXPECT_TRUE(job.text("notes/model.yaml").empty());
}

TEST(Calibrate, OneFolderIsServedByOneCoordinator) {
  const SmallJob job(1000000);
  StartedProgram first("demecal", calibrate_with(job, "out"));
  ASSERT_TRUE(first.wait_for_err("generation"));
  const Ended second = run("demecal", calibrate_with(job, "out"));
  EXPECT_EQ(second.code, 11);
  EXPECT_THAT(second.err, HasSubstr("another demecal"));
}

TEST(Calibrate, AsynchronousSaysThatItsResultDependsOnTiming) {
  const SmallJob job;
  const Ended ended = run("demecal", calibrate_with(job, "out", {"--asynchronous"}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("another run of this job gives another result"));
  EXPECT_TRUE(Json::parse(job.text("out/report.json"))["runtime"]["asynchronous"]);
  ASSERT_EQ(run("demecal", calibrate_with(job, "waits")).code, 0);
  EXPECT_FALSE(Json::parse(job.text("waits/report.json"))["runtime"]["asynchronous"]);
}

TEST(Calibrate, ReportsHowLongEachWorkerWaited) {
  const SmallJob job(200);
  ASSERT_EQ(run("demecal", calibrate_with(job, "out")).code, 0);
  const Json waited = Json::parse(job.text("out/report.json"))["runtime"]["waited_share"];
  ASSERT_GE(waited.size(), 1U);
  for (const Json& worker : waited) {
    EXPECT_FALSE(worker["worker"].get<std::string>().empty());
    EXPECT_GE(worker["share"].get<double>(), 0.0);
    EXPECT_LE(worker["share"].get<double>(), 1.0);
  }
}

}  // namespace
}  // namespace demecal
