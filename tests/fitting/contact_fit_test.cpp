// Arms fitted to what they touched: the truth is found without an instrument, as far as contacts tell it; places nobody
// knows take their share of the freedom; and what contacts cannot tell stays as described.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "parameters/observation.hpp"
#include "prediction/measurement.hpp"
#include "touching_arm.hpp"

namespace demecal {
namespace {

constexpr double kPlay_m = 5e-5;
const Eigen::Vector3d kLeft(0.45, 0.25, 0.1), kRightPlace(0.35, -0.35, 0.35), kUnseen(-0.1, 0.5, 0.2);
const Eigen::Vector3d kGauge(0.0, 0.03, 0.04);  ///< between the two sockets of a place, 50 mm

/// Seven joints that touch two sockets, 50 mm apart, at each of two places.
KnownArm touching_arm(RandomStream& stream, double play_m, bool length_known, int count = 20) {
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  arm.truth.tools[""].translation() += Eigen::Vector3d(0.01, -0.008, 0.012);
  touch(arm, stream, "left-0", kLeft, count, play_m);
  touch(arm, stream, "left-1", kLeft + kGauge, count, play_m);
  touch(arm, stream, "right-0", kRightPlace, count, play_m);
  touch(arm, stream, "right-1", kRightPlace + kGauge, count, play_m);
  if (length_known)
    arm.data.contacts.distances = {{"left-0", "left-1", kGauge.norm(), 1e-5},
                                   {"right-0", "right-1", kGauge.norm(), 1e-5}};
  return arm;
}

double rms_m(const CorrectedRobot& robot, const DataSet& data) {
  return 1e-3 * error_figures(robot, data, all_poses(data)).rms_mm;
}

TEST(ContactFit, NeedsNoBaseAndLeavesWhereTheArmStandsAlone) {
  RandomStream stream{9201};
  const KnownArm arm = touching_arm(stream, 0.0, true, 3);
  for (const ParameterId& id : free_parameters(arm.data, kAll)) {
    EXPECT_NE(id.kind, ParameterId::Kind::base_translation);
    EXPECT_NE(id.kind, ParameterId::Kind::base_rotation);
    if (id.kind == ParameterId::Kind::link && id.index == 0) {
      EXPECT_NE(id.link, LinkParameter::theta);
      EXPECT_NE(id.link, LinkParameter::d);
    }
  }
}

TEST(ContactFit, FindsTheArmFromPointsThatNobodyKnows) {
  RandomStream stream{9202};
  KnownArm arm = touching_arm(stream, kPlay_m, true);
  const Fit fit = fit_all(arm, kAll);
  ASSERT_EQ(fit.status, FitStatus::converged) << fit.sentence;
  EXPECT_NEAR(fit.sigma_position_m, kPlay_m, 0.15 * kPlay_m);
  EXPECT_GT(rms_m(nominal_robot(arm.data), arm.data), 100 * kPlay_m);
  DataSet unseen = arm.data;
  unseen.poses.clear();
  KnownArm elsewhere{unseen, arm.truth};
  touch(elsewhere, stream, "unseen", kUnseen, 30, 0.0, PoseSet::accept);
  EXPECT_LT(rms_m(fit.robot, elsewhere.data), 3 * kPlay_m);
}

TEST(ContactFit, FindsTheToolFromFarOff) {
  RandomStream stream{9215};
  KnownArm arm = touching_arm(stream, kPlay_m, true, 12);
  arm.data.robot.chain.tool_m.z() -= 0.04;
  const Fit fit = fit_all(arm, kAll);
  EXPECT_NEAR(fit.sigma_position_m, kPlay_m, 0.2 * kPlay_m) << fit.sentence;
}

TEST(ContactFit, WithoutALengthTheScaleStaysTheDescriptions) {
  RandomStream stream{9203};
  KnownArm arm = touching_arm(stream, kPlay_m, false);
  const auto spans = [](const CorrectedRobot& robot) {
    double sum = 0.0;
    for (const Joint& joint : robot.chain.joints) sum += std::abs(joint.d_m) + std::abs(joint.a_m);
    return sum;
  };
  for (Joint& joint : arm.truth.chain.joints) {  // a longer arm whose contacts are as much farther apart agrees as well
    joint.a_m *= 1.01;
    joint.d_m *= 1.01;
  }
  arm.truth.tools[""].translation() *= 1.01;
  arm.data.poses.clear();
  touch(arm, stream, "left", kLeft, 40, kPlay_m);
  touch(arm, stream, "right", kRightPlace, 40, kPlay_m);
  const Fit fit = fit_all(arm, kAll);
  ASSERT_EQ(fit.status, FitStatus::converged) << fit.sentence;
  const double nominal = spans(nominal_robot(arm.data)), truth = spans(arm.truth);
  EXPECT_LT(std::abs(spans(fit.robot) - nominal), 0.4 * std::abs(truth - nominal));
  EXPECT_LT(rms_m(fit.robot, arm.data), 2 * kPlay_m * std::sqrt(3.0));
}

/// How much larger the arm's free lengths are than the description's, as its makers' figures weigh them.
double larger_share(const CorrectedRobot& robot, const CorrectedRobot& nominal) {
  double product = 0.0, square = 0.0;
  for (std::size_t joint = 1; joint < robot.chain.joints.size(); ++joint) {
    const Joint &after = robot.chain.joints[joint], &before = nominal.chain.joints[joint];
    product += (after.d_m - before.d_m) * before.d_m + (after.a_m - before.a_m) * before.a_m;
    square += before.d_m * before.d_m + before.a_m * before.a_m;
  }
  return product / square;
}

/// Links that are right but for the joints' zeros: whatever their lengths are fitted to be is the fit's doing.
KnownArm arm_of_described_lengths(RandomStream& stream, int count) {
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true});
  touch(arm, stream, "left-0", kLeft, count, kPlay_m);
  touch(arm, stream, "left-1", kLeft + kGauge, count, kPlay_m);
  touch(arm, stream, "right-0", kRightPlace, count, kPlay_m);
  return arm;
}

