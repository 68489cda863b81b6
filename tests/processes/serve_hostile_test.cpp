// What a hostile or a mistaken user of a server of jobs may try: others' jobs, paths, sizes, numbers, addresses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "program.hpp"
#include "serving.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

TEST(Serve, LeavesEachUserAloneWithTheirJobs) {
  const SmallJob job;
  write_uploads(job);
  const Serving serving(job.path("jobs"), {"--tokens", tokens_of(job)});
  EXPECT_THAT(serving.get("api/jobs"), HasSubstr("\n401"));
  EXPECT_THAT(serving.post("api/jobs/x/make"), HasSubstr("\n401"));
  EXPECT_THAT(serving.get("api/jobs", kAnn + "0"), HasSubstr("\n401"));
  upload(serving, job, "mine", kAnn);
  EXPECT_TRUE(serving.job("mine", kAnn).is_object());
  EXPECT_TRUE(serving.job("mine", kBob).is_null());
  for (const char* const path : {"api/jobs/mine/terminal", "api/jobs/mine/results/model.yaml"})
    EXPECT_THAT(serving.get(path, kBob), HasSubstr("\n404")) << path;
  for (const char* const path :
       {"api/jobs/mine/run", "api/jobs/mine/stop", "api/jobs/mine/remove", "api/jobs/mine/files/a.csv"})
    EXPECT_THAT(serving.post(path, kBob), HasSubstr("\n404")) << path;
  EXPECT_TRUE(std::filesystem::exists(job.path("jobs/ann/mine/input/poses.csv")));
  EXPECT_FALSE(std::filesystem::exists(job.path("jobs/bob")));
}

TEST(Serve, ReachesNothingBeyondTheFolderOfTheJob) {
  const SmallJob job;
  write_uploads(job);
  const Serving serving(job.path("jobs"));
  upload(serving, job, "job");
  std::ofstream(job.path("empty")) << "x";
  for (const char* const path :
       {"api/jobs/../make", "api/jobs/%2e%2e/make", "api/jobs/a%2fb/make", "api/jobs/%2e%2e/run",
        "api/jobs/%2e%2e/stop", "api/jobs/%2e%2e/remove", "api/jobs/%2e%2e/files/x", "api/jobs/nothing/run",
        "api/jobs/job/nothing", "api/jobs/.hidden/make", "api/jobs//make", "api/jobs/job/files/../../x",
        "api/jobs/job/files/..%2fx", "api/jobs/job/files/.x", "api/jobs/job/files/a%00b",
        "api/jobs/job/files/%2fetc%2fpasswd", "api/jobs/job/files/a/b"}) {
    EXPECT_THAT(serving.post(path, "", job.path("empty")), testing::ContainsRegex("\n4[0-9][0-9]")) << path;
  }
  for (const char* const path :
       {"api/jobs/job/results/../input/poses.csv", "api/jobs/job/results/..%2fjob.json",
        "api/jobs/job/results/%2e%2e/job.json", "api/jobs/job/results/run.journal", "api/jobs/../job/terminal"}) {
    EXPECT_THAT(serving.get(path), HasSubstr("\n404")) << path;
  }
  const auto refused = [&](const std::string& name, const std::string& text) {
    std::ofstream(job.path("hostile")) << text;
    return serving.post("api/jobs/job/files/" + name, "", job.path("hostile"));
  };
  EXPECT_THAT(refused("a.yaml", "demecal_job: 1\ndata: /etc/passwd\n"), HasSubstr("a.yaml:2: '/etc/passwd'"));
  EXPECT_THAT(refused("a.yaml", "demecal_job: 1\ndata: ../../../bob/job/input/d.yaml\n"), HasSubstr("\n422"));
  EXPECT_THAT(refused("a.yaml", "a: [[[[" + std::string(100000, '[')), HasSubstr("\n422"));
  EXPECT_THAT(refused("a.yaml", std::string(2 << 20, ' ')), HasSubstr("\n429"));
  // Data that are no YAML by name are not read as YAML, so that what they name needs no check.
  EXPECT_TRUE(succeeds(refused("trap.csv", "demecal_dataset: 1\nrobot: /etc/passwd\n")));
  EXPECT_TRUE(succeeds(refused("JOB.yaml", "demecal_job: 1\ndata: trap.csv\n")));
  EXPECT_THAT(serving.post("api/jobs/job/run"), HasSubstr("must end in .yaml"));
  EXPECT_EQ(serving.job("job")["state"], "ready");
  std::ofstream(job.path("large")) << std::string((16 << 20) + 1, 'x');
  EXPECT_THAT(serving.post("api/jobs/job/files/large.csv", "", job.path("large")), HasSubstr("\n413"));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(job.path("jobs")))
    EXPECT_THAT(entry.path().string(), HasSubstr("jobs/local"));
}

TEST(Serve, KeepsLimits) {
  const SmallJob job;
  const Serving serving(job.path("jobs"));
  for (int i = 0; i < 32; ++i) EXPECT_TRUE(succeeds(serving.post("api/jobs/job" + std::to_string(i) + "/make")));
  EXPECT_THAT(serving.post("api/jobs/one-more/make"), HasSubstr("\n429"));
  for (int i = 0; i < 32; ++i) EXPECT_TRUE(succeeds(serving.post("api/jobs/job0/files/f" + std::to_string(i))));
  EXPECT_THAT(serving.post("api/jobs/job0/files/one-more"), HasSubstr("\n429"));
  EXPECT_TRUE(succeeds(serving.post("api/jobs/job0/files/f7")));  // in place of the old one
  EXPECT_THAT(serving.post("api/jobs/job0/run"), HasSubstr("there is no job"));
}

TEST(Serve, SaysWhatItCannotServe) {
  const SmallJob job;
  const auto refused = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"serve", "--dir", job.path("jobs"), "--port", "0"});
    return run("demecal", more);
  };
  for (const char* const address : {"0.0.0.0", "192.0.2.1", "::"}) {
    const Ended ended = refused({"--listen", address});
    EXPECT_EQ(ended.code, 10) << address;
    EXPECT_THAT(ended.err, HasSubstr("--tokens"));
  }
  EXPECT_EQ(refused({"--listen", "example.org"}).code, 10);
  const std::string tokens = tokens_of(job);
  ::chmod(tokens.c_str(), 0640);
  const Ended open = refused({"--tokens", tokens});
  EXPECT_EQ(open.code, 11);
  EXPECT_THAT(open.err, HasSubstr("chmod 600"));
  EXPECT_THAT(open.err, testing::Not(HasSubstr(kAnn)));
  EXPECT_EQ(refused({"--tokens", job.path("nothing")}).code, 11);
  EXPECT_EQ(run("demecal", {"serve", "--dir", job.job(), "--port", "0"}).code, 11);
  EXPECT_EQ(run("demecal", {"serve"}).code, 10);
}

}  // namespace
}  // namespace demecal
