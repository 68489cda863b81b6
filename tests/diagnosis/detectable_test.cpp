// What "not found" means: an effect of the stated size would have been found nine times in ten.
#include "diagnosis/detectable.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "residuals/measured_arm.hpp"

namespace demecal {
namespace {

struct DetectingArm {
  KnownArm arm;
  ResidualField field;
  std::vector<Candidate> candidates;
  EffectColumns columns;
  std::vector<double> naming_cost_nats, null_maxima;
};

DetectingArm detecting_arm(RandomStream& stream) {
  DetectingArm tested{arm_of(stream, laden_arm(stream, Arm::standard)), {}, {}, {}, {}, {}};
  measure_anyhow(tested.arm, stream, {.noise_m = 5e-5}, 60);
  tested.field = field_of(tested.arm, kPlacedAndZeroed);
  Evidence evidence = full_evidence(tested.arm.data.robot);
  evidence.highest_ratio = 12;
  const std::vector<std::string> kinds = {"backlash", "compliance", "gear_harmonic", "thermal_offset", "joint_offset"};
  tested.candidates =
      candidates_for(tested.arm.data.robot, evidence, {}, {.kinds = kinds, .formulas = false, .decoys = false});
  std::vector<Effect> effects;
  for (const Candidate& candidate : tested.candidates) {
    effects.push_back(candidate.effect);
    tested.naming_cost_nats.push_back(candidate.naming_cost_nats);
  }
  tested.columns = columns_of(effects, tested.arm.data.robot, tested.field);
  renew_noise(tested.field, stream);
  const Projection model = projection_of(tested.field);
  const Scan scan(tested.columns, tested.naming_cost_nats, tested.field, model);
  tested.null_maxima = scan.null_maxima(tested.columns, tested.field, model, 199, RandomStream{89});
  return tested;
}

std::vector<DetectableCandidate> detectable(const std::vector<Candidate>& candidates,
                                            const std::vector<Score>& scores) {
  std::vector<DetectableCandidate> all;
  for (std::size_t i = 0; i < scores.size(); ++i) all.push_back({candidates[i], scores[i]});
  return all;
}

std::vector<NotFound> not_found(const DetectingArm& tested) {
  const Projection model = projection_of(tested.field);
  const Scan scan(tested.columns, tested.naming_cost_nats, tested.field, model);
  return smallest_detectable(detectable(tested.candidates, scan.scores()), tested.arm.truth, tested.arm.data.robot,
                             {.null_maxima = tested.null_maxima, .family_error = 0.05, .variance = 1.0, .poses = 60});
}

/// The share of trials in which the effect with this first coefficient is found at the family-wise level.
double power(DetectingArm& tested, std::size_t candidate, double size, RandomStream& stream) {
  constexpr int kTrials = 60;
  const double threshold = tested.null_maxima[static_cast<std::size_t>(0.95 * 198)];
  const Eigen::VectorXd signal = size * tested.columns.dense(tested.field, candidate).col(0);
  int found = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    renew_noise(tested.field, stream);
    tested.field.residual += signal;
    const Projection model = projection_of(tested.field);
    const Scan scan(tested.columns, tested.naming_cost_nats, tested.field, model);
    found += scan.scores()[candidate].gain_nats > threshold;
  }
  return static_cast<double>(found) / kTrials;
}

TEST(SmallestDetectable, IsFoundNineTimesInTenAndHalfOfItSeldom) {
  RandomStream stream{89, 1};
  DetectingArm tested = detecting_arm(stream);
  int checked = 0;
  for (const NotFound& each : not_found(tested)) {
    const bool one = each.effect.kind == "backlash" || each.effect.kind == "thermal_offset";
    if (!one || each.effect.joint % 2 == 0) continue;
    const auto same = std::ranges::find_if(
        tested.candidates, [&](const Candidate& candidate) { return candidate.effect.same_law_as(each.effect); });
    const auto index = static_cast<std::size_t>(same - tested.candidates.begin());
    EXPECT_GE(power(tested, index, each.smallest_detectable, stream), 0.75) << each.effect.kind << each.effect.joint;
    EXPECT_LE(power(tested, index, 0.5 * each.smallest_detectable, stream), 0.5)
        << each.effect.kind << each.effect.joint;
    ++checked;
  }
  EXPECT_EQ(checked, 6);
}

TEST(SmallestDetectable, LiesBetweenThoseOfTheSettingsOfItsKindAndJoint) {
  RandomStream stream{89, 2};
  const DetectingArm tested = detecting_arm(stream);
  const Projection model = projection_of(tested.field);
  const std::vector<Score> scores = Scan(tested.columns, tested.naming_cost_nats, tested.field, model).scores();
  for (const NotFound& each : not_found(tested)) {
    if (each.effect.kind != "gear_harmonic") continue;
    EXPECT_EQ(each.unit, "rad");
    double least = 1e300, most = 0.0;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const Effect& effect = tested.candidates[i].effect;
      if (effect.kind != "gear_harmonic" || effect.joint != each.effect.joint) continue;
      std::vector<Score> alone(scores.size());
      alone[i] = scores[i];
      const auto only = smallest_detectable(detectable(tested.candidates, alone), tested.arm.truth,
                                            tested.arm.data.robot, {.null_maxima = tested.null_maxima, .poses = 60});
      ASSERT_EQ(only.size(), 1U);
      least = std::min(least, only.front().smallest_detectable);
      most = std::max(most, only.front().smallest_detectable);
    }
    EXPECT_GE(each.smallest_detectable, 0.98 * least);
    EXPECT_LE(each.smallest_detectable, 1.02 * most);
  }
}

