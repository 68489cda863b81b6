// Few new poses tell whether an arm has changed, and what has; an arm as it was is said to be so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "lacking_numbers.hpp"
#include "parameters/declared_model.hpp"
#include "updating/change.hpp"

namespace demecal {
namespace {

CalibratedModel model_of_seed(std::uint64_t seed) {
  return model_of_wrist(measured_wrist(true_wrist(seed), 60, 30, seed));
}

bool is(const ChangeCause& cause, bool DeclaredModel::*flag) {
  return declared_flag(cause.effect.kind) == flag;
}

TEST(Change, IsHardlyEverFoundInAnArmAsItWas) {
  int changed = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const CalibratedModel model = model_of_seed(seed);
    for (std::uint64_t again = 0; again < 12; ++again)
      changed += find_change(model, measured_wrist(true_wrist(seed), 14, 0, 100 * seed + again)).verdict ==
                         ChangeVerdict::unchanged
                     ? 0
                     : 1;
  }
  EXPECT_LE(changed, 6);  // of 60: beyond it is less likely than 5 % at a rate of 5 %
}

TEST(Change, OfAZeroIsNamedWithItsJointAndSize) {
  int named = 0, cases = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const CalibratedModel model = model_of_seed(seed);
    for (const int joint : {1, 2, 3}) {
      CorrectedRobot now = true_wrist(seed);
      now.chain.joints[static_cast<std::size_t>(joint)].theta_rad += 4e-4;
      const ChangeReport report = find_change(model, measured_wrist(now, 14, 0, 200 + seed));
      ++cases;
      EXPECT_EQ(report.verdict, ChangeVerdict::changed);
      if (report.found.empty()) continue;
      const ChangeCause& first = report.found.front();
      if (!is(first, &DeclaredModel::joint_offset) || first.effect.joint != joint) continue;
      ++named;
      EXPECT_NEAR(first.size, 4e-4, 1.5e-4);
    }
  }
  EXPECT_GE(named, cases - 1);
}

TEST(Change, OfTheBaseAloneIsToldFromOneOfTheRobot) {
  const CalibratedModel model = model_of_seed(1);
  CorrectedRobot now = true_wrist(1);
  now.sensor_from_base.translation() += Eigen::Vector3d(6e-4, -5e-4, 6e-4);
  const ChangeReport moved = find_change(model, measured_wrist(now, 14, 0, 301));
  std::string found;
  for (const ChangeCause& cause : moved.found)
    found += cause.effect.kind + " of joint " + std::to_string(cause.effect.joint + 1) + ", p " +
             std::to_string(cause.p_family) + "; ";
  EXPECT_EQ(moved.verdict, ChangeVerdict::registration) << found << "unnamed: " << moved.unnamed;
  EXPECT_LT(moved.left_m, 0.3 * moved.error_m);
  now.sensor_from_base.translation() += Eigen::Vector3d(0.5, 0.2, 0.1);
  const ChangeReport anew = find_change(model, measured_wrist(now, 14, 0, 302));
  EXPECT_TRUE(anew.set_up_anew);
  EXPECT_EQ(anew.verdict, ChangeVerdict::registration);
}

TEST(Change, IsJudgedByTheNoiseOfTheStationThatMeasured) {
  CalibratedModel model = model_of_seed(6);
  const double fine_m = model.interval->noise_m;
  ASSERT_GT(fine_m, 0.0);
  model.stations = {{"hall", "", Eigen::Isometry3d::Identity()}, {"door", "", Eigen::Isometry3d::Identity()}};
  model.interval->station_noise_m = {{"", fine_m}, {"door", 12.0 * fine_m}};
  model.interval->noise_m = 8.0 * fine_m;
  CorrectedRobot now = true_wrist(6);
  now.chain.joints[2].theta_rad += 4e-4;
  DataSet data = measured_wrist(now, 14, 0, 611);
  const auto report_of = [&](const std::string& name) {
    data.name = name;
    return find_change(model, data);
  };
  const auto says_so = [](const ChangeReport& report) {
    return std::ranges::any_of(report.not_testable, [](const std::string& sentence) {
      return sentence.find("has the name of none") != std::string::npos;
    });
  };
  const ChangeReport of_hall = report_of("hall"), of_door = report_of("door"), of_another = report_of("yard");
  EXPECT_EQ(of_hall.verdict, ChangeVerdict::changed);
  EXPECT_LT(of_hall.noise_m, of_another.noise_m);
  EXPECT_LT(of_another.noise_m, of_door.noise_m);
  EXPECT_FALSE(says_so(of_hall) || says_so(of_door));
  EXPECT_TRUE(says_so(of_another));
}

