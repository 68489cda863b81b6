// Calibrations from a browser: uploaded, run, stopped, fetched and compared over real HTTP.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "program.hpp"
#include "serving.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

TEST(Serve, RunsUploadedJobsToTheSameModelAsCalibrateAndComparesThem) {
  const SmallJob job;
  write_uploads(job);
  ASSERT_EQ(
      run("demecal", {"calibrate", job.path("up/JOB.yaml"), "--out", job.path("alone"), "--workers", "in-process:2"})
          .code,
      0);
  const Serving serving(job.path("jobs"));
  ASSERT_TRUE(serving.url().starts_with("http://127.0.0.1:"));
  upload(serving, job, "first");
  upload(serving, job, "second");
  EXPECT_TRUE(succeeds(serving.post("api/jobs/first/run?tolerance_mm=0.5")));
  EXPECT_TRUE(succeeds(serving.post("api/jobs/second/run")));
  EXPECT_EQ(serving.job("second")["state"], "waiting");
  EXPECT_THAT(serving.post("api/jobs/second/run"), HasSubstr("\n409"));
  ASSERT_TRUE(serving.becomes("second", "done")) << serving.get("api/jobs/second/terminal");
  EXPECT_EQ(serving.job("first")["state"], "done");
  const std::string model = job.text("alone/model.yaml");
  EXPECT_EQ(serving.get("api/jobs/second/results/model.yaml"), model + "\n200");
  EXPECT_EQ(job.text("jobs/local/first/results/model.yaml"), model);
  EXPECT_THAT(serving.get("api/jobs/first/results/report.html"), HasSubstr("<html"));
  EXPECT_THAT(serving.get("api/jobs/first/results/certificate.html"), HasSubstr("<html"));
  EXPECT_THAT(serving.get("api/jobs/first/terminal"), HasSubstr("model.yaml"));
  const std::string text = serving.get("api/comparison");
  const Answered compared = Answered::parse(text.substr(0, text.rfind('\n')));
  ASSERT_EQ(compared["jobs"].size(), 2U);
  const Answered report = Answered::parse(job.text("alone/report.json"));
  for (const Answered& row : compared["jobs"]) {
    for (const char* const set : {"calibration", "validation", "accept"})
      EXPECT_EQ(row["error_mm"]["after"][set]["rms"], report["error_mm"]["after"][set]["rms"]) << set;
  }
  EXPECT_TRUE(succeeds(serving.post("api/jobs/second/remove")));
  EXPECT_FALSE(std::filesystem::exists(job.path("jobs/local/second")));
}

/// Every key of the document, however deep.
void collect_words(const Answered& document, std::set<std::string>& words) {
  for (const auto& item : document.items()) {
    if (document.is_object()) words.insert(item.key());
    if (item.value().is_structured()) collect_words(item.value(), words);
  }
}

TEST(Serve, AnswersInTheKeysOfItsDocument) {
  const SmallJob job;
  write_uploads(job);
  const Serving serving(job.path("jobs"));
  upload(serving, job, "small");
  EXPECT_TRUE(succeeds(serving.post("api/jobs/small/run")));
  ASSERT_TRUE(serving.becomes("small", "done"));
  std::set<std::string> words;
  for (const std::string& text : {serving.get("api/jobs"), serving.get("api/comparison"),
                                  serving.get("api/jobs/small/terminal"), job.text("jobs/local/small/job.json")})
    collect_words(Answered::parse(text.substr(0, text.rfind('\n'))), words);
  EXPECT_GT(words.size(), 25U);
  std::ifstream document(std::string(DEMECAL_SOURCE_DIR) + "/docs/FORMATS.md");
  const std::string page{std::istreambuf_iterator<char>(document), {}};
  const std::size_t begin = page.find("\n## serve\n");
  const std::string section = page.substr(begin, page.find("\n## ", begin + 1) - begin);
  for (const std::string& word : words)
    EXPECT_TRUE(std::regex_search(section, std::regex("[`.{,]" + word + "[`},\\[.]"))) << word;
}