TEST(ContactFit, IsNoSmallerForBeingTouchedOften) {
  for (const int count : {15, 60}) {
    RandomStream stream{9213};
    const KnownArm arm = arm_of_described_lengths(stream, count);
    for (const bool robust : {false, true}) {
      const Fit fit = fit_all(arm, kAll, {.robust = robust});
      ASSERT_EQ(fit.status, FitStatus::converged) << fit.sentence;
      EXPECT_NEAR(larger_share(fit.robot, nominal_robot(arm.data)), 0.0, 5e-4) << count;
    }
  }
}

TEST(ContactFit, BelievesALengthThatIsHardlyKnownAndNotHowOftenItIsTouched) {
  RandomStream stream{9214};
  KnownArm arm = arm_of_described_lengths(stream, 60);
  for (const double sigma_m : {2e-5, 1e-4, 2e-4, 5e-4}) {
    arm.data.contacts.distances = {{"left-0", "left-1", kGauge.norm(), sigma_m}};
    const Fit fit = fit_all(arm, kAll);
    ASSERT_EQ(fit.status, FitStatus::converged) << fit.sentence;
    EXPECT_NEAR(larger_share(fit.robot, nominal_robot(arm.data)), 0.0, 1e-3) << sigma_m;
  }
}

/// Independent of how the fit carries places: residuals about each contact's mean, by difference quotients, in one
/// dense least-squares problem. The covariance of the tool, whose numbers have no prior.
TEST(ContactFit, HasTheStandardErrorsOfLeastSquaresWithThePlacesEliminated) {
  constexpr double kStep = 1e-6;
  RandomStream stream{9204};
  const KnownArm arm = touching_arm(stream, kPlay_m, false, 12);
  const DeclaredModel tool_alone{.registration = true, .tool = true};
  KnownArm straight = arm;
  straight.truth = nominal_robot(arm.data);
  straight.data.poses.clear();
  touch(straight, stream, "left", kLeft, 12, kPlay_m);
  touch(straight, stream, "right", kRightPlace, 12, kPlay_m);
  const Fit fit = fit_all(straight, tool_alone, {.robust = false});
  ASSERT_EQ(fit.estimates.size(), 3u);
  const auto centred = [&](const CorrectedRobot& robot) {
    Eigen::MatrixXd points(3, std::ssize(straight.data.poses));
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      points.col(i) = robot.predict(Stop(straight.data.poses[static_cast<std::size_t>(i)]), "").translation();
    points.leftCols(12).colwise() -= points.leftCols(12).rowwise().mean().eval();
    points.rightCols(12).colwise() -= points.rightCols(12).rowwise().mean().eval();
    return Eigen::VectorXd(points.reshaped());
  };
  Eigen::MatrixXd slopes(72, 3);
  for (int axis = 0; axis < 3; ++axis) {
    CorrectedRobot ahead = fit.robot, behind = fit.robot;
    ahead.tools[""].translation()[axis] += kStep;
    behind.tools[""].translation()[axis] -= kStep;
    slopes.col(axis) = (centred(ahead) - centred(behind)) / (2 * kStep);
  }
  const Eigen::VectorXd left = centred(fit.robot);
  EXPECT_LT((slopes.transpose() * left).norm(), 1e-6 * slopes.norm() * left.norm());
  const double variance = left.squaredNorm() / (72 - 3 - 6);
  const Eigen::Matrix3d covariance = variance * (slopes.transpose() * slopes).inverse();
  for (int axis = 0; axis < 3; ++axis) {
    const double expected = std::sqrt(covariance(axis, axis));
    EXPECT_NEAR(fit.estimates[static_cast<std::size_t>(axis)].standard_error, expected, 0.01 * expected) << axis;
  }
}