/// A bent link is nothing that few poses can name; what is like it must not be all that is said.
TEST(Change, OfALinkIsNoMoveOfTheBaseAndNotAllExplained) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const CalibratedModel model = model_of_seed(seed);
    CorrectedRobot now = true_wrist(seed);
    now.sensor_from_base.translation() += Eigen::Vector3d(1.2e-3, -1.4e-3, 1e-3);
    const ChangeReport moved = find_change(model, measured_wrist(now, 20, 0, 500 + seed));
    EXPECT_EQ(moved.verdict, ChangeVerdict::registration) << seed;
    EXPECT_FALSE(moved.more) << seed;
    now.chain.joints[seed % 3 + 1].a_m += 4e-4;
    now.chain.joints[seed % 3 + 2].alpha_rad += 5e-4;
    const ChangeReport bent = find_change(model, measured_wrist(now, 20, 0, 500 + seed));
    EXPECT_EQ(bent.verdict, ChangeVerdict::changed) << seed << ", strain " << bent.strain;
    EXPECT_TRUE(bent.more || bent.unnamed) << seed;
  }
}

TEST(Change, OfTheToolIsNamed) {
  const CalibratedModel model = model_of_seed(2);
  CorrectedRobot now = true_wrist(2);
  now.tools.at("").translation() += Eigen::Vector3d(2e-4, 1e-4, -2e-4);
  const ChangeReport report = find_change(model, measured_wrist(now, 14, 0, 303));
  EXPECT_EQ(report.verdict, ChangeVerdict::changed);
  ASSERT_FALSE(report.found.empty());
  EXPECT_TRUE(is(report.found.front(), &DeclaredModel::tool));
}

void round_joints(DataSet& data, double step_deg) {
  for (MeasuredPose& pose : data.poses)
    for (double& joint : pose.joints) joint = radians(step_deg * std::round(degrees(joint) / step_deg));
}

bool says_rounding(const ChangeReport& report) {
  return std::ranges::any_of(report.not_testable, [](const std::string& sentence) {
    return sentence.starts_with("Joints are written to 0.1 deg only");
  });
}

TEST(Change, IsNotFoundInJointsThatWereRounded) {
  int changed = 0, said = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const CalibratedModel model = model_of_seed(seed);
    for (std::uint64_t again = 0; again < 10; ++again) {
      DataSet data = measured_wrist(true_wrist(seed), 14, 0, 500 + 10 * seed + again);
      round_joints(data, 0.1);
      const ChangeReport report = find_change(model, data);
      changed += report.verdict == ChangeVerdict::unchanged ? 0 : 1;
      said += says_rounding(report) ? 1 : 0;
    }
  }
  EXPECT_LE(changed, 5);  // of 40: beyond it is less likely than 2 % at a rate of 5 %
  EXPECT_EQ(said, 40);
}

TEST(Change, OfARobotWhoseJointsWereRoundedIsStillFoundWhereItIsLarger) {
  const CalibratedModel model = model_of_seed(1);
  CorrectedRobot now = true_wrist(1);
  now.chain.joints[2].theta_rad += 5e-3;
  DataSet data = measured_wrist(now, 14, 0, 551);
  round_joints(data, 0.1);
  const ChangeReport report = find_change(model, data);
  EXPECT_EQ(report.verdict, ChangeVerdict::changed);
  ASSERT_FALSE(report.found.empty());
  EXPECT_EQ(report.found.front().effect.joint, 2);
  EXPECT_TRUE(says_rounding(report));
}

TEST(Change, IsFoundAsUsualWhereJointsWereCommandedInWholeTenthsOfADegree) {
  const CalibratedModel model = model_of_seed(1);
  for (const double turned_rad : {0.0, 4e-4}) {
    CorrectedRobot now = true_wrist(1);
    now.chain.joints[2].theta_rad += turned_rad;
    DataSet data = measured_wrist(now, 14, 0, 552);
    round_joints(data, 0.1);
    RandomStream random{9303};
    for (MeasuredPose& pose : data.poses)
      pose.position_m = now.predict(pose.joints, "").translation() +
                        kMeasured_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    const ChangeReport report = find_change(model, data);
    EXPECT_EQ(report.verdict, turned_rad > 0.0 ? ChangeVerdict::changed : ChangeVerdict::unchanged);
    EXPECT_FALSE(says_rounding(report));
  }
}

TEST(Change, StrainsTheModelBeyondTheLimitAndAnUnchangedArmDoesNot) {
  const CalibratedModel model = model_of_seed(3);
  const ChangeReport same = find_change(model, measured_wrist(true_wrist(3), 14, 0, 304));
  EXPECT_GT(same.strain, 0.4);
  EXPECT_LT(same.strain, same.strain_limit);
  CorrectedRobot now = true_wrist(3);
  now.chain.joints[2].theta_rad += 1e-3;
  const ChangeReport changed = find_change(model, measured_wrist(now, 14, 0, 305));
  EXPECT_GT(changed.strain, changed.strain_limit);
  EXPECT_LT(changed.p_any, 1e-3);
}

