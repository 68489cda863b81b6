// Radii that are to hold 95 % of the errors hold them: on poses that nothing was fitted to, of arms that the model does
// not quite describe.
#include "closed_calibration/calibrated_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/erring_arm.hpp"
#include "closed_calibration/closing.hpp"
#include "fitting/stations.hpp"

namespace demecal {
namespace {

constexpr DeclaredModel kIntervalDeclared{.registration = true, .tool = true, .joint_offset = true};

struct ArmNoise {
  double sigma_m = 5e-5;
  double gross_share = 0.0;
  double gross_m = 0.1;
};

/// Calibration, validation and 60 accept poses of a PUMA with small joint errors that no model declares.
DataSet judged_arm(int calibration, int validation, const ArmNoise& noise, std::uint64_t seed) {
  constexpr int kAccept = 60;
  const std::vector<std::string> errors{"", "0.0001*SIN(2*theta)", "", "0.00015*COS(3*theta)", "", ""};
  const int all = calibration + validation + kAccept;
  DataSet data = measure(true_puma(errors), all, noise.sigma_m, seed, false);
  RandomStream random{seed, 4712};
  for (int i = 0; i < all; ++i) {
    MeasuredPose& pose = data.poses[static_cast<std::size_t>(i)];
    pose.set = i < calibration                ? PoseSet::calibration
               : i < calibration + validation ? PoseSet::validation
                                              : PoseSet::accept;
    if (pose.set != PoseSet::accept && random.real(0.0, 1.0) < noise.gross_share) pose.position_m->x() += noise.gross_m;
  }
  return data;
}

struct IntervalTrial {
  PredictionInterval interval;
  int inside = 0, accept = 0;
  double mean_radius_m = 0.0;
};

struct FittedArm {
  CorrectedRobot robot;
  FittedPosterior fitted;
};

FittedArm fitted_arm(const DataSet& data, const std::vector<std::size_t>& poses) {
  CorrectedRobot robot = fit_declared(data, poses, kIntervalDeclared, nominal_robot(data)).robot;
  FittedPosterior fitted = fitted_posterior(data, kIntervalDeclared, robot, poses);
  return {std::move(robot), std::move(fitted)};
}

/// Fitted to the calibration poses, told by the validation poses.
PredictionInterval told_interval(const DataSet& data, const FittedArm& unseen) {
  return prediction_interval(data, unseen.fitted, unseen.robot);
}
PredictionInterval told_interval(const DataSet& data) {
  return told_interval(data, fitted_arm(data, poses_of(data, PoseSet::calibration)));
}

/// Then fitted to both, where there are any.
IntervalTrial interval_trial(const DataSet& data) {
  const std::vector<std::size_t> calibration = poses_of(data, PoseSet::calibration), last = poses_of_last_fit(data);
  FittedArm arm = fitted_arm(data, calibration);
  IntervalTrial told;
  told.interval = told_interval(data, arm);
  if (last != calibration) arm = fitted_arm(data, last);
  for (const std::size_t pose : poses_of(data, PoseSet::accept)) {
    const double radius_m = radius95_m(told.interval, arm.fitted.posterior, arm.robot, data, data.poses[pose]);
    told.inside += tool_error_m(arm.robot, data, data.poses[pose]) <= radius_m ? 1 : 0;
    told.mean_radius_m += radius_m / 60.0;
    ++told.accept;
  }
  return told;
}

/// Of the accept poses of 40 arms.
double accept_coverage(int calibration, int validation, const ArmNoise& noise, std::uint64_t first_seed) {
  int inside = 0, accept = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + 40; ++seed) {
    const IntervalTrial told = interval_trial(judged_arm(calibration, validation, noise, seed));
    inside += told.inside;
    accept += told.accept;
  }
  return static_cast<double>(inside) / accept;
}

TEST(PredictionInterval, HoldsNinetyFivePercentOfAcceptPoses) {
  const double share = accept_coverage(60, 39, {}, 600);
  RecordProperty("coverage", std::to_string(share));
  EXPECT_GT(share, 0.93);
  EXPECT_LT(share, 0.97);
}

TEST(PredictionInterval, HoldsThemWithFewPosesAndWithoutValidationPoses) {
  const double few = accept_coverage(25, 10, {}, 700), none = accept_coverage(60, 0, {}, 800);
  EXPECT_GT(few, 0.93);
  EXPECT_LT(few, 0.98);
  EXPECT_GT(none, 0.93);
  EXPECT_LT(none, 0.97);
}

TEST(PredictionInterval, IsOfThePosesOwnStation) {
  std::map<std::string, int> inside, accept;
  std::map<std::string, double> radius_m;
  for (std::uint64_t seed = 2200; seed < 2220; ++seed) {
    DataSet fine = judged_arm(60, 39, {.sigma_m = 5e-5}, seed),
            coarse = judged_arm(60, 39, {.sigma_m = 4e-4}, seed + 50);
    fine.name = "fine";
    coarse.name = "coarse";
    fine.sha256 = "of fine";
    coarse.sha256 = "of coarse";
    const DataSet data = joined_stations({fine, coarse}, StationTools::own);
    const std::vector<std::size_t> calibration = poses_of(data, PoseSet::calibration);
    const CorrectedRobot robot = fit_declared(data, calibration, kIntervalDeclared, nominal_robot(data)).robot;
    const FittedPosterior fitted = fitted_posterior(data, kIntervalDeclared, robot, calibration);
    const PredictionInterval interval = prediction_interval(data, fitted, robot);
    for (const std::size_t pose : poses_of(data, PoseSet::accept)) {
      const std::string& station = data.poses[pose].station;
      const double radius = radius95_m(interval, fitted.posterior, robot, data, data.poses[pose]);
      inside[station] += tool_error_m(robot, data, data.poses[pose]) <= radius ? 1 : 0;
      ++accept[station];
      radius_m[station] += radius / 60.0 / 20.0;
    }
  }
  for (const std::string station : {"", "coarse"}) {
    const double share = static_cast<double>(inside[station]) / accept[station];
    EXPECT_GT(share, 0.92) << station;
    EXPECT_LT(share, 0.985) << station;
  }
  EXPECT_LT(radius_m[""], 0.5 * radius_m["coarse"]);
}

TEST(PredictionInterval, IsNotWidenedByGrossErrorsAndCountsThem) {
  const IntervalTrial clean = interval_trial(judged_arm(60, 39, {}, 900)),
                      spoilt = interval_trial(judged_arm(60, 39, {.gross_share = 0.05}, 900));
  EXPECT_EQ(clean.interval.gross_errors, 0U);
  EXPECT_GT(spoilt.interval.gross_errors, 0U);
  EXPECT_LT(spoilt.mean_radius_m, 2.0 * clean.mean_radius_m);
}

TEST(PredictionInterval, CountsWhatTheArmScattersByItselfAsItsErrorAndNotAsNoise) {
  constexpr double kInstrument_m = 3e-5, kJoint_rad = 2e-4;
  for (std::uint64_t seed = 950; seed < 955; ++seed) {
    const DataSet steady = judged_arm(90, 39, {.sigma_m = kInstrument_m}, seed);
    DataSet scattering = steady;
    RandomStream random{seed, 4713};
    for (MeasuredPose& pose : scattering.poses)
      for (double& angle : pose.joints) angle += kJoint_rad * random.normal();
    const PredictionInterval own = told_interval(steady), with = told_interval(scattering);
    EXPECT_LT(own.model_error_m, 0.5 * kJoint_rad) << seed;
    EXPECT_GT(with.model_error_m, kJoint_rad) << seed;  // of levers of a metre
    EXPECT_LT(with.noise_m, 5.0 * kInstrument_m) << seed;
  }
}

TEST(PredictionInterval, TakesNoInstrumentWhoseNoiseGrowsWithTheDistanceForAnArmThatScatters) {
  const Eigen::Vector3d tracker_m(3.0, 1.0, 0.5);
  for (std::uint64_t seed = 960; seed < 965; ++seed) {
    DataSet data = judged_arm(90, 39, {.sigma_m = 0.0}, seed);
    RandomStream random{seed, 4714};
    for (MeasuredPose& pose : data.poses)
      for (double& element : *pose.position_m)
        element += (1.5e-5 + 2e-5 * (*pose.position_m - tracker_m).norm()) * random.normal();
    const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
    const CorrectedRobot robot = fit_declared(data, poses, kIntervalDeclared, nominal_robot(data)).robot;
    EXPECT_EQ(fitted_posterior(data, kIntervalDeclared, robot, poses).arm_scatter_m, 0.0) << seed;
  }
}

/// Root mean square over many arms of how wrong the model is where nothing was measured, over what its posterior lets
/// expect. Measured one after another, errors of 0.05 mm being alike from pose to pose.
double drifting_error_over_expected(const std::optional<NoiseEstimate>& known) {
  constexpr double kCorrelation = 0.9, kDrift_m = 5e-5, kWhite_m = 1e-5;
  double squares_m2 = 0.0, expected_m2 = 0.0;
  for (std::uint64_t seed = 970; seed < 982; ++seed) {
    DataSet data = measure(true_puma({"", "", "", "", "", ""}), 150, 0.0, seed, false);
    RandomStream random{seed, 4715};
    Eigen::Vector3d drift_m = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < data.poses.size(); ++i) {
      MeasuredPose& pose = data.poses[i];
      pose.set = i < 100 ? PoseSet::calibration : PoseSet::accept;
      for (double& axis : drift_m)
        axis = kCorrelation * axis + std::sqrt(1.0 - kCorrelation * kCorrelation) * kDrift_m * random.normal();
      if (pose.set == PoseSet::accept) continue;
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        (*pose.position_m)[axis] += drift_m[axis] + kWhite_m * random.normal();
    }
    const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
    const CorrectedRobot robot = fit_declared(data, poses, kIntervalDeclared, nominal_robot(data)).robot;
    const Posterior posterior = fitted_posterior(data, kIntervalDeclared, robot, poses, known).posterior;
    for (const std::size_t pose : poses_of(data, PoseSet::accept)) {
      squares_m2 += std::pow(tool_error_m(robot, data, data.poses[pose]), 2);
      expected_m2 += posterior_square_m2(posterior, robot, data, data.poses[pose]);
    }
  }
  return std::sqrt(squares_m2 / expected_m2);
}