TEST(ContactFit, TellsOfPlanesSpheresAndLinesToo) {
  RandomStream stream{9205};
  KnownArm arm = touching_arm(stream, kPlay_m, true);
  const std::size_t touched = arm.data.poses.size();
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d on_plate(stream.real(0.25, 0.5), stream.real(-0.2, 0.2), 0.05);
    const Eigen::Vector3d around(stream.normal(), stream.normal(), std::abs(stream.normal()));
    touch(arm, stream, "plate", on_plate, 1, kPlay_m);
    touch(arm, stream, "ball", kUnseen + 0.02 * around.normalized(), 1, kPlay_m);
    touch(arm, stream, "edge", kLeft + stream.real(0.0, 0.2) * Eigen::Vector3d(0.6, 0.8, 0.0), 1, kPlay_m);
  }
  arm.data.contacts.forms = {
      {"plate", {ContactKind::plane, {}}}, {"ball", {ContactKind::sphere, 0.02}}, {"edge", {ContactKind::line, {}}}};
  for (MeasuredPose& pose : arm.data.poses) pose.contact_kind = arm.data.contacts.form_of(pose.contact).kind;
  const Fit fit = fit_all(arm, kAll);
  ASSERT_EQ(fit.status, FitStatus::converged) << fit.sentence;
  EXPECT_NEAR(fit.sigma_position_m, kPlay_m, 0.15 * kPlay_m);
  std::vector<std::size_t> others;
  for (std::size_t i = touched; i < arm.data.poses.size(); ++i) others.push_back(i);
  EXPECT_LT(error_figures(fit.robot, arm.data, others).rms_mm, 2e3 * kPlay_m);
}

/// Sockets that are exact, and a plate of which nothing but its unevenness is said.
TEST(ContactFit, BelievesAnUnevenPlateLess) {
  constexpr double kFlatness_m = 3e-3;
  double told = 0.0, untold = 0.0;
  for (std::uint64_t seed = 9212; seed < 9216; ++seed) {
    RandomStream stream{seed};
    KnownArm arm = touching_arm(stream, kPlay_m, true, 8);
    for (int i = 0; i < 24; ++i) {
      const Eigen::Vector3d on_plate(stream.real(0.25, 0.5), stream.real(-0.2, 0.2),
                                     0.05 + kFlatness_m * stream.real(-0.5, 0.5));
      touch(arm, stream, "plate", on_plate, 1, kPlay_m);
    }
    KnownArm elsewhere{arm.data, arm.truth};
    elsewhere.data.poses.clear();
    touch(elsewhere, stream, "unseen", kUnseen, 30, 0.0, PoseSet::accept);
    for (double* const square : {&untold, &told}) {
      arm.data.contacts.forms = {{"plate", {ContactKind::plane, {}, square == &told ? kFlatness_m : 0.0}}};
      for (MeasuredPose& pose : arm.data.poses) pose.contact_kind = arm.data.contacts.form_of(pose.contact).kind;
      weigh_by_flatness(arm.data);
      const Fit fit = fit_all(arm, kAll, {.robust = false});
      ASSERT_EQ(fit.status, FitStatus::converged) << fit.sentence;
      *square += std::pow(rms_m(fit.robot, elsewhere.data), 2);
    }
  }
  EXPECT_LT(told, 0.5 * untold);
}

