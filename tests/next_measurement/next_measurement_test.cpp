// The measurement that would tell an effect from its rivals: confounded data get the one that truly does, in
// simulation.
#include "next_measurement/next_measurement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "laboratory.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

/// Data that confound two effects, and the measurement that tells them apart.
struct Confusion {
  Laboratory laboratory;
  Effect named, rival;
  std::function<void(Visit&)> at_hand;  ///< what the poses at hand have in common
  /// Adds that many further poses to the data.
  std::function<void(Laboratory&, DataSet&, int)> measure_further;
};

constexpr int kAtHand = 50;

std::vector<Visit> visits_at_hand(Confusion& confusion) {
  std::vector<Visit> visits;
  for (int i = 0; i < kAtHand; ++i) {
    visits.push_back(confusion.laboratory.visit());
    visits.back().time_s = 60.0 * i;
    confusion.at_hand(visits.back());
  }
  return visits;
}

NextMeasurement advice(Confusion& confusion, const std::vector<Visit>& visits) {
  Laboratory& laboratory = confusion.laboratory;
  DataSet data = laboratory.data_set();
  laboratory.measure(data, visits);
  const DiagnosisProblem problem = laboratory.diagnosed(data);
  const DiagnosedModel model = laboratory.model_with(problem, confusion.named);
  const auto further =
      find_next_measurement(problem, model, confusion.named, {{confusion.rival, 1.0, 0.0}}, RandomStream{5, 1});
  return further.value();
}

/// The share of repetitions in which `poses` further ones show the truth beyond all that the rival explains.
double power(Confusion& confusion, const std::vector<Visit>& visits, int poses) {
  constexpr int kRepetitions = 60;
  int told = 0;
  for (int i = 0; i < kRepetitions; ++i) {
    DataSet data = confusion.laboratory.data_set();
    confusion.laboratory.measure(data, visits);
    confusion.measure_further(confusion.laboratory, data, poses);
    told += confusion.laboratory.shown_beyond(data, confusion.named, confusion.rival) > 1.645;
  }
  return told / static_cast<double>(kRepetitions);
}

void expect_told_by_advice(Confusion confusion, const std::string& words) {
  const std::vector<Visit> visits = visits_at_hand(confusion);
  const NextMeasurement further = advice(confusion, visits);
  EXPECT_THAT(further.sentence, HasSubstr(words));
  EXPECT_THAT(further.sentence, HasSubstr("would tell " + to_string(confusion.named) + " from " +
                                          to_string(confusion.rival) + " (power 0.9)"));
  // Of 60 repetitions at 0.9; a third of the information has a power of 0.52, none has 0.05.
  EXPECT_GE(power(confusion, visits, further.poses), 0.78) << further.sentence;
  EXPECT_LE(power(confusion, visits, further.poses / 3), 0.75) << further.sentence;
  EXPECT_LE(power(confusion, visits, 0), 0.2);
}

Effect effect(std::string kind, int joint, std::map<std::string, double> settings, std::vector<double> values,
              std::string form = {}) {
  return {.kind = std::move(kind),
          .joint = joint,
          .settings = std::move(settings),
          .form = std::move(form),
          .formula = {},
          .values = std::move(values)};
}

/// So many more poses, as `change` has them.
auto more_poses(std::function<void(Visit&)> change) {
  return [change](Laboratory& laboratory, DataSet& data, int poses) {
    std::vector<Visit> visits;
    for (int i = 0; i < poses; ++i) {
      visits.push_back(laboratory.visit());
      change(visits.back());
    }
    laboratory.measure(data, visits);
  };
}

/// So many pairs of poses; `change` makes the second of a pair from the first.
auto paired_poses(std::function<void(Visit&)> first, std::function<void(Visit&)> second) {
  return [first, second](Laboratory& laboratory, DataSet& data, int poses) {
    std::vector<Visit> visits;
    for (int i = 0; i < poses; ++i) {
      visits.push_back(laboratory.visit());
      first(visits.back());
      visits.push_back(visits.back());
      second(visits.back());
    }
    laboratory.measure(data, visits);
  };
}

TEST(NextMeasurement, DrawsJointsAtRandomThatMovedTogether) {
  Confusion confusion{Laboratory(laden_puma({-120, -30, 45, 135}), 31),
                      effect("coupling", 2, {{"from", 2}}, {8e-5}, "linear"),
                      effect("gain", 2, {}, {}),
                      {},
                      {}};
  confusion.laboratory.scenario.couplings = {{2, 1, 8e-5, 0.0, 0.0}};
  confusion.at_hand = [](Visit& visit) { visit.commanded[2] = visit.commanded[1] + radians(165.0); };
  confusion.measure_further = more_poses([](Visit&) {});
  expect_told_by_advice(std::move(confusion), "more poses at joints drawn at random");
}

