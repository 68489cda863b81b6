// Models of several robots of one type: their mean and spread are recovered, a further robot gains by them, and what is
// no fleet is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "../errors/complaint.hpp"
#include "lacking_numbers.hpp"
#include "prediction/measurement.hpp"
#include "updating/fleet_model.hpp"
#include "updating/fleet_numbers.hpp"
#include "updating/update.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

constexpr double kLink2_m = 6e-4;  ///< that the a of link 2 of every robot of the type is longer than drawn
constexpr double kOffsetSpread_rad = 1e-3;

/// Zeros are a robot's own; lengths are those of the type within a few micrometres.
CorrectedRobot robot_of_type(RandomStream& random) {
  CorrectedRobot robot = true_wrist(77);
  const Chain drawn = wrist_robot().chain;
  for (std::size_t i = 0; i < drawn.joints.size(); ++i) {
    Joint& joint = robot.chain.joints[i];
    joint = drawn.joints[i];
    joint.theta_rad += kOffsetSpread_rad * random.normal();
    joint.a_m += 3e-6 * random.normal() + (i == 1 ? kLink2_m : 0.0);
  }
  return robot;
}

std::vector<NamedModel> models_of_type(int robots, RandomStream& random) {
  std::vector<NamedModel> models;
  for (int i = 0; i < robots; ++i) {
    const auto seed = static_cast<std::uint64_t>(700 + i);
    models.push_back(
        {"robot" + std::to_string(i) + ".yaml", model_of_wrist(measured_wrist(robot_of_type(random), 60, 30, seed))});
    models.back().model.data_sha256 = std::to_string(i);
  }
  return models;
}

const FleetNumber& number(const CalibratedModel& fleet, const std::string& name) {
  const auto found = std::ranges::find(fleet.fleet->numbers, name, &FleetNumber::name);
  if (found == fleet.fleet->numbers.end()) throw std::runtime_error(name);
  return *found;
}

TEST(TypeSpread, IsTheMeanAndSpreadOfNumbersThatAreKnownWell) {
  RandomStream random{8101};
  std::vector<KnownNumbers> robots;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero(), squares = sum;
  constexpr int kRobots = 40;
  for (int i = 0; i < kRobots; ++i) {
    const Eigen::Vector2d own(0.5 + 0.3 * random.normal(), -0.2 + 1.0 * random.normal());
    sum += own;
    squares += own.cwiseAbs2();
    robots.push_back({1e8 * Eigen::MatrixXd::Identity(2, 2), 1e8 * own});
  }
  const std::vector<int> groups{0, 1};
  const TypeSpread type = type_spread(robots, groups, Eigen::Vector2d::Constant(1e-9));
  for (int k = 0; k < 2; ++k) {
    const double mean = sum[k] / kRobots;
    EXPECT_NEAR(type.mean[k], mean, 1e-3);
    EXPECT_NEAR(type.spread[k], std::sqrt((squares[k] - kRobots * mean * mean) / (kRobots - 1)), 0.02 * type.spread[k]);
  }
}

TEST(TypeSpread, IsNotTakenForTheNoiseOfTheRobotsModels) {
  RandomStream random{8102};
  std::vector<KnownNumbers> robots;
  for (int i = 0; i < 60; ++i) {
    const double noise = 2.0, own = 0.2 * random.normal() + noise * random.normal();
    robots.push_back(
        {Eigen::MatrixXd::Constant(1, 1, 1 / (noise * noise)), Eigen::VectorXd::Constant(1, own / (noise * noise))});
  }
  const std::vector<int> groups{0};
  EXPECT_LT(type_spread(robots, groups, Eigen::VectorXd::Constant(1, 1e-9)).spread[0], 1.0);
}

TEST(Fleet, HasTheMeanAndTheSpreadOfItsRobots) {
  RandomStream random{8103};
  const CalibratedModel fleet = fleet_model(models_of_type(6, random));
  const double drawn_m = wrist_robot().chain.joints[1].a_m;
  EXPECT_NEAR(number(fleet, "joint 2 a_mm").mean, 1e3 * (drawn_m + kLink2_m), 0.03);
  EXPECT_LT(number(fleet, "joint 2 a_mm").spread, 0.05);
  double squares = 0.0;
  for (const int joint : {2, 3, 4, 5})
    squares +=
        std::pow(number(fleet, "joint " + std::to_string(joint) + " theta_deg").spread * std::numbers::pi / 180.0,
                 2.0) /
        4.0;
  EXPECT_GT(std::sqrt(squares), 0.5 * kOffsetSpread_rad);
  EXPECT_LT(std::sqrt(squares), 2.0 * kOffsetSpread_rad);
}

