// Smooth corrections of joints: derivatives, which of their terms are believed, and what they recover.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include <cmath>

#include "decompositions/decompositions.hpp"
#include "measured_arm.hpp"
#include "prediction/random_robot.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal {
namespace {

using ::testing::Each;

constexpr int kTermsPerJoint = 19;

KnownArm stanford(RandomStream& stream, int poses) {
  KnownArm arm = perfect_arm(stanford_arm(), Frame::base);
  measure(arm, stream, {.orientation = true}, poses);
  return arm;
}

TEST(SmoothCorrections, HaveTermsForEveryTurningJointThatMoves) {
  RandomStream stream{85, 1};
  KnownArm arm = stanford(stream, 60);
  for (MeasuredPose& pose : arm.data.poses) pose.joints[4] = 0.7;
  arm.data.poses[3].joints[4] = 0.72;  // off by itself, it does not make the joint one that moves
  const SmoothCorrections smooth = smooth_corrections(arm.data, all_poses(arm.data), arm.truth, true);
  std::vector<int> terms(6, 0);
  for (const SmoothTerm& term : smooth.terms) ++terms[static_cast<std::size_t>(term.joint)];
  EXPECT_THAT(terms, ::testing::ElementsAre(kTermsPerJoint, kTermsPerJoint, 0, kTermsPerJoint, 0, kTermsPerJoint));
  EXPECT_EQ(smooth.coefficients, Eigen::VectorXd::Zero(4 * kTermsPerJoint));
  for (const JointCorrection& correction : smooth.corrections()) EXPECT_TRUE(correction.is_neutral());
  EXPECT_TRUE(smooth_corrections(arm.data, all_poses(arm.data), arm.truth, false).terms.empty());
}

TEST(SmoothCorrections, HaveATermForEveryThirdValueAtMostTheSlowOnesFirst) {
  RandomStream stream{85, 11};
  const KnownArm arm = stanford(stream, 12);
  const SmoothCorrections smooth = smooth_corrections(arm.data, all_poses(arm.data), arm.truth, true, true);
  std::vector<std::pair<int, int>> of_first;
  for (const SmoothTerm& term : smooth.terms)
    if (term.joint == 0) of_first.emplace_back(term.harmonic, term.harmonic > 0 ? 0 : term.family);
  EXPECT_THAT(of_first,
              ::testing::UnorderedElementsAre(std::pair(0, 1), std::pair(0, 2), std::pair(1, 0), std::pair(1, 0)));
}

TEST(SmoothCorrections, TermsAreOfSizeOneWithinTheRange) {
  RandomStream stream{85, 2};
  const KnownArm arm = stanford(stream, 40);
  SmoothCorrections smooth = smooth_corrections(arm.data, all_poses(arm.data), arm.truth, true);
  for (Eigen::Index i = 0; i < smooth.coefficients.size(); ++i) {
    smooth.coefficients.setZero();
    smooth.coefficients[i] = 1.0;
    const int joint = smooth.terms[static_cast<std::size_t>(i)].joint;
    const JointCorrection correction = smooth.corrections()[static_cast<std::size_t>(joint)];
    double largest = 0.0;
    for (const MeasuredPose& pose : arm.data.poses)
      largest = std::max(largest, std::abs(correction(pose.joints[joint])));
    EXPECT_GT(largest, 0.5) << i;
    EXPECT_LT(largest, 1.0 + 1e-9) << i;
  }
}

TEST(SmoothCorrections, BeginWithAConstantAndIndependentPolynomials) {
  RandomStream stream{85, 7};
  const KnownArm arm = stanford(stream, 60);
  const SmoothCorrections smooth = smooth_corrections(arm.data, all_poses(arm.data), arm.truth, true);
  constexpr int kPolynomials = 9;
  Eigen::MatrixXd values(60, kPolynomials);
  for (Eigen::Index term = 0; term < kPolynomials; ++term) {
    SmoothCorrections one = smooth;
    one.coefficients[term] = 1.0;
    const JointCorrection correction = one.corrections()[0];
    for (Eigen::Index pose = 0; pose < 60; ++pose) {
      values(pose, term) = correction(arm.data.poses[static_cast<std::size_t>(pose)].joints[0]);
    }
  }
  EXPECT_EQ(PivotedQr(values, 1e-6).rank(), kPolynomials);
  EXPECT_EQ(values.col(0), Eigen::VectorXd::Ones(60));
}

TEST(SmoothCorrections, ColumnsAreWhatTheirCoefficientsChange) {
  RandomStream stream{85, 3};
  KnownArm arm = stanford(stream, 12);
  for (MeasuredPose& pose : arm.data.poses)
    pose.joints[3] += pose.joints[3] < 0 ? 2 * M_PI : 0.0;  // beyond half a turn
  arm.truth.corrections[1] = random_correction(stream, 1e-3, {-2.5, 2.5});
  for (MeasuredPose& pose : arm.data.poses) {
    pose.position_m = arm.truth.predict(pose.joints, "").translation();
    pose.orientation = Eigen::Quaterniond(arm.truth.predict(pose.joints, "").linear());
  }
  SmoothCorrections smooth = smooth_corrections(arm.data, all_poses(arm.data), arm.truth, true);
  const RowMatrix columns = smooth.columns(field_of(arm, {}));
  const auto residual_at = [&](Eigen::Index term, double value) {
    smooth.coefficients.setZero();
    smooth.coefficients[term] = value;
    CorrectedRobot robot = arm.truth;
    robot.corrections = smooth.corrections();
    return residual_field(arm.data, all_poses(arm.data), ParameterSpace(robot, {}), kScales, false).residual;
  };
  constexpr double kStep = 1e-6;
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    const Eigen::VectorXd change = (residual_at(i, -kStep) - residual_at(i, kStep)) / (2 * kStep);
    EXPECT_LT((change - columns.col(i)).norm(), 1e-5 * change.norm()) << i;
  }
}

