// The report's JSON has the keys that other programs rely on, and the report's figures to the bit.
#include "report/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kinematics/units.hpp"
#include "made_up_loop.hpp"
#include "report/evaluation.hpp"

namespace demecal {
namespace {

using Parsed = nlohmann::json;

void expect_figures(const Parsed& written, const SetErrors& figures) {
  EXPECT_EQ(written.at("mean"), *figures.mean_mm);
  EXPECT_EQ(written.at("rms"), *figures.rms_mm);
  EXPECT_EQ(written.at("p95"), *figures.p95_mm);
  EXPECT_EQ(written.at("max"), *figures.max_mm);
}

TEST(ReportJson, HasEveryPromisedKeyAtTheTop) {
  const Parsed report = Parsed::parse(to_json(made_up_report()));
  for (const char* const key :
       {"demecal_report", "job", "robot", "method", "seed", "data_sha256", "version", "poses", "error_mm",
        "noise_floor_mm", "rounds", "not_found", "stopped", "performance_index_mm2", "joints", "runtime"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["demecal_report"], 1);
  EXPECT_TRUE(report["rounds"].is_array());
  EXPECT_TRUE(report["not_found"].is_array());
}

TEST(ReportJson, HasSharedFunctionsWhereTheyWereAskedFor) {
  EXPECT_FALSE(Parsed::parse(to_json(made_up_report())).contains("shared_functions"));
  const Parsed report = Parsed::parse(to_json(made_up_sharing_report()));
  ASSERT_EQ(report["shared_functions"].size(), 2U);
  EXPECT_EQ(report["shared_functions"][0]["definition"], "F1(c1, c2, a1) = c1 * SIN(a1 + c2)");
  EXPECT_EQ(report["shared_functions"][0]["joints"], (Parsed{1, 3}));
  EXPECT_EQ(report["shared_functions"][1]["joints"], Parsed::array());
  EXPECT_EQ(report["joints"][2]["with_functions"], "F1(0.00061, 1.4, 1.02 * theta)");
  EXPECT_FALSE(report["joints"][1].contains("with_functions"));
}

TEST(ReportJson, HasEveryPromisedKeyBelow) {
  const Parsed report = Parsed::parse(to_json(made_up_report()));
  for (const char* const key : {"calibration", "validation", "accept", "outliers"}) {
    EXPECT_TRUE(report["poses"].contains(key)) << key;
  }
  for (const char* const stage : {"nominal", "registered", "before", "after"}) {
    for (const char* const set : {"calibration", "validation", "accept"}) {
      for (const char* const figure : {"mean", "rms", "p95", "max"}) {
        EXPECT_TRUE(report["error_mm"][stage][set].contains(figure)) << stage << ' ' << set << ' ' << figure;
      }
    }
  }
  for (const char* const key : {"before", "after"}) EXPECT_TRUE(report["performance_index_mm2"].contains(key)) << key;
  for (const char* const key : {"wall_s", "workers", "islands", "generations", "evaluations", "migrations"}) {
    EXPECT_TRUE(report["runtime"].contains(key)) << key;
  }
  ASSERT_EQ(report["joints"].size(), 6u);
  for (const Parsed& joint : report["joints"]) {
    for (const char* const key : {"joint", "expression", "mean_abs_error_rad", "range_rad", "bound_rad"}) {
      EXPECT_TRUE(joint.contains(key)) << key;
    }
    EXPECT_TRUE(joint["mean_abs_error_rad"].contains("before") && joint["mean_abs_error_rad"].contains("after"));
    EXPECT_EQ(joint["range_rad"].size(), 2u);
  }
}

TEST(ReportJson, ReadsBackToTheBit) {
  const Report report = made_up_report();
  const Parsed written = Parsed::parse(to_json(report));
  EXPECT_EQ(written["seed"], *report.seed);
  EXPECT_EQ(written["robot"], report.robot);
  EXPECT_EQ(written["poses"]["calibration"], report.poses.calibration);
  EXPECT_EQ(written["poses"]["outliers"], Parsed(report.poses.outliers));
  expect_figures(written["error_mm"]["nominal"]["calibration"], report.nominal.calibration);
  expect_figures(written["error_mm"]["registered"]["validation"], report.registered.validation);
  expect_figures(written["error_mm"]["declared"]["validation"], report.declared.validation);
  expect_figures(written["error_mm"]["before"]["calibration"], report.before.calibration);
  expect_figures(written["error_mm"]["after"]["validation"], report.after.validation);
  EXPECT_EQ(written["noise_floor_mm"], *report.noise_floor_mm);
  EXPECT_EQ(written["performance_index_mm2"]["after"], *report.performance_index_mm2.after);
  EXPECT_EQ(written["runtime"]["evaluations"], *report.runtime.evaluations);
  for (std::size_t i = 0; i < report.joints.size(); ++i) {
    const Parsed& joint = written["joints"][i];
    EXPECT_EQ(joint["joint"], i + 1);
    EXPECT_EQ(joint["expression"], report.joints[i].expression);
    EXPECT_EQ(joint["mean_abs_error_rad"]["after"], *report.joints[i].mean_abs_error_rad.after);
    EXPECT_EQ(joint["range_rad"], Parsed({report.joints[i].range_rad->lower, report.joints[i].range_rad->upper}));
    EXPECT_EQ(joint["discontinuities_rad"], Parsed(report.joints[i].discontinuities_rad));
  }
}

TEST(ReportJson, WritesParametersInTheUnitsTheirNamesSay) {
  RandomStream random{20240612};
  const std::vector<ParameterEstimate> estimates = made_up_estimates(random);
  Report report;
  for (const ParameterEstimate& estimate : estimates) report.parameters.push_back(parameter_entry(estimate));
  const Parsed written = Parsed::parse(to_json(report));
  ASSERT_EQ(written["parameters"].size(), estimates.size());
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const std::string name = written["parameters"][i]["name"];
    const double border = name.ends_with("_mm") ? millimetres(1.0) : degrees(1.0);
    EXPECT_DOUBLE_EQ(written["parameters"][i]["value"], estimates[i].value * border) << name;
    EXPECT_DOUBLE_EQ(written["parameters"][i]["standard_error"], estimates[i].standard_error * border) << name;
  }
}

TEST(ReportJson, HasAnIntervalOfEveryPoseAndSaysWhereItComesFrom) {
  Report report = made_up_report();
  report.pose_errors = {{"P1", "", "calibration", 0.5, 0.1, 0.3, {"outlier"}}, {"P2", "B", "accept", 0.6, 0.2, 0.4}};
  report.prediction_interval = prediction_entry({.quantile = 1.7, .noise_m = 5e-5, .poses = 12, .fitted = true});
  const Parsed written = Parsed::parse(to_json(report));
  ASSERT_EQ(written["pose_errors"].size(), 2u);
  EXPECT_EQ(written["pose_errors"][0]["flags"], Parsed{"outlier"});
  const Parsed accept = {{"id", "P2"},      {"target", "B"},        {"set", "accept"},         {"before_mm", 0.6},
                         {"after_mm", 0.2}, {"interval95_mm", 0.4}, {"flags", Parsed::array()}};
  EXPECT_EQ(written["pose_errors"][1], accept);
  const std::string remark = written["prediction_interval"]["remark"];
  EXPECT_NE(remark.find("no validation poses"), std::string::npos) << remark;
  EXPECT_NE(remark.find("normal errors are assumed"), std::string::npos) << remark;
  EXPECT_EQ(written["prediction_interval"]["told_by"], "calibration");
}

TEST(ReportJson, WritesNullForFiguresThatDoNotExist) {
  Report report = made_up_report();
  report.noise_floor_mm.reset();
  report.joints[4].bound_rad = std::numeric_limits<double>::infinity();
  const Parsed written = Parsed::parse(to_json(report));
  EXPECT_TRUE(written["error_mm"]["after"]["accept"]["mean"].is_null());
  EXPECT_TRUE(written["noise_floor_mm"].is_null());
  EXPECT_TRUE(written["joints"][4]["bound_rad"].is_null());
}

TEST(ReportJson, ReplacesBytesThatAreNoUtf8) {
  Report report = made_up_report();
  report.robot = "M\xFCller";
  EXPECT_EQ(Parsed::parse(to_json(report))["robot"], "M\xEF\xBF\xBDller");
}

/// A report that has all a report can have, some of it missing.
Report full_report(RandomStream& random) {
  Report report =
      random.chance(0.5) ? made_up_sharing_report() : made_up_looped_report(static_cast<int>(random.index(20)));
  report.data_check = {"suspicious", {{"outlier", random.index(7), {"P1", "P2"}, random.real(), std::nullopt, "P1"}}};
  report.poses.excluded = {{"P9", "validation", random.real()}, {"P8", "accept", std::nullopt}};
  report.pose_errors = {{"P1", "A", "accept", random.real(), random.real(), std::nullopt, {"outlier"}}};
  report.prediction_interval = prediction_entry({.quantile = random.real(), .poses = random.index(40)});
  if (random.chance(0.5)) report.workspace_error = {random.real(), random.real(), random.chance(0.5)};
  report.fitted_sets = {"calibration", "validation"};
  report.unseen_validation_rms_mm = BeforeAfter{random.real(), random.real()};
  report.distal = {{1 + random.index(6), random.index(100), "SIN(theta)", random.real()}};
  report.runtime.waited_share = {{"cell-a", random.real()}, {"cell-b", std::nullopt}};
  for (RoundEntry& round : report.rounds) {
    round.members = {{"geometry", 2}, {"sensor_scale", std::nullopt}};
    if (random.chance(0.3)) round.p_family.reset();
    if (random.chance(0.3)) round.effect.amplitude.reset();
    if (random.chance(0.3)) round.effect.parameters.push_back({"lever_mm", std::nullopt});
    if (random.chance(0.3)) round.interval.push_back({"lever_mm", std::nullopt, random.real()});
  }
  for (NotFoundEntry& missing : report.not_found) {
    if (random.chance(0.5)) missing.sentence = "not testable with these data";
  }
  return report;
}

TEST(ReportJson, IsTheSameWhenReadAndWrittenAgain) {
  RandomStream random{20240613};
  for (int trial = 0; trial < 100; ++trial) {
    const std::string written = to_json(full_report(random));
    EXPECT_EQ(to_json(read_report(written, "report.json")), written);
  }
  const std::string bare = to_json(Report{});
  EXPECT_EQ(to_json(read_report(bare, "report.json")), bare);
}

TEST(ReportJson, ReadsWhatItWroteIntoTheSameMembers) {
  RandomStream random{20240614};
  const Report report = full_report(random), read = read_report(to_json(report), "report.json");
  EXPECT_EQ(read.seed, report.seed);
  EXPECT_EQ(read.poses.near_singular, report.poses.near_singular);
  EXPECT_EQ(read.before.validation.p95_mm, report.before.validation.p95_mm);
  EXPECT_EQ(read.after.accept.mean_mm, std::nullopt);
  EXPECT_EQ(read.unseen_validation_rms_mm->after, report.unseen_validation_rms_mm->after);
  EXPECT_EQ(read.joints[1].range_rad->upper, report.joints[1].range_rad->upper);
  EXPECT_EQ(read.joints[5].note, report.joints[5].note);
  EXPECT_EQ(read.distal->at(0).index_mm2, report.distal->at(0).index_mm2);
  EXPECT_EQ(read.runtime.evaluations, report.runtime.evaluations);
}

}  // namespace
}  // namespace demecal