TEST(Fleet, MakesFewPosesOfAFurtherRobotTellMore) {
  RandomStream random{8104};
  const CalibratedModel fleet = fleet_model(models_of_type(5, random));
  double with = 0.0, without = 0.0;
  for (std::uint64_t i = 0; i < 4; ++i) {
    const DataSet data = measured_wrist(robot_of_type(random), 10, 60, 800 + i);
    const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
    const CorrectedRobot placed =
        fit_registration(data, poses, {.registration = true, .tool = true}, fleet.robot).robot;
    const auto error_mm = [&](const CorrectedRobot& robot) {
      return error_figures(robot, data, poses_of(data, PoseSet::validation)).rms_mm;
    };
    with += error_mm(updated(fleet, placed, data, poses, fleet.declared).robot);
    without += error_mm(fit_declared(data, poses, fleet.declared, nominal_robot(data)).robot);
  }
  EXPECT_LT(with, 0.6 * without);
}

TEST(Fleet, IsNoModelOfOneRobot) {
  RandomStream random{8109};
  const std::vector<NamedModel> models = models_of_type(2, random);
  require_one_robot(models[0].model, "model.yaml", "check");
  EXPECT_THAT(complaint([&] { require_one_robot(fleet_model(models), "fleet.yaml", "check"); }),
              HasSubstr("is the mean of several robots, and check needs the model of one"));
}

TEST(Fleet, AveragesCorrectionsAndCountsAModelWithoutOneAsZero) {
  RandomStream random{8105};
  std::vector<NamedModel> models = models_of_type(2, random);
  const Tree sine = apply(Primitive::multiply, constant_tree(1e-3), apply(Primitive::sine, variable_tree(0)));
  models[0].model.robot.corrections[2] = JointCorrection(sine, {}, {-2.0, 2.0});
  const CalibratedModel fleet = fleet_model(models);
  for (const double theta : {-1.5, 0.0, 0.7, 1.9})
    EXPECT_NEAR(fleet.robot.corrections[2](theta), 0.5e-3 * std::sin(theta), 1e-9);
  ASSERT_EQ(fleet.fleet->curves.size(), 1u);
  EXPECT_EQ(fleet.fleet->curves[0].joint, 2);
  EXPECT_GT(fleet.fleet->curves[0].wave_deviations_rad[0], 2e-4);
}

TEST(Fleet, UnitesEffectsAndCountsAModelWithoutOneAsZero) {
  RandomStream random{8106};
  std::vector<NamedModel> models = models_of_type(2, random);
  models[0].model.robot.effects.push_back(
      {.kind = "eccentricity", .joint = 1, .settings = {{"order", 1.0}}, .values = {2e-4, -1e-4}});
  const CalibratedModel fleet = fleet_model(models);
  ASSERT_EQ(fleet.robot.effects.size(), 1u);
  EXPECT_NEAR(fleet.robot.effects[0].values[0], 1e-4, 1e-6);
  EXPECT_NEAR(fleet.robot.effects[0].values[1], -0.5e-4, 1e-6);
}

std::string refusal(const std::vector<NamedModel>& models) {
  return complaint([&] { fleet_model(models); });
}

TEST(Fleet, IsRefusedOfOneModelOfOtherArmsAndOfTheSameData) {
  RandomStream random{8107};
  const std::vector<NamedModel> models = models_of_type(2, random);
  EXPECT_THAT(refusal({models[0]}), HasSubstr("robot0.yaml: is the only model"));
  std::vector<NamedModel> other = models;
  other[1].model.nominal.chain.joints[1].a_m += 1e-3;
  EXPECT_THAT(refusal(other), ::testing::AllOf(HasSubstr("robot1.yaml"), HasSubstr("its joint 2 has a ")));
  std::vector<NamedModel> twice = models;
  twice[1].model.data_sha256 = twice[0].model.data_sha256;
  EXPECT_THAT(refusal(twice), HasSubstr("robot0.yaml was calibrated from as well"));
  std::vector<NamedModel> old = models;
  old[1].model.posterior.reset();
  EXPECT_THAT(refusal(old), HasSubstr("calibrate again"));
  std::vector<NamedModel> nested = models;
  nested[1].model = fleet_model(models);
  EXPECT_THAT(refusal(nested), HasSubstr("is a fleet's mean"));
}

}  // namespace
}  // namespace demecal