TEST(SmallestDetectable, GrowsWithWhatIsAbsorbedAndWithFewerValidationPoses) {
  RandomStream stream{89, 4};
  const DetectingArm tested = detecting_arm(stream);
  const Projection model = projection_of(tested.field);
  std::vector<DetectableCandidate> candidates =
      detectable(tested.candidates, Scan(tested.columns, tested.naming_cost_nats, tested.field, model).scores());
  const Detection detection{.null_maxima = tested.null_maxima, .poses = 60};
  const auto sizes = [&] {
    return smallest_detectable(candidates, tested.arm.truth, tested.arm.data.robot, detection);
  };
  const std::vector<NotFound> plain = sizes();
  for (DetectableCandidate& one : candidates) one.validation_ratio = 0.2;
  const std::vector<NotFound> validated = sizes();
  for (DetectableCandidate& one : candidates)
    for (const double square : one.score.visible) one.absorbed.push_back({0.7 * square});
  const std::vector<NotFound> absorbed = sizes();
  ASSERT_EQ(plain.size(), validated.size());
  ASSERT_EQ(plain.size(), absorbed.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_GT(validated[i].smallest_detectable, 1.05 * plain[i].smallest_detectable);
    EXPECT_NEAR(absorbed[i].smallest_detectable, validated[i].smallest_detectable / std::sqrt(0.3),
                0.03 * absorbed[i].smallest_detectable);
  }
}

TEST(SmallestDetectable, IsNotStatedForWhatTheModelHoldsOrCannotShow) {
  RandomStream stream{89, 3};
  DetectingArm tested = detecting_arm(stream);
  tested.arm.truth.effects = {{.kind = "backlash", .joint = 3, .settings = {}, .form = "approach"}};
  bool compliance = false;
  for (const NotFound& each : not_found(tested)) {
    EXPECT_NE(each.effect.kind, "joint_offset");  // declared: nothing of it is visible
    EXPECT_FALSE(each.effect.kind == "backlash" && each.effect.joint == 3);
    EXPECT_GT(each.smallest_detectable, 0.0);
    compliance = compliance || (each.effect.kind == "compliance" && each.unit == "rad/Nm");
  }
  EXPECT_TRUE(compliance);
  tested.null_maxima.clear();
  EXPECT_TRUE(not_found(tested).empty());
}

TEST(WhatWasFound, RaisesTheLimitOfItsKindAndJointByWhatHasItsUnit) {
  RandomStream stream{85, 7};
  const Robot robot = laden_arm(stream, Arm::standard);
  Effect taken_back{.kind = "backlash", .joint = 1, .settings = {}, .form = "seated"};
  for (const CoefficientLabel& label : law_of(taken_back).coefficients(taken_back, robot))
    taken_back.values.push_back(label.unit == "rad" ? 1e-3 : 4.0);
  ASSERT_FALSE(taken_back.values.empty());
  std::vector<NotFound> limits{{{.kind = "backlash", .joint = 1}, 2e-4, "rad"},
                               {{.kind = "backlash", .joint = 1}, 2e-3, "rad"},
                               {{.kind = "backlash", .joint = 2}, 2e-4, "rad"},
                               {{.kind = "gain", .joint = 1}, 2e-4, "1"}};
  raise_to_what_was_found({taken_back}, robot, limits);
  EXPECT_DOUBLE_EQ(limits[0].smallest_detectable, 1e-3);
  for (const std::size_t kept : {1u, 2u, 3u})
    EXPECT_DOUBLE_EQ(limits[kept].smallest_detectable, kept == 1 ? 2e-3 : 2e-4);
}

}  // namespace
}  // namespace demecal