TEST(NextMeasurement, ComesFromBothSidesOfAJointWhoseNeighbourAlwaysCameAlong) {
  Confusion confusion{Laboratory(laden_puma({-120, -30, 45, 135}), 32),
                      effect("backlash", 1, {}, {6e-5}, "approach"),
                      effect("backlash", 1, {{"from", 3}}, {}, "coupled"),
                      {},
                      {}};
  confusion.laboratory.scenario.backlash = {{1, 6e-5}};
  confusion.at_hand = [](Visit& visit) { visit.approach[2] = visit.approach[1]; };
  confusion.measure_further = paired_poses(confusion.at_hand, [](Visit& visit) { visit.approach[1] *= -1.0; });
  expect_told_by_advice(std::move(confusion), "poses approached from both sides of joint 2");
}

TEST(NextMeasurement, LoadsAnArmWhoseTorqueNeverChanged) {
  Confusion confusion{Laboratory(laden_puma({-70, -66, 86, 90}, 0.05), 33),
                      effect("hysteresis", 1, {}, {0.0, 1.2e-6}),
                      effect("backlash", 1, {}, {}, "approach"),
                      {},
                      {}};
  confusion.laboratory.scenario.hysteresis = {{1, 1.2e-12, 1e6}};
  confusion.at_hand = [](Visit&) {};
  confusion.measure_further = paired_poses(confusion.at_hand, [](Visit& visit) { visit.payload_kg = 2.0; });
  expect_told_by_advice(std::move(confusion), "poses measured both without and with a payload of 2 kg");
}

TEST(NextMeasurement, HoldsAnEffectAgainstTheRestOfARivalThatContainsIt) {
  Confusion confusion{Laboratory(laden_puma({-70, -66, 86, 90}, 0.05), 38),
                      effect("backlash", 1, {}, {5e-5}, "approach"),
                      effect("hysteresis", 1, {}, {}),
                      [](Visit&) {},
                      {}};
  confusion.laboratory.scenario.backlash = {{1, 5e-5}};
  const NextMeasurement further = advice(confusion, visits_at_hand(confusion));
  EXPECT_THAT(further.sentence, HasSubstr("payload of 2 kg would tell backlash of joint 2 from hysteresis of joint 2"));
  EXPECT_GT(further.poses, 0);
}

TEST(NextMeasurement, LoadsAnArmToTellWeightFromTheAngleItHangsOn) {
  Confusion confusion{Laboratory(laden_puma({-150, -20, 88, 91}), 34),
                      effect("compliance", 1, {}, {1.2e-6}, "masses"),
                      effect("eccentricity", 1, {{"order", 1}}, {}),
                      {},
                      {}};
  confusion.laboratory.scenario.compliance = {{1, 1.2e-6}};
  confusion.at_hand = [](Visit&) {};
  confusion.measure_further = paired_poses(confusion.at_hand, [](Visit& visit) { visit.payload_kg = 2.0; });
  expect_told_by_advice(std::move(confusion), "poses measured both without and with a payload of 2 kg");
}

TEST(NextMeasurement, WidensTheRangeOfAJointThatHardlyMoved) {
  Confusion confusion{Laboratory(laden_puma({-150, -20, 45, 200}), 35),
                      effect("gain", 3, {}, {1e-4}),
                      effect("eccentricity", 3, {{"order", 1}}, {}),
                      {},
                      {}};
  confusion.laboratory.scenario.gains = {{3, 1e-4}};
  confusion.at_hand = [](Visit& visit) { visit.commanded[3] *= 0.2; };
  confusion.measure_further = more_poses([](Visit& visit) { visit.commanded[3] *= 266.0 / 60.0; });
  expect_told_by_advice(std::move(confusion), "poses with joint 4 anywhere from ");
}

TEST(NextMeasurement, StepsTheTemperatureThatRoseWithTime) {
  Confusion confusion{Laboratory(laden_puma({-120, -30, 45, 135}), 36),
                      effect("thermal_offset", 0, {{"reference_celsius", 25.0}}, {5e-6}),
                      effect("drift", -1, {{"reference_time_s", 1800.0}}, {}),
                      {},
                      {}};
  Scenario& scenario = confusion.laboratory.scenario;
  scenario.thermal_offsets = {{0, 5e-6}};
  scenario.seconds_per_pose = 60.0;
  scenario.temperature = TemperatureCourse{10.0, 40.0, 40000.0};
  confusion.at_hand = [](Visit&) {};
  confusion.measure_further = [](Laboratory& laboratory, DataSet& data, int poses) {
    std::vector<Visit> visits;
    for (int i = 0; i < poses; ++i) {
      visits.push_back(laboratory.visit());
      visits.back().time_s = 60.0 * (i % kAtHand);
    }
    laboratory.measure(data, visits);
    laboratory.measure(data, visits, 10.0);
  };
  expect_told_by_advice(std::move(confusion), "poses measured both as warm as the present ones and 10 K warmer");
}

