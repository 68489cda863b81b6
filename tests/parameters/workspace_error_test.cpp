// What a posterior leads one to expect over the workspace is what robots drawn from it show there.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kinematics/random_arm.hpp"
#include "parameters/posterior.hpp"

namespace demecal {
namespace {

constexpr double kModelError_m = 4e-5;

/// Angles and lengths of links, correlated.
Posterior link_posterior(const Chain& chain, RandomStream random) {
  Posterior posterior;
  for (int joint = 0; joint < chain.size(); ++joint) {
    posterior.ids.push_back({.kind = ParameterId::Kind::link, .index = joint, .link = LinkParameter::theta});
    posterior.ids.push_back({.kind = ParameterId::Kind::link, .index = joint, .link = LinkParameter::a});
  }
  posterior.factor.resize(std::ssize(posterior.ids), 8);
  for (Eigen::Index i = 0; i < posterior.factor.size(); ++i) posterior.factor.data()[i] = 1e-4 * random.normal();
  return posterior;
}

/// Tool errors of robots drawn from the posterior at joints drawn from the ranges, m, ascending. `placed`: as they are;
/// otherwise after the motion that brings a robot's places nearest to the expected ones.
std::vector<double> drawn_errors(const Posterior& posterior, const CorrectedRobot& robot,
                                 const std::vector<Interval>& ranges, bool placed) {
  constexpr int kRobots = 1000, kPlaces = 40;
  RandomStream random{4242, placed ? 1u : 2u};
  const ParameterSpace space(robot, posterior.ids);
  std::vector<double> errors;
  for (int drawn = 0; drawn < kRobots; ++drawn) {
    Eigen::VectorXd numbers(posterior.factor.cols());
    for (double& number : numbers) number = random.normal();
    const CorrectedRobot other = space.at(posterior.factor * numbers).robot;
    Eigen::Matrix3Xd expected(3, kPlaces), real(3, kPlaces);
    for (int place = 0; place < kPlaces; ++place) {
      JointVector joints(std::ssize(ranges));
      for (std::size_t i = 0; i < ranges.size(); ++i)
        joints[static_cast<Eigen::Index>(i)] = random.real(ranges[i].lower, ranges[i].upper);
      expected.col(place) = robot.predict(joints, "").translation();
      real.col(place) = other.predict(joints, "").translation();
    }
    if (!placed) real = (Eigen::Isometry3d(Eigen::umeyama(real, expected, false)) * real).eval();
    for (int place = 0; place < kPlaces; ++place) {
      const Eigen::Vector3d rest(random.normal(), random.normal(), random.normal());
      errors.push_back((real.col(place) - expected.col(place) + kModelError_m * rest).norm());
    }
  }
  std::ranges::sort(errors);
  return errors;
}

class WorkspaceErrorOf : public testing::TestWithParam<bool> {};

TEST_P(WorkspaceErrorOf, APosteriorIsThatOfRobotsDrawnFromIt) {
  const bool placed = GetParam();
  DataSet data;
  data.robot.chain = wrist_arm();
  const CorrectedRobot robot = nominal_robot(data);
  const Posterior posterior = link_posterior(robot.chain, RandomStream{31, 7});
  const std::vector<Interval> ranges(robot.chain.joints.size(), Interval{-1.2, 1.4});
  const WorkspaceError expected =
      workspace_error(posterior, {.model_error_m = kModelError_m}, robot, ranges, placed, RandomStream{5, 1});
  const std::vector<double> errors = drawn_errors(posterior, robot, ranges, placed);
  double squares = 0.0;
  for (const double error : errors) squares += error * error / static_cast<double>(errors.size());
  EXPECT_NEAR(std::sqrt(squares) / expected.rms_m, 1.0, 0.1);
  EXPECT_NEAR(errors[errors.size() * 95 / 100] / expected.p95_m, 1.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Placed, WorkspaceErrorOf, testing::Bool());

TEST(WorkspaceErrorOf, WhatNoContactTellsIsLeftOut) {
  DataSet data;
  data.robot.chain = wrist_arm();
  const CorrectedRobot robot = nominal_robot(data);
  Posterior posterior;  // of the whole arm's turn about its first axis alone
  posterior.ids.push_back({.kind = ParameterId::Kind::link, .index = 0, .link = LinkParameter::theta});
  posterior.factor = Eigen::MatrixXd::Constant(1, 1, 1e-3);
  const std::vector<Interval> ranges(robot.chain.joints.size(), Interval{-1.2, 1.4});
  EXPECT_GT(workspace_error(posterior, {}, robot, ranges, true, RandomStream{5, 1}).rms_m, 1e-4);
  EXPECT_LT(workspace_error(posterior, {}, robot, ranges, false, RandomStream{5, 1}).rms_m, 1e-12);
}

Eigen::Matrix3d some_turn(RandomStream& random) {
  const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
  return Eigen::AngleAxisd(random.real(-3.0, 3.0), axis.normalized()).toRotationMatrix();
}

/// A base that turned against joint 1 is no error of the tool, in whichever frame it is counted.
TEST(Posterior, IsAsWideInAnyFrameOfTheMeasurements) {
  RandomStream random{31, 9};
  DataSet data;
  data.robot.chain = wrist_arm();
  CorrectedRobot robot = nominal_robot(data);
  robot.sensor_from_base.linear() = some_turn(random);
  Posterior posterior = link_posterior(robot.chain, random);
  for (const ParameterId::Kind kind : {ParameterId::Kind::base_translation, ParameterId::Kind::base_rotation})
    for (int axis = 0; axis < 3; ++axis) posterior.ids.push_back({.kind = kind, .index = axis});
  posterior.factor.conservativeResize(std::ssize(posterior.ids), Eigen::NoChange);
  posterior.factor.bottomRows(6) = 1e-3 * Eigen::MatrixXd::Random(6, posterior.factor.cols());
  // Joint 1 is known to a tenth of a radian, but for the base that turns against it.
  posterior.factor(0, 0) = 0.1;
  posterior.factor.bottomRows(3).col(0) = -0.1 * robot.sensor_from_base.linear().col(2);
  Eigen::Isometry3d there(Eigen::Translation3d(0.4, -1.0, 2.0));
  there.linear() = some_turn(random);
  CorrectedRobot moved = robot;
  moved.sensor_from_base = there * robot.sensor_from_base;
  const Posterior turned = with_turned_base(posterior, there.linear());
  for (int i = 0; i < 20; ++i) {
    const Stop stop(random_joints(random, robot.chain));
    const PoseCovariance before = pose_covariance(posterior, robot, stop), after = pose_covariance(turned, moved, stop);
    const Eigen::Matrix3d here = there.linear() * before.topLeftCorner<3, 3>() * there.linear().transpose();
    EXPECT_LT((after.topLeftCorner<3, 3>() - here).norm(), 1e-9 * here.norm());
    EXPECT_LT(std::sqrt(before.topLeftCorner<3, 3>().trace()), 0.02);
  }
}

}  // namespace
}  // namespace demecal