/// An arm whose errors the model knows only as its own: every place has its own, and repeats share it.
DataSet measured_uneven_wrist(std::uint64_t seed, int poses, int repeats, std::uint64_t draw) {
  constexpr double kOfPlace_m = 1.5e-4;
  DataSet data = measured_wrist(true_wrist(seed), poses, 0, draw);
  RandomStream random{9302, draw};
  DataSet repeated = data;
  repeated.poses.clear();
  for (MeasuredPose& pose : data.poses) {
    *pose.position_m += kOfPlace_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    for (int i = 0; i < repeats; ++i) {
      MeasuredPose again = pose;
      *again.position_m += kMeasured_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      repeated.poses.push_back(again);
    }
  }
  return repeated;
}

TEST(Change, IsToldByRepeatsOfAPoseNoMoreThanByOne) {
  int changed = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    DataSet learnt = measured_uneven_wrist(seed, 90, 1, seed);
    for (std::size_t i = 60; i < learnt.poses.size(); ++i) learnt.poses[i].set = PoseSet::validation;
    const CalibratedModel model = model_of_wrist(learnt);
    for (std::uint64_t again = 0; again < 8; ++again) {
      const ChangeReport report = find_change(model, measured_uneven_wrist(seed, 12, 5, 400 + 10 * seed + again));
      EXPECT_EQ(report.poses, 12U);
      EXPECT_EQ(report.measurements, 60U);
      changed += report.verdict == ChangeVerdict::unchanged ? 0 : 1;
    }
  }
  EXPECT_LE(changed, 3);  // of 24: beyond it is less likely than 5 % at a rate of 5 %
}

TEST(Change, BetweenPosesThatDifferInWhatTheErrorDependsOnIsNotAveraged) {
  DataSet data = measured_wrist(true_wrist(1), 4, 0, 306);
  for (int i = 0; i < 4; ++i) {
    MeasuredPose other = data.poses[static_cast<std::size_t>(i)];
    if (i == 0) other.payload_kg = 3.0;
    if (i == 1) other.temperature_celsius = 40.0;
    if (i == 2) other.approach = ApproachSigns::Ones(data.robot.chain.size());
    if (i == 3) other.joints[0] += 3e-3;
    data.poses.push_back(other);
  }
  EXPECT_EQ(find_change(model_of_seed(1), data).poses, 8U);
  data.poses.push_back(data.poses.front());
  EXPECT_EQ(find_change(model_of_seed(1), data).poses, 8U);
}

TEST(Change, IsNotNamedWhereItLeavesMostOfLargeErrors) {
  const CalibratedModel model = model_of_seed(4);
  DataSet data = measured_wrist(true_wrist(4), 20, 0, 307);
  for (std::size_t i = 12; i < data.poses.size(); ++i) data.poses[i].joints[5] *= -1.0;
  const ChangeReport report = find_change(model, data);
  EXPECT_EQ(report.verdict, ChangeVerdict::changed);
  EXPECT_TRUE(report.unnamed);
  EXPECT_TRUE(report.found.empty());
  for (const double much : {1e-3, 5e-3, 2e-2}) {
    CorrectedRobot now = true_wrist(4);
    now.chain.joints[3].theta_rad += much;
    const ChangeReport real = find_change(model, measured_wrist(now, 20, 0, 308));
    EXPECT_FALSE(real.unnamed) << much;
    ASSERT_FALSE(real.found.empty());
    EXPECT_EQ(real.found.front().effect.joint, 3);
  }
}

TEST(Change, IsJudgedWithoutPosesThatAreKnownToBeWrong) {
  const CalibratedModel model = model_of_seed(1);
  DataSet data = measured_wrist(true_wrist(1), 12, 0, 309);
  const double error_m = find_change(model, data).error_m;
  data.poses[5].joints[1] += 0.2;
  const ChangeReport report = find_change(model, data, {data.poses[5].pose_id});
  EXPECT_EQ(report.outliers, std::vector<std::size_t>{5});
  EXPECT_NEAR(report.error_m, error_m, 3e-5);
  const DataSet right = measured_wrist(true_wrist(1), 12, 0, 309);
  EXPECT_TRUE(find_change(model, right, {"0", "1", "2", "3"}).outliers.empty()) << "more than a quarter";
}

TEST(Change, CannotBeToldFromThreePoses) {
  EXPECT_THROW(find_change(model_of_seed(1), measured_wrist(true_wrist(1), 3, 0, 1)), InputError);
  DataSet repeated = measured_wrist(true_wrist(1), 3, 0, 1);
  for (int i = 0; i < 3; ++i) repeated.poses.push_back(repeated.poses[static_cast<std::size_t>(i)]);
  EXPECT_THROW(find_change(model_of_seed(1), repeated), InputError);
}

}  // namespace
}  // namespace demecal
