// demecal prepare: raw measurements in, a data set out that the other commands take, and nothing where something is
// wrong.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using Json = nlohmann::json;

const std::string kShipped = std::string(DEMECAL_SOURCE_DIR) + "/configs/preparation/puma761-cords.yaml";

Ended prepare(const std::string& file, const std::string& out, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"prepare", file, "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run("demecal", arguments);
}

TEST(Prepare, LeadsToADataSetThatIsDiagnosedAndEvaluated) {
  const SmallJob job;
  const Ended prepared = prepare(kShipped, job.path("prepared"));
  ASSERT_EQ(prepared.code, 0) << prepared.err;
  EXPECT_NE(prepared.out.find("three-point frame"), std::string::npos) << prepared.out;
  EXPECT_EQ(prepared.err, "");
  for (const char* file :
       {"dataset.yaml", "poses.csv", "robot.yaml", "corrected.v2", "corrected-validation.v2", "errors.csv"}) {
    EXPECT_FALSE(job.text(std::string("prepared/") + file).empty()) << file;
  }
  const Ended diagnosed =
      run("demecal", {"diagnose", job.path("prepared/dataset.yaml"), "--declare", "registration,joint_offset",
                      "--candidates", "gain", "--out", job.path("model")});
  ASSERT_EQ(diagnosed.code, 0) << diagnosed.err;
  const Ended evaluated =
      run("demecal", {"evaluate", job.path("model/model.yaml"), job.path("prepared/dataset.yaml"), "--json"});
  ASSERT_EQ(evaluated.code, 0) << evaluated.err;
  const Ended json = prepare(kShipped, job.path("again"), {"--json", "--frame", "best_fit"});
  ASSERT_EQ(json.code, 0) << json.err;
  const Json statistic = Json::parse(json.out);
  EXPECT_EQ(statistic["frame"], "best_fit");
  EXPECT_EQ(statistic["sets"]["calibration"]["poses"], 24);
  const Json errors = Json::parse(evaluated.out)["error_mm"]["calibration"];
  EXPECT_LT(errors["rms"], statistic["sets"]["calibration"]["best_fit"]["rms"]);
}

TEST(Prepare, WritesNothingWhereSomethingIsWrong) {
  const SmallJob job;
  std::ofstream(job.path("broken.yaml")) << "# broken\ndemecal_preparation: 1\nrobots: none\n";
  const Ended broken = prepare(job.path("broken.yaml"), job.path("broken"));
  EXPECT_EQ(broken.code, 11);
  EXPECT_NE(broken.err.find("broken.yaml:3: 'robots': is no key; the nearest is 'robot'"), std::string::npos)
      << broken.err;
  EXPECT_FALSE(std::filesystem::exists(job.path("broken")));
  EXPECT_EQ(prepare(kShipped, job.path("frame"), {"--frame", "flange"}).code, 10);
}

}  // namespace
}  // namespace demecal
