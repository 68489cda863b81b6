// Somebody in the domain means harm: the run takes longer, and is the same.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using Json = nlohmann::json;

std::vector<std::string> calibrate_briefly(const SmallJob& job, const std::string& out, int workers) {
  return {"calibrate",      job.job(),       "--out", job.path(out), "--workers", std::to_string(workers), "--domain",
          private_domain(), "--max-effects", "0"};
}

std::size_t count(const std::string& text, const std::string& words) {
  std::size_t found = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
  return found;
}

TEST(Hostile, AFloodOfEveryTopicNeitherChangesNorEndsARun) {
  const SmallJob job(1000);
  ASSERT_EQ(run("demecal", calibrate_briefly(job, "calm", 2)).code, 0);
  StartedProgram intruder("demecal-hostile", {private_domain()});
  ASSERT_TRUE(intruder.wait_for_out("flooding"));
  StartedProgram worker("demecal-worker", {"--domain", private_domain()});
  const Ended ended = run("demecal", calibrate_briefly(job, "flooded", 1));
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_FALSE(intruder.ends_within(std::chrono::milliseconds{0})) << intruder.wait().err;
  EXPECT_FALSE(worker.ends_within(std::chrono::milliseconds{0})) << worker.wait().err;
  EXPECT_EQ(job.text("calm/model.yaml"), job.text("flooded/model.yaml"));
  EXPECT_EQ(Json::parse(job.text("calm/report.json"))["runtime"]["dropped_samples"], 0);
  EXPECT_GT(Json::parse(job.text("flooded/report.json"))["runtime"]["dropped_samples"], 100);
  // Once each: the coordinator and the worker that it started share their standard error.
  const std::size_t by_both = count(ended.err, "rejected a message from intruder: ");
  EXPECT_TRUE(by_both == 1 || by_both == 2) << ended.err;
  EXPECT_EQ(count(worker.err_so_far(), "rejected a message from intruder: "), 1U) << worker.err_so_far();
}

}  // namespace
}  // namespace demecal
