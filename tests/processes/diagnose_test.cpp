// The closed loop through the real programs: what no file declares is found, named, and in the model that is left.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using Json = nlohmann::json;

const char* const kBacklash = "  backlash:\n    - {joint: 2, width_rad: 0.001}\n";

std::vector<std::string> diagnose(const SmallJob& job, const std::string& out, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"diagnose", job.data(), "--out", job.path(out)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

Json report_of(const SmallJob& job, const std::string& out) {
  return Json::parse(job.text(out + "/report.json"));
}

bool is_the_backlash(const Json& effect) {
  return effect["kind"] == "backlash" && effect["joint"] == 2;
}

/// Whether a round added backlash of joint 2, or what so few poses cannot tell from it and say so.
bool names_the_backlash(const Json& report) {
  return std::any_of(report["rounds"].begin(), report["rounds"].end(), [](const Json& round) {
    if (round["verdict"] != "added") return false;
    return is_the_backlash(round["effect"]) ||
           std::any_of(round["rivals"].begin(), round["rivals"].end(), is_the_backlash);
  });
}

void expect_evaluate_to_agree(const SmallJob& job, const std::string& out) {
  const Ended ended = run("demecal", {"evaluate", job.path(out + "/model.yaml"), job.data(), "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json evaluated = Json::parse(ended.out), report = report_of(job, out);
  EXPECT_EQ(evaluated["error_mm"], report["error_mm"]["after"]);
  const Json &poses = evaluated["pose_errors"], &reported = report["pose_errors"];
  ASSERT_EQ(poses.size(), reported.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i]["id"], reported[i]["id"]);
    EXPECT_EQ(poses[i]["set"], reported[i]["set"]);
    EXPECT_EQ(poses[i]["after_mm"], reported[i]["after_mm"]);
    ASSERT_TRUE(reported[i]["interval95_mm"].is_number());
    const double radius_mm = reported[i]["interval95_mm"];
    EXPECT_NEAR(poses[i]["interval95_mm"], radius_mm, 1e-4 * radius_mm);  // a model's covariance has six digits
  }
}

TEST(Diagnose, NamesUndeclaredBacklash) {
  const SmallJob job(20, 2, kBacklash);
  const Ended ended = run("demecal", diagnose(job, "out", {"--declare", "registration,joint_corrections"}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("backlash"), std::string::npos) << ended.out;
  const Json report = report_of(job, "out");
  EXPECT_EQ(report["method"], "diagnose");
  EXPECT_NE(report["stopped"], "not_run");
  EXPECT_TRUE(names_the_backlash(report));
  EXPECT_LT(report["error_mm"]["after"]["accept"]["rms"], report["error_mm"]["before"]["accept"]["rms"]);
  EXPECT_FALSE(job.text("out/report.html").empty());
  expect_evaluate_to_agree(job, "out");
}

TEST(Diagnose, TakesUpTheModelThatItLeft) {
  const SmallJob job(20, 2, kBacklash);
  ASSERT_EQ(run("demecal", diagnose(job, "first", {"--declare", "joint_corrections"})).code, 0);
  const Ended again = run("demecal", diagnose(job, "second", {"--model", job.path("first/model.yaml")}));
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_FALSE(names_the_backlash(report_of(job, "second")));
  expect_evaluate_to_agree(job, "second");
}

TEST(Diagnose, IsTheSameEveryTimeAndDoesNotReadTheTruth) {
  const SmallJob job(20, 2, kBacklash);
  ASSERT_EQ(run("demecal", diagnose(job, "with")).code, 0);
  std::filesystem::remove(job.path("data/truth.yaml"));
  ASSERT_EQ(run("demecal", diagnose(job, "without")).code, 0);
  EXPECT_FALSE(job.text("with/model.yaml").empty());
  EXPECT_EQ(job.text("with/model.yaml"), job.text("without/model.yaml"));
}

/// The events of a recorded run that have this word.
std::vector<Json> recorded_events(const SmallJob& job, const std::string& out, const std::string& word) {
  std::vector<Json> events;
  std::istringstream lines(job.text(out + "/events.jsonl"));
  for (std::string line; std::getline(lines, line);) {
    Json event = Json::parse(line);
    if (event.at("event") == word) events.push_back(std::move(event));
  }
  return events;
}

TEST(Diagnose, LeavesARecordOfItsRoundsCausesAndFigures) {
  const SmallJob job(20, 2, kBacklash);
  ASSERT_EQ(run("demecal", diagnose(job, "out", {"--declare", "registration,joint_corrections"})).code, 0);
  const Json report = report_of(job, "out");
  EXPECT_GE(recorded_events(job, "out", "round").size(), report["rounds"].size());
  EXPECT_EQ(recorded_events(job, "out", "cause").size(), report["causes"].size());
  ASSERT_FALSE(report["causes"].empty());
  const std::vector<Json> stages = recorded_events(job, "out", "stage"),
                          figures = recorded_events(job, "out", "final_figures");
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_NEAR(figures[0]["accept_after_mm"], report["error_mm"]["after"]["accept"]["rms"], 1e-9);
  ASSERT_FALSE(stages.empty());
  EXPECT_EQ(stages.back()["stage"], "finished");
  const Ended shown = run("demecal", {"monitor", "--replay", job.path("out"), "--once"});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_NE(shown.out.find(report["causes"][0]["name"]), std::string::npos) << shown.out;

  const Ended again = run("demecal", diagnose(job, "out", {"--prior", job.path("out/model.yaml")}));
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(recorded_events(job, "out", "final_figures").size(), 1U);
}

/// The scenario of the job measured from another place, with that noise; returns the data set.
std::string second_station(const SmallJob& job, const std::string& noise_mm = "0.05") {
  std::string scenario = job.text("scenario.yaml");
  const std::string place = "[1850, -640, 420], rotation_deg: [4, -7, 115]";
  scenario.replace(scenario.find(place), place.size(), "[-900, 1400, 210], rotation_deg: [0, 3, -40]");
  scenario.replace(scenario.find("seed: 5"), 7, "seed: 6");
  scenario.replace(scenario.find("noise_mm: 0.05"), 14, "noise_mm: " + noise_mm);
  std::ofstream(job.path("south.yaml")) << scenario;
  const Ended simulated = run("demecal", {"simulate", job.path("south.yaml"), "--out", job.path("south")});
  if (simulated.code != 0) throw std::runtime_error(simulated.err);
  return job.path("south/dataset.yaml");
}

TEST(Diagnose, LearnsTheDriftOfARobotFromItsEarlierModels) {
  const SmallJob job(20, 2, kBacklash);
  const std::string late = job.path("late/model.yaml"), early = job.path("early/model.yaml");
  ASSERT_EQ(run("demecal", diagnose(job, "late", {"--max-effects", "0"})).code, 0);
  ASSERT_EQ(run("demecal", {"diagnose", second_station(job), "--out", job.path("early"), "--max-effects", "0"}).code,
            0);
  const Ended ended = run("demecal", diagnose(job, "out", {"--prior", late, "--prior", early}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("drifts between two measurements, by its 2 models"), std::string::npos) << ended.out;
  EXPECT_EQ(ended.out.find("0.000e+00"), std::string::npos) << "no joint had a target: " << ended.out;
  EXPECT_EQ(run("demecal", diagnose(job, "refused", {"--prior", late, "--prior", late})).code, 11);
}

TEST(Diagnose, TellsTheNoiseOfEachStation) {
  const SmallJob job;
  const std::vector<std::string> more{second_station(job, "0.2"), "--declare", "registration,tool,joint_corrections",
                                      "--max-effects", "0"};
  const Ended ended = run("demecal", diagnose(job, "out", more));
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json stations = report_of(job, "out")["stations"];
  ASSERT_EQ(stations.size(), 2U);
  EXPECT_NEAR(stations[0]["noise_mm"], 0.05, 0.03);
  EXPECT_NEAR(stations[1]["noise_mm"], 0.2, 0.05);
  EXPECT_TRUE(stations[0]["noise_floor_mm"].is_null()) << "nothing was repeated";
  const std::string words = "scatter about the model by 0.";
  EXPECT_NE(ended.out.find(words), std::string::npos) << ended.out;
  EXPECT_NE(job.text("out/report.html").find(words), std::string::npos);
  EXPECT_NE(job.text("out/report.html").find("weigh by their own scatter"), std::string::npos);
}

TEST(Diagnose, FitsTwoStationsAsOneAndKnowsThemAgain) {
  const SmallJob job(20, 2, kBacklash);
  const std::string south = second_station(job);
  const Ended ended =
      run("demecal", diagnose(job, "out", {south, "--declare", "registration,tool,joint_offset,joint_corrections"}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json report = report_of(job, "out");
  ASSERT_EQ(report["stations"].size(), 2U);
  for (const Json& station : report["stations"]) {
    EXPECT_EQ(station["poses"], 80);
    EXPECT_LT(station["error_mm"]["after"]["accept"]["rms"], 0.25) << station;
  }
  const std::string model = job.path("out/model.yaml");
  const Ended both = run("demecal", {"evaluate", model, job.data(), south, "--json"});
  ASSERT_EQ(both.code, 0) << both.err;
  EXPECT_EQ(Json::parse(both.out)["error_mm"], report["error_mm"]["after"]);
  for (const std::string& data : {job.data(), south}) {
    const Ended one = run("demecal", {"evaluate", model, data, "--json"});
    ASSERT_EQ(one.code, 0) << one.err;
    const double rms_mm = Json::parse(one.out)["error_mm"]["accept"]["rms"];
    const Json& station = report["stations"][data == south ? 1 : 0];
    EXPECT_NEAR(rms_mm, station["error_mm"]["after"]["accept"]["rms"], 1e-6) << data;
    const Ended placed = run("demecal", {"evaluate", model, data, "--refit-base", "--json"});
    for (const Ended& each : {one, placed})
      EXPECT_LT(Json::parse(each.out)["uncertainty"]["expanded_mm"], 1.0) << data << ": a zero of joint 1 is no error";
  }
}

TEST(Evaluate, RefusesTargetsThatTheModelLacks) {
  const SmallJob job(20, 2, kBacklash);
  const Ended ended = run("demecal", diagnose(job, "out", {}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  std::istringstream poses(job.text("data/poses.csv"));
  std::string table, line;
  while (std::getline(poses, line)) table += line + (table.empty() ? ",seen" : ",T9") + '\n';
  std::ofstream(job.path("data/poses.csv")) << table;
  std::string data = job.text("data/dataset.yaml");
  const std::size_t columns = data.find("\ncolumns:\n");
  ASSERT_NE(columns, std::string::npos) << data;
  std::ofstream(job.path("data/dataset.yaml"))
      << data.insert(columns + 10, "  target: seen\n") << "\ntools_mm:\n  T9: [1, 2, 3]\n";
  for (const char* option : {"--refit-base", "--force"}) {
    const Ended asked = run("demecal", {"evaluate", job.path("out/model.yaml"), job.data(), option});
    EXPECT_EQ(asked.code, 11) << option << asked.err;
    EXPECT_NE(asked.err.find("is a target that the model has no tool for"), std::string::npos) << asked.err;
  }
}

TEST(Diagnose, WhatWasFoundInTheDataIsSaidWhereNoModelFitsThemEither) {
  const SmallJob job;
  std::istringstream poses(job.text("data/poses.csv"));
  std::string table, line;
  std::getline(poses, line);
  ASSERT_EQ(line.find("x_mm,y_mm,z_mm,s1"), line.size() - std::string("x_mm,y_mm,z_mm,s1,s2,s3,s4,s5,s6").size())
      << line;
  while (table += line + '\n', std::getline(poses, line)) {
    std::size_t end = line.size();
    for (int column = 0; column < 6; ++column) end = line.rfind(',', end - 1);
    const std::size_t begin = line.rfind(',', end - 1) + 1;
    const double z_mm = std::stod(line.substr(begin, end - begin));
    line.replace(begin, end - begin, std::to_string(25.4 * z_mm));
  }
  std::ofstream(job.path("data/poses.csv")) << table;
  const Ended ended = run("demecal", diagnose(job, "out", {"--force"}));
  ASSERT_EQ(ended.code, 11) << ended.err;
  EXPECT_NE(ended.err.find("what was found in the data"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("no model fits these poses"), std::string::npos) << ended.err;
}

TEST(Diagnose, PrintsItsReportAsJson) {
  const SmallJob job;
  const Ended ended = run("demecal", diagnose(job, "out", {"--json", "--candidates", "backlash"}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(Json::parse(ended.out), report_of(job, "out"));
}

TEST(Diagnose, ProposesPosesInTheDataSetsOwnColumns) {
  const SmallJob job;
  ASSERT_EQ(run("demecal", diagnose(job, "out", {"--propose", "5", "--candidates", "backlash,coupling"})).code, 0);
  std::istringstream table(job.text("out/proposed.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(table, line));
  EXPECT_EQ(line, "pose_id,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,s1,s2,s3,s4,s5,s6");
  int rows = 0;
  while (std::getline(table, line)) {
    ++rows;
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 12) << line;
  }
  EXPECT_EQ(rows, 5);
}

TEST(Diagnose, UnknownWordsEndWithTenAndTheNearestOne) {
  const SmallJob job;
  const Ended declared = run("demecal", diagnose(job, "out", {"--declare", "tool,geometri"}));
  EXPECT_EQ(declared.code, 10);
  EXPECT_NE(declared.err.find("'geometry'"), std::string::npos) << declared.err;
  const Ended candidate = run("demecal", diagnose(job, "out", {"--candidates", "baklash"}));
  EXPECT_EQ(candidate.code, 10);
  EXPECT_NE(candidate.err.find("'backlash'"), std::string::npos) << candidate.err;
  EXPECT_EQ(run("demecal", diagnose(job, "out", {"--model", job.path("none.yaml")})).code, 11);
}

TEST(Diagnose, InterruptedSavesWhatItReached) {
  const SmallJob job(20, 2, kBacklash);
  StartedProgram program("demecal", diagnose(job, "out"));
  while (!std::filesystem::exists(job.path("out"))) std::this_thread::yield();
  program.signal(SIGINT);
  const Ended ended = program.wait(std::chrono::seconds(60));
  EXPECT_EQ(ended.code, 130) << ended.err;
  EXPECT_TRUE(report_of(job, "out")["runtime"]["interrupted"]);
  expect_evaluate_to_agree(job, "out");
}

TEST(Calibrate, ClosesTheLoopAndEvaluateReproducesItsFigures) {
  const SmallJob job(20, 2, kBacklash);
  const auto calibrate = [&](const std::string& out, const std::string& workers) {
    return run("demecal", {"calibrate", job.job(), "--out", job.path(out), "--workers", workers, "--domain",
                           private_domain(), "--max-effects", "5"});
  };
  const Ended ended = calibrate("one", "1");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(names_the_backlash(report_of(job, "one")));
  expect_evaluate_to_agree(job, "one");
  ASSERT_EQ(calibrate("two", "2").code, 0);
  EXPECT_EQ(job.text("one/model.yaml"), job.text("two/model.yaml"));
}

}  // namespace
}  // namespace demecal
