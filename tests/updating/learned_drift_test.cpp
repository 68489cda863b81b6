// How far a robot drifts, told by its models of several dates: small where it did not, large where it did, and refused
// where the models do not tell it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../errors/complaint.hpp"
#include "lacking_numbers.hpp"
#include "updating/learned_drift.hpp"

namespace demecal {
namespace {

/// Of one wrist whose zeros lie `drift_rad` apart (standard deviation) from one measurement to the next.
std::vector<NamedModel> models_of_dates(double drift_rad, std::uint64_t seed) {
  RandomStream random{8201, seed};
  std::vector<NamedModel> models;
  for (std::uint64_t i = 0; i < 4; ++i) {
    CorrectedRobot then = true_wrist(seed);
    for (Joint& joint : then.chain.joints) joint.theta_rad += drift_rad / std::sqrt(2.0) * random.normal();
    models.push_back(
        {"model" + std::to_string(i) + ".yaml", model_of_wrist(measured_wrist(then, 60, 30, 40 + 10 * seed + i))});
    models.back().model.data_sha256 = std::to_string(i);
  }
  return models;
}

AssumedDrift drift_of(const std::vector<NamedModel>& models, std::uint64_t seed) {
  const DataSet data = measured_wrist(true_wrist(seed), 12, 0, 900 + seed);
  return learned_drift(models, data, poses_of(data, PoseSet::calibration)).drift;
}

TEST(LearnedDrift, IsWhatTheZerosOfARobotDo) {
  constexpr double kDrift_rad = 1e-3;
  const AssumedDrift stated;
  double zeros_rad = 0.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const AssumedDrift learned = drift_of(models_of_dates(kDrift_rad, seed), seed);
    zeros_rad += learned.offset_rad / 3.0;
    EXPECT_LT(learned.length_m, 1.5 * stated.length_m) << seed;
    EXPECT_EQ(learned.ripple_rad, stated.ripple_rad);
    EXPECT_EQ(learned.effect_motion, stated.effect_motion);
  }
  EXPECT_GT(zeros_rad, 0.6 * kDrift_rad);
  EXPECT_LT(zeros_rad, 1.4 * kDrift_rad);
}

TEST(LearnedDrift, IsLessThanUsualOfARobotThatStaysAsItIs) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    EXPECT_LT(drift_of(models_of_dates(0.0, seed), seed).offset_rad, 0.7 * AssumedDrift{}.offset_rad) << seed;
}

TEST(LearnedDrift, IsNotToldByWhatIsNoLaterModelOfTheRobot) {
  std::vector<NamedModel> models = models_of_dates(0.0, 1);
  const auto complaint_of = [&] { return complaint([&] { require_models_of_one_robot(models); }); };
  EXPECT_EQ(complaint_of(), "");
  models[0].model.certificate.texts["date"] = "2026-02-01";
  models[2].model.certificate.texts["date"] = "2026-03-01";
  EXPECT_THAT(complaint_of(), ::testing::HasSubstr("model2.yaml"));
  EXPECT_THAT(complaint_of(), ::testing::HasSubstr("the latest model is to be named first"));
  models[2].model.certificate.texts["date"] = "2026-01-01";
  models[3].model.data_sha256 = models[1].model.data_sha256;
  EXPECT_THAT(complaint_of(), ::testing::HasSubstr("model1.yaml was calibrated from as well"));
  models[3].model.nominal.chain.joints[1].a_m += 0.01;
  EXPECT_THAT(complaint_of(), ::testing::HasSubstr("is another arm"));
  models[3].model.posterior.reset();
  EXPECT_THAT(complaint_of(), ::testing::HasSubstr("no covariance"));
}

}  // namespace
}  // namespace demecal