TEST(Serve, StopsARunWithWhatItReachedAndKnowsItsJobsAfterAnEnd) {
  const SmallJob job(200000, 2);
  write_uploads(job);
  {
    Serving serving(job.path("jobs"));
    upload(serving, job, "long");
    upload(serving, job, "next");
    EXPECT_TRUE(succeeds(serving.post("api/jobs/long/run")));
    EXPECT_TRUE(succeeds(serving.post("api/jobs/next/run")));
    ASSERT_TRUE(serving.becomes("long", "running"));
    for (int i = 0; i < 600 && job.text("jobs/local/long/results/run.journal").empty(); ++i) ::usleep(50'000);
    ::usleep(1'000'000);
    EXPECT_TRUE(succeeds(serving.post("api/jobs/long/stop")));
    ASSERT_TRUE(serving.becomes("long", "interrupted")) << serving.job("long");
    EXPECT_TRUE(serving.job("long")["goes_on"]);
    EXPECT_THAT(job.text("jobs/local/long/results/model.yaml"), HasSubstr("demecal_model: 1"));
    // The next runs; a server that ends interrupts it, too.
    ASSERT_TRUE(serving.becomes("next", "running"));
    ::usleep(1'000'000);
    const std::vector<pid_t> children = serving.program().children();
    EXPECT_EQ(children.size(), 1U);
    serving.program().signal(SIGINT);
    EXPECT_EQ(serving.program().wait(std::chrono::seconds(60)).code, 0);
    for (const pid_t child : children) EXPECT_NE(::kill(child, 0), 0);
  }
  const Serving serving(job.path("jobs"));
  EXPECT_EQ(serving.job("long")["state"], "interrupted");
  EXPECT_EQ(serving.job("next")["state"], "interrupted");
  EXPECT_TRUE(succeeds(serving.post("api/jobs/long/run")));
  ASSERT_TRUE(serving.becomes("long", "running"));
  EXPECT_THAT(serving.get("api/jobs/long/terminal"), HasSubstr("interrupted"));  // it goes on below what was said
  EXPECT_TRUE(succeeds(serving.post("api/jobs/long/stop")));
  EXPECT_TRUE(serving.becomes("long", "interrupted"));
}

TEST(Serve, IsUsedInABrowser) {
  const SmallJob job;
  write_uploads(job);
  const Serving serving(job.path("jobs"), {"--tokens", tokens_of(job)});
  StartedProgram node("/usr/bin/node", {std::string(DEMECAL_SOURCE_DIR) + "/tests/browser/jobs_page.mjs", serving.url(),
                                        kAnn, job.path("up")});
  const Ended ended = node.wait(std::chrono::seconds(240));
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Answered seen = Answered::parse(ended.out);
  EXPECT_TRUE(seen["faults"].empty()) << seen["faults"];
  EXPECT_TRUE(seen["elsewhere"].empty()) << seen["elsewhere"];
  EXPECT_EQ(seen["refused"], "nobody has that token");
  EXPECT_THAT(seen["done"]["state"].get<std::string>(), HasSubstr("done, in"));
  EXPECT_THAT(seen["done"]["links"], testing::Contains("report.html"));
  ASSERT_EQ(seen["done"]["compared"].size(), 1U);
  EXPECT_THAT(seen["done"]["compared"][0][3].get<std::string>(), testing::ContainsRegex("[0-9.]+ → 0\\.[0-9]+"));
  EXPECT_THAT(seen["terminal"].get<std::string>(), HasSubstr("model.yaml"));
  EXPECT_THAT(seen["report"].get<std::string>(), HasSubstr("null"));  // its scripts run as of nowhere
  EXPECT_FALSE(seen["wide"]);
  EXPECT_FALSE(seen["phone"]);
  EXPECT_THAT(seen["left"].get<std::string>(), HasSubstr("poses.csv"));
  EXPECT_EQ(seen["removed"], 0);
  EXPECT_TRUE(seen["signed_out"]);
  EXPECT_FALSE(std::filesystem::exists(job.path("jobs/ann/from-the-page")));
}

TEST(Serve, IsAloneInItsFolderWhileItLives) {
  const SmallJob job;
  Serving serving(job.path("jobs"));
  ASSERT_FALSE(serving.url().empty());
  const Ended second = run("demecal", {"serve", "--dir", job.path("jobs"), "--port", "0"});
  EXPECT_EQ(second.code, 11);
  EXPECT_THAT(second.err, HasSubstr("--dir"));
  serving.program().signal(SIGKILL);
  serving.program().wait();
  EXPECT_FALSE(Serving(job.path("jobs")).url().empty());
}

TEST(Serve, SaysWhyARunFailed) {
  const SmallJob job;
  write_uploads(job);
  const Serving serving(job.path("jobs"));
  upload(serving, job, "bad");
  EXPECT_TRUE(succeeds(serving.post("api/jobs/bad/run")));
  ASSERT_TRUE(serving.becomes("bad", "done"));
  EXPECT_FALSE(serving.job("bad")["results"].empty());
  std::ofstream(job.path("bad.csv")) << "a,b\n1,2\n";
  EXPECT_TRUE(succeeds(serving.post("api/jobs/bad/files/poses.csv", "", job.path("bad.csv"))));
  EXPECT_TRUE(succeeds(serving.post("api/jobs/bad/run")));
  ASSERT_TRUE(serving.becomes("bad", "failed"));
  const Answered failed = serving.job("bad");
  EXPECT_EQ(failed["exit_code"], 11);
  EXPECT_THAT(failed["said"].get<std::string>(), HasSubstr("poses.csv"));
  EXPECT_TRUE(failed["results"].empty()) << "of the files before: " << failed["results"];
  EXPECT_TRUE(serving.get("api/jobs/bad/results/model.yaml").ends_with("\n404"));
}

}  // namespace
}  // namespace demecal