TEST(NextMeasurement, SaysThatWhatIsTheSameCannotBeTold) {
  Confusion confusion{Laboratory(laden_puma({-150, -20, 45, 200}), 37),
                      effect("eccentricity", 1, {{"order", 1}}, {1e-4, 2e-4}),
                      effect("gear_harmonic", 1, {{"ratio", 1}}, {}),
                      [](Visit&) {},
                      {}};
  const NextMeasurement further = advice(confusion, visits_at_hand(confusion));
  EXPECT_EQ(further.sentence,
            "eccentricity of joint 2 (order 1) and gear harmonic of joint 2 (ratio 1) are the same thing for any "
            "measurement of this kind");
  EXPECT_EQ(further.poses, 0);
}

TEST(NextMeasurement, SaysThatWhatIsTooSmallCannotBeTold) {
  Confusion confusion{Laboratory(laden_puma({-120, -30, 45, 135}), 39),
                      effect("coupling", 2, {{"from", 2}}, {1e-8}, "linear"),
                      effect("gain", 2, {}, {}),
                      {},
                      {}};
  confusion.at_hand = [](Visit& visit) { visit.commanded[2] = visit.commanded[1] + radians(165.0); };
  const NextMeasurement further = advice(confusion, visits_at_hand(confusion));
  EXPECT_EQ(further.sentence,
            "no practical measurement separates coupling of joint 3 (from joint 2) of this size from gain of joint 3");
  EXPECT_EQ(further.poses, 0);
}

TEST(NextMeasurement, SaysThatWhatIsTheInstrumentsShowsWithoutTheArm) {
  Confusion confusion{Laboratory(laden_puma({-120, -30, 45, 135}), 39),
                      effect("sensor_scale", -1, {}, {1e-9}),
                      effect("gain", 1, {}, {}),
                      [](Visit&) {},
                      {}};
  const NextMeasurement further = advice(confusion, visits_at_hand(confusion));
  EXPECT_TRUE(further.sentence.ends_with(
      "; what is the instrument's shows without the arm, at a length that is known or a point that stands still"))
      << further.sentence;
  EXPECT_TRUE(further.sentence.starts_with("no practical measurement of poses separates sensor scale"))
      << further.sentence;
}

TEST(NextMeasurement, IsForTheHardestOfManyRivals) {
  Laboratory laboratory(laden_puma({-120, -30, 45, 135}), 40);
  laboratory.scenario.couplings = {{2, 1, 8e-5, 0.0, 0.0}};
  DataSet data = laboratory.data_set();
  std::vector<Visit> visits;
  for (int i = 0; i < kAtHand; ++i) {
    visits.push_back(laboratory.visit());
    visits.back().commanded[2] = visits.back().commanded[1] + radians(165.0);
  }
  laboratory.measure(data, visits);
  const DiagnosisProblem problem = laboratory.diagnosed(data);
  const Effect named = effect("coupling", 2, {{"from", 2}}, {8e-5}, "linear");
  const DiagnosedModel model = laboratory.model_with(problem, named);
  const std::vector<Rival> rivals{{effect("gain", 2, {}, {}), 1.0, 0.0},
                                  {effect("compliance", 1, {}, {}, "masses"), 0.95, 1.0},
                                  {effect("eccentricity", 2, {{"order", 1}}, {}), 0.97, 3.0}};
  int hardest = 0;
  for (const Rival& rival : rivals) {
    hardest = std::max(hardest, find_next_measurement(problem, model, named, {rival}, RandomStream{5, 1})->poses);
  }
  const auto all = find_next_measurement(problem, model, named, rivals, RandomStream{5, 1});
  ASSERT_TRUE(all);
  EXPECT_NEAR(all->poses, hardest, 0.25 * hardest);
}

TEST(NextMeasurement, IsNothingWithoutRivalsOrForAnEffectThatDoesNothing) {
  Laboratory laboratory(laden_puma({-120, -30, 45, 135}), 41);
  DataSet data = laboratory.data_set();
  std::vector<Visit> visits;
  for (int i = 0; i < 20; ++i) visits.push_back(laboratory.visit());
  laboratory.measure(data, visits);
  const DiagnosisProblem problem = laboratory.diagnosed(data);
  const DiagnosedModel model = laboratory.model_with(problem, effect("gain", 2, {}, {}));
  const Rival rival{effect("eccentricity", 2, {{"order", 1}}, {}), 1.0, 0.0};
  EXPECT_FALSE(find_next_measurement(problem, model, effect("gain", 2, {}, {1e-4}), {}, RandomStream{1}));
  EXPECT_FALSE(find_next_measurement(problem, model, effect("gain", 2, {}, {0.0}), {rival}, RandomStream{1}));
  EXPECT_TRUE(find_next_measurement(problem, model, effect("gain", 2, {}, {1e-4}), {rival}, RandomStream{1}));
}

TEST(EffectWords, NameUnknownMassesByTheirLinks) {
  Effect bending{.kind = "link_bending", .joint = 0, .settings = {{"keep_6_mx", 1.0}}, .form = "moments"};
  EXPECT_EQ(to_string(bending), "link bending of joint 1 (moments of link 6 along x)");
  bending.settings["keep_7_mx"] = 1.0;
  EXPECT_EQ(to_string(bending), "link bending of joint 1 (moments of links 6 to 7)");
}

}  // namespace
}  // namespace demecal
