// Folders of results through the real programs: what demecal left is written again, what others left never unasked.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

Ended diagnose_into(const SmallJob& job, const std::string& out, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"diagnose", job.data(),      "--out", job.path(out), "--declare", "registration",
                                     "--quiet",  "--max-effects", "0"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run("demecal", arguments);
}

void leave(const SmallJob& job, const std::string& file, const std::string& text) {
  std::filesystem::create_directories(std::filesystem::path(job.path(file)).parent_path());
  std::ofstream(job.path(file)) << text;
}

TEST(ResultFolder, IsWrittenAgainWhereDemecalLeftIt) {
  const SmallJob job;
  std::filesystem::create_directories(job.path("out"));
  leave(job, "out/notes.txt", "mine");
  EXPECT_EQ(diagnose_into(job, "out").code, 0);
  EXPECT_EQ(diagnose_into(job, "out").code, 0);
  EXPECT_EQ(diagnose_into(job, "out", {"--propose", "3"}).code, 0);
  EXPECT_EQ(diagnose_into(job, "out", {"--propose", "3"}).code, 0);
  EXPECT_EQ(job.text("out/notes.txt"), "mine");
  const Ended report = run("demecal", {"report", job.path("out")});
  EXPECT_EQ(report.code, 0) << report.err;
}

TEST(ResultFolder, KeepsFilesOfOthersUnlessForced) {
  const SmallJob job;
  leave(job, "out/report.html", "a page of somebody else's\n");
  leave(job, "out/model.yaml", "colour: red\n");
  const Ended refused = diagnose_into(job, "out");
  EXPECT_EQ(refused.code, 10);
  EXPECT_NE(refused.err.find("model.yaml, report.html are there already"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--force"), std::string::npos);
  EXPECT_EQ(job.text("out/report.html"), "a page of somebody else's\n");
  EXPECT_EQ(job.text("out/report.json"), "");
  EXPECT_EQ(diagnose_into(job, "out", {"--force"}).code, 0);
  EXPECT_EQ(diagnose_into(job, "out").code, 0);
}

TEST(ResultFolder, KeepsWhatWasChangedSinceUnlessForced) {
  const SmallJob job;
  ASSERT_EQ(diagnose_into(job, "out").code, 0);
  const std::string edited = job.text("out/model.yaml") + "# checked by hand\n";
  leave(job, "out/model.yaml", edited);
  const Ended refused = diagnose_into(job, "out");
  EXPECT_EQ(refused.code, 10);
  EXPECT_NE(refused.err.find("model.yaml is there already"), std::string::npos) << refused.err;
  EXPECT_EQ(job.text("out/model.yaml"), edited);
  leave(job, "data/poses.csv", job.text("data/poses.csv") + "\n");
  const Ended data = run("demecal", {"simulate", job.path("scenario.yaml"), "--out", job.path("data")});
  EXPECT_EQ(data.code, 10);
  EXPECT_NE(data.err.find("poses.csv is there already"), std::string::npos) << data.err;
  EXPECT_EQ(run("demecal", {"simulate", job.path("scenario.yaml"), "--out", job.path("data"), "--force"}).code, 0);
  EXPECT_EQ(run("demecal", {"simulate", job.path("scenario.yaml"), "--out", job.path("data")}).code, 0);
  EXPECT_EQ(diagnose_into(job, "out", {"--force"}).code, 0);
}

TEST(ResultFolder, KnowsWhatEarlierVersionsLeftThatKeptNoList) {
  const SmallJob job;
  ASSERT_EQ(diagnose_into(job, "out", {"--propose", "3"}).code, 0);
  std::filesystem::remove(job.path("out/.demecal-files"));
  EXPECT_EQ(run("demecal", {"report", job.path("out")}).code, 0);
  EXPECT_EQ(diagnose_into(job, "out", {"--propose", "3"}).code, 0);
  std::filesystem::remove(job.path("data/.demecal-files"));
  EXPECT_EQ(run("demecal", {"simulate", job.path("scenario.yaml"), "--out", job.path("data")}).code, 0);
}

TEST(ResultFolder, GoesOnAfterARunThatWasKilledOrInterrupted) {
  const SmallJob job(3000, 2);
  const std::vector<std::string> arguments{"calibrate", job.job(), "--out",    job.path("out"),
                                           "--workers", "1",       "--domain", private_domain()};
  for (const int signal : {SIGKILL, SIGINT}) {
    StartedProgram program("demecal", arguments);
    ASSERT_TRUE(program.wait_for_err("generation")) << program.err_so_far();
    program.signal(signal);
    EXPECT_NE(program.wait().code, 10);
  }
  StartedProgram again("demecal", arguments);
  EXPECT_TRUE(again.wait_for_err("generation")) << again.err_so_far();
  again.signal(SIGINT);
  EXPECT_EQ(again.wait().code, 130);
}

}  // namespace
}  // namespace demecal
