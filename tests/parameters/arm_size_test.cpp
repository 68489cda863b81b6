// An arm that is larger with all that it touches touches it neither more nor less closely, whatever its axes.
#include "parameters/arm_size.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "fitting/touching_arm.hpp"
#include "parameters/observation.hpp"

namespace demecal {
namespace {

constexpr RowScales kMetres{1.0, 1.0, 1.0};

/// Touches two points, by far not closely.
KnownArm roughly_touching(RandomStream& stream, const Chain& chain) {
  KnownArm arm = perfect_arm(chain, Frame::base);
  touch(arm, stream, "left", {0.45, 0.25, 0.2}, 6, 0.01);
  touch(arm, stream, "right", {0.35, -0.35, 0.35}, 6, 0.01);
  return arm;
}

ParameterSpace space_of(const KnownArm& arm, const DeclaredModel& declared) {
  std::vector<ParameterId> ids = free_parameters(arm.data, declared);
  for (ParameterId& id : contact_parameters(arm.data, all_poses(arm.data))) ids.push_back(std::move(id));
  return {with_own_contacts(nominal_robot(arm.data), arm.data), ids};
}

/// Where neighbouring axes are parallel only the sum of their offsets is free, at one of them.
Chain parallel_arm_with_offsets() {
  Chain chain = parallel_arm();
  chain.joints[1].d_m = 0.14;
  chain.joints[2].d_m = -0.05;
  chain.joints[3].d_m = 0.21;
  return chain;
}

/// Whether the joint's offset is held, since it does what a neighbour's does.
bool holds_offset(const ParameterSpace& space, int joint) {
  return std::ranges::any_of(space.ids(), [&](const ParameterId& id) {
    return id.kind == ParameterId::Kind::link && id.link == LinkParameter::beta && id.index == joint;
  });
}

/// By how much every free number differs in the arm that is larger by `share`, its contacts as much farther from where
/// the first joint has its frame.
Eigen::VectorXd larger_by(double share, const ParameterSpace& space) {
  const CorrectedRobot& robot = space.reference();
  const Chain& chain = robot.chain;
  const Eigen::Vector3d fixed_m(0.0, 0.0, chain.joints[0].d_m);
  const bool before = chain.convention == Convention::modified_dh;
  Eigen::VectorXd change = Eigen::VectorXd::Zero(space.size());
  for (int i = 0; i < space.size(); ++i) {
    const ParameterId& id = space.ids()[static_cast<std::size_t>(i)];
    if (id.kind == ParameterId::Kind::contact) {
      const ContactPlace& place = robot.contacts.at({id.target, id.set});
      change[i] = share * (place.frame.linear().transpose() * (place.frame.translation() - fixed_m))[id.index];
    } else if (!id.is_angle()) {
      change[i] = share * parameter_value(robot, id);
    }
    if (id.kind != ParameterId::Kind::link || id.link != LinkParameter::d) continue;
    const int step = before ? 1 : -1;
    for (int joint = id.index + step; holds_offset(space, joint); joint += step)
      change[i] += share * chain.joints[static_cast<std::size_t>(joint)].d_m;
  }
  return change;
}

class ArmSize : public ::testing::TestWithParam<Chain> {
 protected:
  RandomStream stream_{9501};
  KnownArm arm_ = roughly_touching(stream_, GetParam());
  ParameterSpace space_ = space_of(arm_, kAll);
  std::vector<Observation> observations_ = observe(arm_.data, all_poses(arm_.data), space_.reference());

  Eigen::VectorXd residuals(const Eigen::VectorXd& change) const {
    Eigen::VectorXd all(3 * std::ssize(observations_));
    ScaledRows rows;
    for (Eigen::Index i = 0; i < std::ssize(observations_); ++i) {
      scaled_rows(arm_.data, space_, space_.at(change), observations_[static_cast<std::size_t>(i)], kMetres, rows);
      all.segment<3>(3 * i) = rows.residual;
    }
    return all;
  }
};
INSTANTIATE_TEST_SUITE_P(Arms, ArmSize,
                         ::testing::Values(parallel_arm(), parallel_arm_with_offsets(), modified_arm(),
                                           seven_joint_arm()));

TEST_P(ArmSize, LeavesRowsOfContactsAsTheyAre) {
  const Eigen::VectorXd as_described = residuals(Eigen::VectorXd::Zero(space_.size()));
  ASSERT_GT(as_described.norm(), 0.01);
  for (const double share : {-0.03, 0.02}) {
    const Eigen::VectorXd change = larger_by(share, space_);
    EXPECT_NEAR(space_.at(change).size, 1.0 + share, 1e-7);
    EXPECT_LT((residuals(change) - as_described).norm(), 1e-5 * as_described.norm()) << share;
  }
}

TEST_P(ArmSize, IsInTheDerivativeOfRows) {
  constexpr double kStep = 1e-6;
  Eigen::VectorXd change(space_.size());
  for (double& value : change) value = 0.03 * stream_.normal();
  ScaledRows rows;
  Eigen::MatrixXd derivative(3 * std::ssize(observations_), space_.size());
  for (Eigen::Index i = 0; i < std::ssize(observations_); ++i) {
    scaled_rows(arm_.data, space_, space_.at(change), observations_[static_cast<std::size_t>(i)], kMetres, rows);
    derivative.middleRows<3>(3 * i) = rows.jacobian;
  }
  for (int i = 0; i < space_.size(); ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(space_.size(), i);
    const Eigen::VectorXd slope = (residuals(change + step) - residuals(change - step)) / (2 * kStep);
    EXPECT_LT((derivative.col(i) - slope).norm(), 1e-6) << space_.ids()[static_cast<std::size_t>(i)].name();
  }
}

TEST(ArmSizeSlopes, AreNoneWhereLengthsAreKnownOrNothingIsTouched) {
  RandomStream stream{9502};
  const KnownArm travels = roughly_touching(stream, stanford_arm());
  EXPECT_TRUE(space_of(travels, kAll).size_slopes().isZero(0.0));
  const KnownArm turns = roughly_touching(stream, seven_joint_arm());
  EXPECT_TRUE(space_of(turns, {.tool = true, .joint_offset = true}).size_slopes().isZero(0.0));
  const KnownArm with_known_tool = roughly_touching(stream, modified_arm());
  EXPECT_TRUE(space_of(with_known_tool, {.joint_offset = true, .geometry = true}).size_slopes().isZero(0.0));
  const ParameterSpace untouched(turns.truth, free_parameters(turns.data, kAll));
  EXPECT_TRUE(untouched.size_slopes().isZero(0.0));
  EXPECT_FALSE(space_of(turns, kAll).size_slopes().isZero(0.0));
}

}  // namespace
}  // namespace demecal
