// Calibration on threads of the program itself: the model of a run over DDS, without processes, sockets or DDS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <string>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> calibrate_by(const SmallJob& job, const std::string& workers, const std::string& out) {
  return {"calibrate", job.job(),  "--out",          job.path(out),   "--workers",
          workers,     "--domain", private_domain(), "--max-effects", "0"};
}

TEST(InProcess, EndsWithTheModelOfARunOverDds) {
  const SmallJob job;
  const Ended over_dds = run("demecal", calibrate_by(job, "2", "dds"));
  ASSERT_EQ(over_dds.code, 0) << over_dds.err;
  const std::string model = job.text("dds/model.yaml");
  ASSERT_FALSE(model.empty());
  for (const char* workers : {"in-process", "in-process:1", "in-process:3"}) {
    const Ended ended = run("demecal", calibrate_by(job, workers, "own"));
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("of this process"));
    EXPECT_EQ(job.text("own/model.yaml"), model) << workers;
    EXPECT_FALSE(job.text("own/report.json").empty());
    EXPECT_FALSE(job.text("own/events.jsonl").empty());
  }
}

/// Kinds of the files, sockets among them, that a process has open.
std::string open_files_of(pid_t process) {
  std::string all;
  std::error_code gone;
  const auto folder = "/proc/" + std::to_string(process) + "/fd";
  for (const auto& entry : std::filesystem::directory_iterator(folder, gone))
    all += std::filesystem::read_symlink(entry.path(), gone).string() + "\n";
  return all;
}

TEST(InProcess, StartsNoProcessAndOpensNoSocketAndIsResumed) {
  const SmallJob job(1500);
  ASSERT_EQ(run("demecal", calibrate_by(job, "in-process:2", "calm")).code, 0);
  StartedProgram program("demecal", calibrate_by(job, "in-process:2", "out"));
  ASSERT_TRUE(program.wait_for_err("joined with 2 slots"));
  EXPECT_TRUE(program.children().empty());
  EXPECT_THAT(open_files_of(program.process()), testing::Not(HasSubstr("socket:")));
  program.signal(SIGINT);
  const int code = program.wait().code;
  ASSERT_TRUE(code == 130 || code == 0);
  if (code == 0) return;  // it was faster than the signal
  std::vector<std::string> resumed = calibrate_by(job, "in-process:2", "out");
  resumed[2] = "--resume";
  ASSERT_EQ(run("demecal", resumed).code, 0);
  EXPECT_EQ(job.text("out/model.yaml"), job.text("calm/model.yaml"));
}

TEST(InProcess, RefusesOtherWords) {
  const SmallJob job;
  for (const char* workers :
       {"in-process:0", "in-process:", "in-process:257", "in-processes", "threads", "-1", "257"}) {
    const Ended ended = run("demecal", calibrate_by(job, workers, "out"));
    EXPECT_EQ(ended.code, 10) << workers;
  }
}

}  // namespace
}  // namespace demecal