TEST(Relevance, KeepsTermsThatAreThereAndRemovesThoseThatAreNot) {
  RandomStream stream{85, 4};
  constexpr Eigen::Index kRows = 150, kFixed = 5, kTerms = 20;
  std::vector<int> each_its_own(kTerms);
  std::iota(each_its_own.begin(), each_its_own.end(), 0);
  for (int trial = 0; trial < 5; ++trial) {
    RowMatrix rows(kRows, kFixed + kTerms + 1);
    rows.leftCols(kFixed + kTerms) = 1e4 * random_matrix(stream, kRows, kFixed + kTerms);
    Eigen::VectorXd truth = Eigen::VectorXd::Zero(kFixed + kTerms);
    truth.head(kFixed).setConstant(1e-3);
    truth[kFixed + 2] = 1e-3;
    truth[kFixed + 11] = -4e-4;
    rows.rightCols(1) = rows.leftCols(kFixed + kTerms) * truth + random_matrix(stream, kRows, 1);
    const Eigen::VectorXd precision = relevance(rows.transpose() * rows, each_its_own, kRows);
    Eigen::MatrixXd gram = (rows.transpose() * rows).topLeftCorner(kFixed + kTerms, kFixed + kTerms);
    gram.diagonal().tail(kTerms) += precision.cwiseAbs2();
    const Eigen::VectorXd found =
        PivotedCholesky(gram).solve(rows.leftCols(kFixed + kTerms).transpose() * rows.rightCols(1));
    int removed = 0;
    for (Eigen::Index i = 0; i < kTerms; ++i) {
      const double expected = truth[kFixed + i];
      if (expected != 0.0) {
        EXPECT_NEAR(found[kFixed + i], expected, 4e-5);
      } else {
        removed += std::abs(found[kFixed + i]) < 1e-7;  // a hundredth of what noise would make of it
      }
    }
    EXPECT_GE(removed, 10);
  }
}

TEST(Relevance, BelievesTermsOfAFamilyToBeOfLikeSize) {
  RandomStream stream{85, 6};
  constexpr Eigen::Index kRows = 120, kTerms = 12;
  constexpr double kUsual = 2e-5;  // twice what the rows can tell
  std::vector<int> alike(kTerms, 0), each_its_own(kTerms);
  std::iota(each_its_own.begin(), each_its_own.end(), 0);
  double error_alike = 0.0, error_alone = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    RowMatrix rows(kRows, kTerms + 1);
    rows.leftCols(kTerms) = 1e4 * random_matrix(stream, kRows, kTerms);
    const Eigen::VectorXd truth = kUsual * random_matrix(stream, kTerms, 1);
    rows.rightCols(1) = rows.leftCols(kTerms) * truth + random_matrix(stream, kRows, 1);
    const auto error = [&](const std::vector<int>& families) {
      const Eigen::VectorXd precision = relevance(rows.transpose() * rows, families, kRows);
      Eigen::MatrixXd gram = rows.leftCols(kTerms).transpose() * rows.leftCols(kTerms);
      gram.diagonal() += precision.cwiseAbs2();
      return (PivotedCholesky(gram).solve(rows.leftCols(kTerms).transpose() * rows.rightCols(1)) - truth).squaredNorm();
    };
    error_alike += error(alike);
    error_alone += error(each_its_own);
  }
  EXPECT_LT(error_alike, 0.8 * error_alone);
}

