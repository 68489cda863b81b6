// What `evaluate` says that it does not judge: orientations, and the workspace of an arm that touched one contact
// alone.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

constexpr const char* kWhere =
    "cuboid: {corner_mm: [432, 490, -675], size_mm: [844, 582, 1151], orientation_spread_deg: 60}\n"
    "home: {q1_deg: 35, q2_deg: -35, q3_deg: 150, q4_deg: 0, q5_deg: -60, q6_deg: 0}\n"
    "errors: {tool_mm: [1, 0, 1]}\n";

/// A PUMA 761 measured as the lines `measured` of a scenario say, in the folder `name`.
std::string simulated_data(const SmallJob& job, const std::string& name, const std::string& measured) {
  const std::string scenario = job.path(name + ".yaml");
  std::ofstream(scenario) << "demecal_scenario: 1\nname: small\nseed: 4\nrobot: " DEMECAL_SOURCE_DIR
                             "/configs/robots/puma761.yaml\nposes: {calibration: 40, validation: 20, accept: 0}\n"
                          << kWhere << measured;
  const Ended simulated = run("demecal", {"simulate", scenario, "--out", job.path(name)});
  EXPECT_EQ(simulated.code, 0) << simulated.err;
  return job.path(name + "/dataset.yaml");
}

void fit(const SmallJob& job, const std::string& data, const std::string& declared, const std::string& out) {
  const Ended fitted =
      run("demecal", {"diagnose", data, "--declare", declared, "--max-effects", "0", "--out", job.path(out)});
  ASSERT_EQ(fitted.code, 0) << fitted.err;
}

TEST(Evaluate, PredictsNoErrorOverTheWorkspaceOfAModelOfOneContactAlone) {
  const SmallJob job;
  const std::string touching = "contacts: {play_mm: 0.05, points_mm: {left: [620, 760, -250]";
  const std::string one = simulated_data(job, "one", touching + "}}\n");
  const std::string two = simulated_data(job, "two", touching + ", right: [900, 560, 100]}}\n");
  fit(job, one, "tool,joint_offset", "of-one");
  fit(job, two, "tool,joint_offset", "of-two");
  for (const std::string& data : {one, two}) {
    const Ended of_one = run("demecal", {"evaluate", job.path("of-one/model.yaml"), data});
    ASSERT_EQ(of_one.code, 0) << of_one.err;
    EXPECT_EQ(of_one.out.find("predicted to be off"), std::string::npos) << of_one.out;
    const Ended of_two = run("demecal", {"evaluate", job.path("of-two/model.yaml"), data});
    EXPECT_NE(of_two.out.find("predicted to be off"), std::string::npos) << of_two.out;
    EXPECT_EQ(of_two.out.find("All calibration poses touch one contact"), std::string::npos) << of_two.out;
    EXPECT_NE(of_one.out.find("All calibration poses touch one contact"), std::string::npos) << of_one.out;
  }
}

TEST(Evaluate, SaysThatMeasuredOrientationsAreNotJudged) {
  const SmallJob job;
  for (const bool turned : {false, true}) {
    const std::string data = simulated_data(
        job, turned ? "turned" : "points",
        std::string("measurement: {noise_mm: 0.05") + (turned ? ", orientation_noise_deg: 0.01}\n" : "}\n"));
    fit(job, data, "registration,tool", turned ? "of-turned" : "of-points");
    const Ended judged = run(
        "demecal", {"evaluate", job.path(turned ? "of-turned/model.yaml" : "of-points/model.yaml"), data, "--json"});
    ASSERT_EQ(judged.code, 0) << judged.err;
    const nlohmann::json key = nlohmann::json::parse(judged.out).at("orientations_judged");
    EXPECT_EQ(key, turned ? nlohmann::json(false) : nlohmann::json());
    EXPECT_EQ(judged.err.find("orientations are not judged") != std::string::npos, turned);
  }
}

}  // namespace
}  // namespace demecal
