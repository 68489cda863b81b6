// Every round and every limit of the closed loop stands in the report's JSON under the promised keys.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "made_up_loop.hpp"

namespace demecal {
namespace {

using Parsed = nlohmann::json;

Parsed written(const Report& report) {
  return Parsed::parse(to_json(report));
}

Parsed written(const LoopOutcome& loop) {
  return written(made_up_looped_report(loop));
}

TEST(LoopJson, HasEveryRoundWithThePromisedKeys) {
  const LoopOutcome loop = made_up_loop(9);
  const Parsed rounds = written(loop)["rounds"];
  ASSERT_EQ(rounds.size(), loop.rounds.size());
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    const Round& round = loop.rounds[i];
    EXPECT_EQ(rounds[i].at("round"), round.number);
    EXPECT_EQ(rounds[i].at("group"), round.group);
    EXPECT_EQ(rounds[i].at("verdict"), to_string(round.verdict));
    EXPECT_EQ(rounds[i].at("effect").at("kind"), round.effect.kind);
    EXPECT_EQ(rounds[i].at("effect").at("joint"), round.effect.joint + 1);
    EXPECT_EQ(rounds[i].at("diagnosis"), round.diagnosis);
    EXPECT_EQ(rounds[i].at("formula"), round.formula);
    EXPECT_EQ(rounds[i].at("reason"), round.reason);
    EXPECT_EQ(rounds[i].at("p_structure"), round.p_structure);
    EXPECT_EQ(rounds[i].at("p_family"), round.p_family);
    EXPECT_EQ(rounds[i].at("fall_nats"), round.gain_nats);
    EXPECT_EQ(rounds[i].at("confirmed"), round.confirmed);
    EXPECT_EQ(rounds[i].at("confirmed_lower"), round.confirmed_lower);
    EXPECT_EQ(rounds[i].at("sign_stability"), round.sign_stability);
    EXPECT_EQ(rounds[i].at("validation_before_mm"), round.validation_before_mm);
    EXPECT_EQ(rounds[i].at("validation_after_mm"), round.validation_after_mm);
    EXPECT_EQ(rounds[i].at("interval").size(), round.interval.size());
    EXPECT_EQ(rounds[i].at("rivals").size(), round.rivals.size());
  }
}

TEST(LoopJson, NamesWhatAnEffectIsMadeOfAndItsRivals) {
  const Parsed rounds = written(made_up_looped_report())["rounds"];
  const Parsed& backlash = rounds[0];
  EXPECT_EQ(backlash["effect"]["parameters"], Parsed({{"width_rad", 4.12e-4}}));
  EXPECT_EQ(backlash["effect"]["standard_errors"], Parsed({{"width_rad", 1.3e-5}}));
  EXPECT_EQ(backlash["interval"]["width_rad"], Parsed({0.9 * 4.12e-4, 1.1 * 4.12e-4}));
  EXPECT_EQ(backlash["rivals"][0]["kind"], "hysteresis");
  EXPECT_EQ(backlash["rivals"][0]["joint"], 2);
  EXPECT_EQ(backlash["rivals"][0]["cosine"], 0.931);
  EXPECT_EQ(backlash["rivals"][0]["nats_behind"], 3.2);
  EXPECT_EQ(backlash["further"]["poses"], 14);
  EXPECT_TRUE(rounds[1]["further"].is_null());
  for (const char* const name : {"ratio", "cosine_rad", "sine_rad"}) {
    EXPECT_TRUE(rounds[1]["effect"]["parameters"].contains(name)) << name;
  }
}

TEST(LoopJson, HasWhatWasNotFoundNotSeenAndNotTrue) {
  const LoopOutcome loop = made_up_loop(5);
  const Parsed json_report = written(loop);
  ASSERT_EQ(json_report["not_found"].size(), loop.not_found.size());
  for (std::size_t i = 0; i < loop.not_found.size(); ++i) {
    const NotFound& missing = loop.not_found[i];
    EXPECT_EQ(json_report["not_found"][i].at("kind"), missing.effect.kind);
    EXPECT_EQ(json_report["not_found"][i].at("smallest_detectable"), missing.smallest_detectable);
    EXPECT_EQ(json_report["not_found"][i].at("unit"), missing.unit);
  }
  EXPECT_TRUE(json_report["not_found"].back().at("joint").is_null()) << "of the whole arm";
  EXPECT_EQ(json_report["not_found"][0].at("joint"), 1);
  ASSERT_EQ(json_report["unseen"].size(), loop.untestable.size());
  EXPECT_EQ(json_report["unseen"][2], Parsed({{"kind", "drift"}, {"reason", "no time column"}}));
  ASSERT_EQ(json_report["decoys"].size(), loop.decoys.size());
  EXPECT_EQ(json_report["decoys"][0]["best_fall_nats"], 1.25);
  EXPECT_EQ(json_report["decoys"][0]["won"], false);
  EXPECT_EQ(json_report["dropped"][0]["parameters"], Parsed({{"ratio", 77.0}}));
}

TEST(LoopJson, HasTheTestsOfTheWholeModel) {
  const Parsed report = written(made_up_looped_report());
  EXPECT_EQ(report["stopped"], "no_gain");
  EXPECT_EQ(report["lack_of_fit_p"], 0.0004);
  EXPECT_EQ(report["explained_share"], 0.873);
  EXPECT_EQ(report["structure_left_p"], 0.42);
  EXPECT_EQ(report["permutations"], 999);
  EXPECT_EQ(report["candidates"], 1312);
}

TEST(LoopJson, HasWhatNoCauseExplains) {
  Report report = made_up_looped_report();
  EXPECT_TRUE(written(report)["unexplained"].is_null());
  report.unexplained = UnexplainedEntry{.error_mm = 0.26, .left_mm = 0.3, .noise_mm = 0.15, .advice = "Measure more."};
  const Parsed unexplained = written(report)["unexplained"];
  EXPECT_EQ(unexplained,
            Parsed({{"error_mm", 0.26}, {"left_mm", 0.3}, {"noise_mm", 0.15}, {"advice", "Measure more."}}));
  const Report back = read_report(to_json(report), "report.json");
  ASSERT_TRUE(back.unexplained);
  EXPECT_EQ(back.unexplained->error_mm, 0.26);
  EXPECT_EQ(back.unexplained->advice, "Measure more.");
}

TEST(LoopJson, SaysThatTheLoopDidNotRun) {
  const Parsed report = written(made_up_report());
  EXPECT_EQ(report["stopped"], "not_run");
  EXPECT_TRUE(report["rounds"].empty() && report["rounds"].is_array());
  EXPECT_TRUE(report["structure_left_p"].is_null());
  EXPECT_TRUE(report["explained_share"].is_null());
}

TEST(LoopJson, WritesNullForNumbersThatDoNotExist) {
  LoopOutcome loop = made_up_loop(5);
  const double none = std::nan("");
  Round& round = loop.rounds[0];
  round.p_family = round.confirmed_lower = round.validation_after_mm = round.rivals[0].cosine = none;
  round.interval[0] = {none, std::numeric_limits<double>::infinity()};
  loop.not_found[0].smallest_detectable = std::numeric_limits<double>::infinity();
  loop.decoys[0].best_gain_nats = none;
  loop.explained_share = none;
  const Parsed json_report = written(loop);
  for (const char* const key : {"p_family", "confirmed_lower", "validation_after_mm"}) {
    EXPECT_TRUE(json_report["rounds"][0][key].is_null()) << key;
  }
  EXPECT_TRUE(json_report["rounds"][0]["rivals"][0]["cosine"].is_null());
  EXPECT_EQ(json_report["rounds"][0]["interval"]["width_rad"], Parsed({nullptr, nullptr}));
  EXPECT_TRUE(json_report["not_found"][0]["smallest_detectable"].is_null());
  EXPECT_TRUE(json_report["decoys"][0]["best_fall_nats"].is_null());
  EXPECT_TRUE(json_report["explained_share"].is_null());
}

TEST(LoopJson, HasARoundThatFoundNothing) {
  LoopOutcome loop = made_up_loop(5);
  loop.rounds.push_back({});
  const Parsed round = written(loop)["rounds"].back();
  EXPECT_EQ(round["verdict"], "none");
  EXPECT_EQ(round["effect"]["kind"], "");
  EXPECT_TRUE(round["effect"]["joint"].is_null());
}

}  // namespace
}  // namespace demecal