TEST(SmoothCorrections, RecoverSmoothErrorsAtAnglesThatWereNotMeasured) {
  RandomStream stream{85, 5};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::base);
  for (JointCorrection& correction : arm.truth.corrections) {
    correction =
        JointCorrection(wave(stream.real(5e-4, 1e-3), stream.real(0.8, 1.4), stream.real(-3, 3)), {}, {-2.5, 2.5});
  }
  measure(arm, stream, {.noise_m = 2e-5}, 80);
  const DiagnosisProblem problem{
      arm.data, {.registration = true, .joint_offset = true, .joint_corrections = true}, all_poses(arm.data), {}};
  DiagnosedModel model{nominal_robot(arm.data),
                       smooth_corrections(arm.data, problem.fitted, nominal_robot(arm.data), true),
                       {1e-4, 0.0, 0.0}};
  model = refined(problem, std::move(model), 12);
  const double before = largest_error_m(nominal_robot(arm.data), arm, stream);
  EXPECT_GT(before, 1e-3);
  EXPECT_LT(largest_error_m(model.robot, arm, stream), 0.05 * before);
  EXPECT_NEAR(model.scales[kPosition], 2e-5, 4e-6);
}

/// The largest difference between corrections of a joint, rad, over the values that were measured.
double largest_difference_rad(const DiagnosedModel& one, const DiagnosedModel& other, int joint, const DataSet& data) {
  const auto at = static_cast<std::size_t>(joint);
  double largest = 0.0;
  for (const MeasuredPose& pose : data.poses) {
    const double theta = pose.joints[joint];
    largest = std::max(largest, std::abs(one.robot.corrections[at](theta) - other.robot.corrections[at](theta)));
  }
  return largest;
}

TEST(SmoothCorrections, OnePoseBesideLockedJointsBendsNone) {
  RandomStream stream{85, 12};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::base);
  measure(arm, stream, {.noise_m = 5e-5}, 40);
  for (MeasuredPose& pose : arm.data.poses) {
    const double first = pose.joints[0], second = pose.joints[1];
    pose.joints = JointVector::Constant(6, 0.7);
    pose.joints[0] = first;
    pose.joints[1] = second;
    pose.position_m = arm.truth.predict(pose.joints, "").translation() +
                      5e-5 * Eigen::Vector3d(stream.normal(), stream.normal(), stream.normal());
  }
  const auto fitted = [&](const KnownArm& measured) {
    const DiagnosisProblem problem{
        measured.data, {.registration = true, .joint_corrections = true}, all_poses(measured.data), {}};
    return refined(problem,
                   {nominal_robot(measured.data),
                    smooth_corrections(measured.data, problem.fitted, nominal_robot(measured.data), true),
                    {1e-4, 0.0, 0.0}},
                   12);
  };
  KnownArm beside = arm;
  for (int joint = 2; joint < 6; ++joint) beside.data.poses[0].joints[joint] += 1.2e-3 + 2e-4 * joint;  // not reached
  const DiagnosedModel without = fitted(arm), with = fitted(beside);
  for (int joint = 0; joint < 2; ++joint) EXPECT_LT(largest_difference_rad(with, without, joint, arm.data), 3e-5);
  for (std::size_t joint = 2; joint < 6; ++joint) EXPECT_TRUE(with.robot.corrections[joint].is_neutral()) << joint;
}

TEST(SmoothCorrections, OfAPerfectArmStaySmall) {
  RandomStream stream{85, 6};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::base);
  measure(arm, stream, {.noise_m = 5e-5}, 60);
  const DiagnosisProblem problem{arm.data, {.registration = true, .joint_corrections = true}, all_poses(arm.data), {}};
  DiagnosedModel model{nominal_robot(arm.data),
                       smooth_corrections(arm.data, problem.fitted, nominal_robot(arm.data), true),
                       {1e-4, 0.0, 0.0}};
  model = refined(problem, std::move(model), 12);
  EXPECT_LT(largest_error_m(model.robot, arm, stream), 1e-4);
}

}  // namespace
}  // namespace demecal