TEST(FittedPosterior, CountsErrorsThatNeighboursInTimeShare) {
  EXPECT_GT(drifting_error_over_expected(NoiseEstimate{}), 1.5);  // as if they were independent
  EXPECT_LT(drifting_error_over_expected(std::nullopt), 1.3);
}

TEST(PredictionInterval, SaysWhoseErrorsItComesFrom) {
  const PredictionInterval told = told_interval(judged_arm(60, 39, {}, 901)),
                           fitted = told_interval(judged_arm(60, 0, {}, 902));
  EXPECT_FALSE(told.fitted);
  EXPECT_EQ(told.poses, 39U);
  EXPECT_TRUE(fitted.fitted);
  EXPECT_EQ(fitted.poses, 60U);
}

TEST(PredictionInterval, TheRealArmIsNearerThanItsMeasurements) {
  const DataSet data = judged_arm(60, 39, {.sigma_m = 3e-4}, 903);
  const std::vector<std::size_t> calibration = poses_of(data, PoseSet::calibration);
  const CorrectedRobot robot = fit_declared(data, calibration, kIntervalDeclared, nominal_robot(data)).robot;
  const FittedPosterior fitted = fitted_posterior(data, kIntervalDeclared, robot, calibration);
  const PredictionInterval interval = prediction_interval(data, fitted, robot);
  const MeasuredPose& pose = data.poses.back();
  EXPECT_LT(real_radius95_m(interval, fitted.posterior, robot, Stop(pose)),
            0.8 * radius95_m(interval, fitted.posterior, robot, data, pose));
}

/// The last fit takes validation poses in: what they said before is what counts.
TEST(PredictionInterval, IsToldBeforeTheLastFit) {
  const DataSet data = judged_arm(40, 39, {}, 904);
  const std::vector<std::size_t> calibration = poses_of(data, PoseSet::calibration);
  const Fit fit = fit_declared(data, calibration, kIntervalDeclared, nominal_robot(data));
  const DiagnosisProblem of{data, kIntervalDeclared, calibration, {}};
  const DiagnosedModel model = refined(of, diagnosed_model(of, fit), 12);
  Job job;
  job.declared = kIntervalDeclared;
  const std::optional<LastFit> last = last_fit(data, kIntervalDeclared, prepare(data, job), {model, model});
  ASSERT_TRUE(last);
  const PredictionInterval expected =
      prediction_interval(data, fitted_posterior(data, kIntervalDeclared, model.robot, calibration), model.robot);
  EXPECT_EQ(last->unseen.interval.quantile, expected.quantile);
  EXPECT_EQ(last->unseen.interval.noise_m, expected.noise_m);
  EXPECT_FALSE(last->unseen.interval.fitted);
}

}  // namespace
}  // namespace demecal
