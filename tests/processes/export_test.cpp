// demecal export and compare: formulas and tables from models, robots, matrices and jobs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::string kConfigs = std::string(DEMECAL_SOURCE_DIR) + "/configs/";

TEST(Export, WritesAModelInEveryLanguageAndSaysOnWhatItDepends) {
  SmallJob job(20, 2, "  backlash:\n    - {joint: 2, width_rad: 0.002}\n");
  const Ended found = run("demecal", {"diagnose", job.data(), "--declare", "registration", "--candidates",
                                      "joint_offset,backlash", "--out", job.path("out")});
  ASSERT_EQ(found.code, 0) << found.err;
  const std::string model = job.path("out/model.yaml");
  const bool depends = job.text("out/model.yaml").find("kind: backlash") != std::string::npos;
  for (const std::string format : {"text", "c", "python", "matlab"}) {
    const Ended ended = run("demecal", {"export", model, "--format", format, "--out", job.path("arm." + format)});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.out, ::testing::IsEmpty());
    EXPECT_THAT(ended.err, ::testing::IsEmpty());
    EXPECT_EQ(job.text("arm." + format).find("The pose depends also on ") != std::string::npos, depends);
    EXPECT_EQ(run("demecal", {"export", model, "--format", format}).out, job.text("arm." + format));
  }
  EXPECT_THAT(job.text("arm.c"), HasSubstr("void forward(const double q[6], double pose[16])"));
  EXPECT_EQ(run("demecal", {"export", model, "--format", "perl"}).code, 10);
  EXPECT_EQ(run("demecal", {"export", model, "--target", "B"}).code, 11);
  EXPECT_EQ(run("demecal", {"export", model, "--derivative", "7"}).code, 11);
  EXPECT_EQ(run("demecal", {"export", job.job()}).code, 11);
}

TEST(Export, OverwritesNeitherItsInputNorWhatItDidNotWrite) {
  SmallJob job(6);
  const std::string robot = job.path("data/robot.yaml");
  const auto exported_to = [&](const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"export", robot, "--format", "c", "--out", job.path(name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("demecal", arguments);
  };
  const std::string drawn = job.text("data/robot.yaml");
  EXPECT_THAT(run("demecal", {"export", robot}).out, HasSubstr("in the frame of the arm's base as described"));
  const Ended own = exported_to("data/robot.yaml", {"--force"});
  EXPECT_EQ(own.code, 10);
  EXPECT_THAT(own.err, HasSubstr("is the file that was read, which is never overwritten"));
  EXPECT_EQ(job.text("data/robot.yaml"), drawn);
  EXPECT_EQ(exported_to("arm.c").code, 0);
  EXPECT_EQ(exported_to("arm.c").code, 0) << "its own file may be written again";
  const std::string foreign = job.text("job.yaml");
  EXPECT_EQ(exported_to("job.yaml").code, 10);
  EXPECT_EQ(job.text("job.yaml"), foreign);
}

TEST(Arguments, ThatMeanNothingAreNamed) {
  const Ended unknown = run("demecal", {"calibrat"});
  EXPECT_EQ(unknown.code, 10);
  EXPECT_THAT(unknown.err, HasSubstr("'calibrat' is no command; the nearest is 'calibrate'"));
  SmallJob job(6);
  const Ended seed = run("demecal", {"diagnose", job.data(), "--seed", "-5", "--out", job.path("out")});
  EXPECT_EQ(seed.code, 10);
  EXPECT_THAT(seed.err, HasSubstr("--seed: '-5' must be a whole number, 0 or more"));
  EXPECT_EQ(run("demecal", {"calibrate", job.job(), "--resume", job.path("none")}).code, 10);
  const Ended twice = run("demecal", {"diagnose", job.data(), job.data(), "--out", job.path("out")});
  EXPECT_EQ(twice.code, 11);
  EXPECT_THAT(twice.err, HasSubstr("a station is given once"));
}

TEST(Export, WritesRobotsAsDrawnAndMatricesOfTextShortened) {
  const Ended robot = run("demecal", {"export", kConfigs + "robots/puma761.yaml"});
  ASSERT_EQ(robot.code, 0) << robot.err;
  EXPECT_THAT(robot.out, AllOf(HasSubstr("t4 = actual2 + actual3\n"), HasSubstr("t5 = cos(t4)\n")));
  const Ended matrices = run("demecal", {"export", kConfigs + "matrices/puma761.yaml"});
  ASSERT_EQ(matrices.code, 0) << matrices.err;
  EXPECT_THAT(matrices.out, AllOf(HasSubstr("t4 = q2 + q3\n"), HasSubstr("t5 = cos(t4)\n")));
  const Ended slope = run("demecal", {"export", kConfigs + "matrices/puma761.yaml", "--derivative", "6"});
  EXPECT_THAT(slope.out, HasSubstr("pose(1,4) = 0\n"));
}

TEST(Compare, PutsTheBaselinesInOneTableAndItsJson) {
  SmallJob job;
  const Ended table = run("demecal", {"compare", job.job(), "--baselines-only"});
  ASSERT_EQ(table.code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("gain and offset per joint"));
  const Ended ended = run("demecal", {"compare", job.job(), "--baselines-only", "--json", "--out", job.path("cmp")});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json json = Json::parse(ended.out);
  ASSERT_EQ(json["methods"].size(), 8u);
  const double alone = json["methods"][0]["error_mm"]["validation"]["rms"];
  for (const Json& method : json["methods"]) {
    EXPECT_LT(method["error_mm"]["validation"]["rms"], 1.5 * alone) << method;
  }
  EXPECT_EQ(Json::parse(job.text("cmp/comparison.json"))["data_sha256"], json["data_sha256"]);
  EXPECT_EQ(run("demecal", {"compare", job.path("none.yaml"), "--baselines-only"}).code, 11);
}

TEST(Compare, RunsTheJobItselfAndLeavesItsResults) {
  SmallJob job;
  const Ended ended = run("demecal", {"compare", job.job(), "--json", "--max-effects", "0", "--workers", "1", "--out",
                                      job.path("cmp"), "--domain", private_domain()});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json last = Json::parse(ended.out)["methods"].back();
  EXPECT_EQ(last["method"], "demecal");
  EXPECT_GT(last["parameters"], 6);
  const Ended evaluated = run("demecal", {"evaluate", job.path("cmp/model.yaml"), job.data(), "--json"});
  EXPECT_NEAR(Json::parse(evaluated.out)["error_mm"]["validation"]["rms"].get<double>(),
              last["error_mm"]["validation"]["rms"].get<double>(), 1e-9);
}

}  // namespace
}  // namespace demecal