TEST(RelationRows, ChangeWithThePlacesAsTheirDerivativesSay) {
  constexpr double kStep = 1e-6;
  RandomStream stream{9206};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  touch(arm, stream, "a", kLeft, 3, 0.01);
  touch(arm, stream, "b", kRightPlace, 3, 0.01);
  touch(arm, stream, "p", kLeft, 4, 0.05);
  touch(arm, stream, "r", kRightPlace, 4, 0.05);
  touch(arm, stream, "s", kRightPlace, 6, 0.05);
  arm.data.contacts.forms = {
      {"p", {ContactKind::plane, {}}}, {"r", {ContactKind::plane, {}}}, {"s", {ContactKind::sphere, {}}}};
  for (MeasuredPose& pose : arm.data.poses) pose.contact_kind = arm.data.contacts.form_of(pose.contact).kind;
  arm.data.contacts.distances = {{"a", "b", 0.5, 1e-4},
                                 {"s", {}, 0.04, 5e-5},
                                 {"p", "r", 0.3, 1e-4},
                                 {"p", "a", 0.3, 1e-4},
                                 {"s", "p", 0.3, 1e-4}};
  arm.data.contacts.angles = {{"p", "r", false, 1e-2}, {"p", "r", true, 1e-2}};
  const std::vector<ParameterId> ids = contact_parameters(arm.data, all_poses(arm.data));
  const ParameterSpace space(with_own_contacts(nominal_robot(arm.data), arm.data), ids);
  Eigen::VectorXd change(space.size());
  for (double& value : change) value = 0.1 * stream.normal();
  const RelationRows rows = relation_rows(arm.data, space, space.at(change));
  ASSERT_EQ(rows.residual.size(), 8);
  for (int i = 0; i < space.size(); ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(space.size(), i);
    const Eigen::VectorXd slope = (relation_rows(arm.data, space, space.at(change + step)).residual -
                                   relation_rows(arm.data, space, space.at(change - step)).residual) /
                                  (2 * kStep);
    EXPECT_LT((rows.jacobian.col(i) - slope).norm(), 1e-6 * (1.0 + slope.norm()))
        << ids[static_cast<std::size_t>(i)].name();
  }
}

TEST(ContactFit, FindsTheArmFromWiresWhoseAnchorsNobodyKnows) {
  RandomStream stream{9211};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  arm.data.anchors_m = {{1.5, 0.3, -0.2}, {-0.4, 1.6, 0.1}, {0.2, -0.5, 2.0}};
  measure(arm, stream, {.noise_m = kPlay_m, .position = false}, 80);
  const KnownArm measured = arm;
  arm.data.anchors_m.clear();
  arm.data.anchors_unknown = true;
  take_wires_for_contacts(arm.data);
  ASSERT_EQ(arm.data.poses.size(), 240u);
  EXPECT_FALSE(has_instrument(arm.data));
  const Fit fit = fit_all(arm, kAll);
  ASSERT_EQ(fit.status, FitStatus::converged) << fit.sentence;
  EXPECT_NEAR(fit.sigma_position_m, kPlay_m, 0.2 * kPlay_m);
  const CorrectedRobot placed = with_own_contacts(fit.robot, arm.data);
  double between_m = 0.0;  // what no frame changes
  for (const auto& [first, second] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
    const auto at = [&](int anchor) {
      return placed.contacts.at({"anchor " + std::to_string(anchor + 1), PoseSet::calibration}).frame.translation();
    };
    const double truth_m = (measured.data.anchors_m[static_cast<std::size_t>(first)] -
                            measured.data.anchors_m[static_cast<std::size_t>(second)])
                               .norm();
    between_m = std::max(between_m, std::abs((at(first) - at(second)).norm() - truth_m));
  }
  EXPECT_LT(between_m, 1e-3);
  EXPECT_GT(rms_m(nominal_robot(arm.data), arm.data), 20 * kPlay_m);
}

}  // namespace
}  // namespace demecal
