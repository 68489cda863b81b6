// demecal study as a process: what it prints and writes, and what it says of a wrong grid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

std::vector<std::string> study(const SmallJob& job, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"study", job.job(), "--out", job.path("out"), "--domain", private_domain()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Study, PrintsATableAndLeavesEveryRun) {
  const SmallJob job(10, 1);
  const Ended ended =
      run("demecal", study(job, {"--set", "gp.population_size=20,40", "--seeds", "2", "--workers", "2"}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  for (const char* expected : {"population_size", "validation mm", "least and the largest", "Blocks", "study.csv"}) {
    EXPECT_THAT(ended.out, HasSubstr(expected));
  }
  EXPECT_THAT(ended.err, HasSubstr("[4/4] gp.population_size 40, seed 4: validation rms"));
  const std::string csv = job.text("out/study.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  const Json json = Json::parse(job.text("out/study.json"));
  EXPECT_EQ(json["interrupted"], false);
  EXPECT_EQ(json["islands"], 4 * 6);
  EXPECT_GT(json["cells"][1]["evaluations"]["median"], json["cells"][0]["evaluations"]["median"]);
  EXPECT_FALSE(json["blocks"].empty());
}

TEST(Study, ComparesEvolutionAndTheClosedLoopAlone) {
  const SmallJob job(10, 1);
  const Ended ended = run(
      "demecal", study(job, {"--set", "method=direct,diagnose", "--closed-loop", "--seeds", "1", "--workers", "2"}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json cells = Json::parse(job.text("out/study.json"))["cells"];
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_GT(cells[0]["evaluations"]["median"], 0);
  EXPECT_EQ(cells[1]["evaluations"]["median"], 0);
}

TEST(Study, InterruptedKeepsWhatItReached) {
  const SmallJob job(200);
  StartedProgram program("demecal", study(job, {"--seeds", "500", "--workers", "2"}));
  ASSERT_TRUE(program.wait_for_err("[2/500]"));
  program.signal(SIGINT);
  const Ended ended = program.wait();
  EXPECT_EQ(ended.code, 130) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("(interrupted)"));
  EXPECT_THAT(ended.out, HasSubstr("What was reached: " + job.path("out") + "/study.csv"));
  const Json json = Json::parse(job.text("out/study.json"));
  EXPECT_GE(json["runs"].size(), 2U);
  EXPECT_LT(json["runs"].size(), 500U);
  EXPECT_EQ(json["interrupted"], true);
}

TEST(Study, RefusesAGridBeforeAnythingIsRun) {
  const SmallJob job;
  const Ended wrong = run("demecal", study(job, {"--set", "gp.population_size=20,many"}));
  EXPECT_EQ(wrong.code, 10);
  EXPECT_THAT(wrong.err, HasSubstr("'many': gp.population_size must be a whole number"));
  std::ofstream(job.path("grid.yaml")) << "demecal_grid: 1\ngp:\n  crossover_rate: [0.5, 2]\n";
  const Ended invalid = run("demecal", study(job, {"--grid", job.path("grid.yaml")}));
  EXPECT_EQ(invalid.code, 11);
  EXPECT_THAT(invalid.err, HasSubstr("grid.yaml:3: '2': gp.crossover_rate must lie within 0 to 1"));
  EXPECT_TRUE(job.text("out/study.csv").empty());
}

}  // namespace
}  // namespace demecal
