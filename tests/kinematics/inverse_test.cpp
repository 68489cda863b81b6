// Inverse kinematics: round trips, least-norm steps, honest words near singularities and out of reach.
#include "kinematics/inverse.hpp"
#include "decompositions/decompositions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "random_arm.hpp"

namespace demecal {
namespace {

double smallest_singular(const Jacobian& jacobian) {
  return singular_system(jacobian).values.minCoeff();
}

/// Calls `check(chain, q)` for random arms at joints well away from singularities.
template <typename Check>
void on_regular_arms(std::uint64_t seed, int joints, double smallest, Check check, double prismatic = 0.15) {
  RandomStream stream{seed};
  int checked = 0;
  for (int trial = 0; trial < 100000 && checked < 40; ++trial) {
    const Convention convention = stream.chance(0.5) ? Convention::standard_dh : Convention::modified_dh;
    const Chain chain = random_arm(stream, joints, convention, prismatic);
    const JointVector q = random_joints(stream, chain);
    if (smallest_singular(model_of(chain)(q).jacobian) < smallest) continue;
    ++checked;
    check(stream, chain, q);
  }
  EXPECT_EQ(checked, 40);
}

TEST(Inverse, FindsTheJointsOfNearbyPosesOfSixJoints) {
  on_regular_arms(401, 6, 0.1, [](RandomStream& stream, const Chain& chain, const JointVector& q) {
    const JointVector wanted = q + random_change(stream, 6, 0.02);
    const InverseSolution solution = inverse(model_of(chain), forward(chain, wanted), q);
    EXPECT_EQ(solution.status, InverseStatus::converged);
    EXPECT_LT((solution.q - wanted).norm(), 1e-8);
    EXPECT_LT(solution.position_residual_m, 1e-10);
    EXPECT_LT(solution.orientation_residual_rad, 1e-10);
  });
}

TEST(Inverse, ReachesFarPosesOfSevenJoints) {
  on_regular_arms(402, 7, 0.1, [](RandomStream& stream, const Chain& chain, const JointVector& q) {
    const Eigen::Isometry3d target = forward(chain, q + random_change(stream, 7, 0.1));
    const InverseSolution solution = inverse(model_of(chain), target, q);
    EXPECT_EQ(solution.status, InverseStatus::converged);
    EXPECT_LT((forward(chain, solution.q).matrix() - target.matrix()).norm(), 1e-9);
  });
}

TEST(Inverse, MovesSevenJointsNoFartherThanNeeded) {
  on_regular_arms(403, 7, 0.1, [](RandomStream& stream, const Chain& chain, const JointVector& q) {
    const double little = 1e-4;
    const Eigen::Isometry3d target = forward(chain, q + random_change(stream, 7, little));
    const InverseSolution solution = inverse(model_of(chain), target, q);
    ASSERT_EQ(solution.status, InverseStatus::converged);
    const Jacobian jacobian = model_of(chain)(q).jacobian;
    const SingularSystem singular = singular_system(jacobian, Eigen::ComputeFullV);
    // The change lies in the row space but for what the Jacobian turns along the way, of second order.
    const JointVector change = solution.q - q;
    EXPECT_LT(std::abs(singular.v.col(6).dot(change)), 20 * change.squaredNorm() / solution.smallest_singular);
    EXPECT_GT(change.norm(), little / 100);
  });
}

TEST(Inverse, AtTheTargetAlreadyMovesNothing) {
  on_regular_arms(404, 6, 0.05, [](RandomStream&, const Chain& chain, const JointVector& q) {
    const InverseSolution solution = inverse(model_of(chain), forward(chain, q), q);
    EXPECT_EQ(solution.status, InverseStatus::converged);
    EXPECT_EQ(solution.q, q);
    EXPECT_NEAR(solution.smallest_singular, smallest_singular(model_of(chain)(q).jacobian), 1e-12);
  });
}

TEST(Inverse, OfAStretchedArmAskedFartherIsDampedAndNamed) {
  const Chain chain = wrist_arm();
  JointVector q(6);
  q << 0.3, -0.4, std::numbers::pi / 2, 0.2, 0.7, 0.1;
  Eigen::Isometry3d target = forward(chain, q);
  JointVector bent = q;
  bent[2] -= 0.5;
  const Eigen::Vector3d outwards = (target.translation() - forward(chain, bent).translation()).normalized();
  target.pretranslate(0.01 * outwards);
  const InverseSolution solution = inverse(model_of(chain), target, q);
  EXPECT_EQ(solution.status, InverseStatus::damped);
  EXPECT_LT(solution.smallest_singular, 1e-9);
  EXPECT_GT(solution.position_residual_m, 1e-4);
  EXPECT_LT((solution.q - q).norm(), 1.0);
}

TEST(Inverse, BesideAWristSingularityTakesBoundedSteps) {
  const Chain chain = wrist_arm();
  for (const double wrist_rad : {0.0, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2}) {
    JointVector q(6);
    q << 0.3, -0.4, 0.5, 0.2, wrist_rad, 0.1;
    const SingularSystem singular = singular_system(model_of(chain)(q).jacobian, Eigen::ComputeThinU);
    const PoseError lost = 1e-2 * singular.u.col(5);
    Eigen::Isometry3d target = forward(chain, q);
    target.linear() = Eigen::AngleAxisd(lost.tail<3>().norm(), lost.tail<3>().normalized()) * target.linear();
    target.pretranslate(lost.head<3>());
    const InverseSolution step = inverse(model_of(chain), target, q, {.max_iterations = 1});
    EXPECT_LT((step.q - q).norm(), 0.51) << wrist_rad;  // undamped: the error over the singular value
    EXPECT_EQ(step.status, InverseStatus::damped);
    EXPECT_NEAR(step.smallest_singular, singular.values[5], 1e-12);
  }
}

TEST(Inverse, BesideASingularityIsExactAllTheSameWhereJointsAreNear) {
  RandomStream stream{408};
  const Chain chain = wrist_arm();
  for (int trial = 0; trial < 100; ++trial) {
    JointVector q = random_change(stream, 6, 0.5);
    q[4] = stream.real(0.005, 0.04);
    JointVector wanted = q + random_change(stream, 6, 0.02);
    wanted[4] = q[4] + stream.real(0.0, 0.02);
    const InverseSolution solution = inverse(model_of(chain), forward(chain, wanted), q);
    EXPECT_EQ(solution.status, InverseStatus::converged);
    EXPECT_LT((solution.q - wanted).norm(), 1e-6);
  }
}

TEST(Inverse, OutOfReachDivergesAndSaysByHowMuch) {
  const auto check = [](RandomStream& stream, const Chain& chain, const JointVector& q) {
    double reach = 0.0;
    for (const Joint& joint : chain.joints) reach += joint.a_m + joint.d_m;
    Eigen::Isometry3d target = forward(chain, q);
    const double angle = stream.real(0, 6);
    target.translation() = 3 * reach * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
    const InverseSolution solution = inverse(model_of(chain), target, q);
    EXPECT_EQ(solution.status, InverseStatus::diverged);
    EXPECT_GT(solution.position_residual_m, reach);
    const Eigen::Isometry3d reached = forward(chain, solution.q);
    EXPECT_NEAR(solution.position_residual_m, (target.translation() - reached.translation()).norm(), 1e-12);
    EXPECT_NEAR(solution.orientation_residual_rad,
                Eigen::AngleAxisd(Eigen::Matrix3d(target.linear() * reached.linear().transpose())).angle(), 1e-9);
  };
  on_regular_arms(405, 6, 0.1, check, 0.0);
}

TEST(Inverse, OfFewerThanSixJointsIsLeastSquares) {
  for (const int joints : {2, 3, 4, 5}) {
    const auto check = [](RandomStream& stream, const Chain& chain, const JointVector& q) {
      Eigen::Isometry3d target = forward(chain, q);
      target.pretranslate(Eigen::Vector3d(stream.real(-1e-2, 1e-2), stream.real(-1e-2, 1e-2), 1e-2));
      const InverseSolution solution = inverse(model_of(chain), target, q);
      EXPECT_EQ(solution.status, InverseStatus::damped);
      const PoseAndJacobian at = model_of(chain)(solution.q);
      const PoseError left = pose_error(at.pose, target);
      EXPECT_GT(left.norm(), 1e-6);
      const Eigen::VectorXd gradient = Eigen::MatrixXd(at.jacobian).transpose() * left;
      EXPECT_LT(gradient.norm(), 1e-6 * left.norm());
    };
    on_regular_arms(406, joints, 0.2, check, 0.0);
  }
}

TEST(Inverse, OfAModelThatGivesNoNumbersReturnsItsStart) {
  const Chain chain = wrist_arm();
  const JointVector q = JointVector::Constant(6, 0.4);
  const Eigen::Isometry3d target = forward(chain, JointVector::Constant(6, 0.41));
  for (const bool pose_too : {false, true}) {
    const PoseFunction broken = [&](const JointVector& joints) {
      PoseAndJacobian at = model_of(chain)(joints);
      at.jacobian.setConstant(std::numeric_limits<double>::quiet_NaN());
      if (pose_too) at.pose.translation().setConstant(std::numeric_limits<double>::infinity());
      return at;
    };
    const InverseSolution solution = inverse(broken, target, q);
    EXPECT_NE(solution.status, InverseStatus::converged);
    EXPECT_EQ(solution.q, q);
  }
}

TEST(RotationBetween, TakesOneToTheOtherTinyOrNearHalfATurn) {
  RandomStream stream{407};
  const double pi = std::numbers::pi;
  for (const double angle : {1e-12, 1e-8, 1e-5, 1e-3, 0.5, 2.0, pi - 1e-3, pi - 1e-5, pi - 1e-8, pi - 1e-12, pi}) {
    for (int trial = 0; trial < 50; ++trial) {
      const Eigen::Vector3d axis = Eigen::Vector3d(stream.normal(), stream.normal(), stream.normal()).normalized();
      const Eigen::Matrix3d from =
          Eigen::Quaterniond(stream.normal(), stream.normal(), stream.normal(), stream.normal()).normalized().matrix();
      const Eigen::Matrix3d to = Eigen::AngleAxisd(angle, axis) * from;
      const Eigen::Vector3d vector = rotation_between(from, to);
      EXPECT_NEAR(vector.norm(), angle, 1e-14);
      EXPECT_LE(vector.norm(), pi + 1e-15);
      EXPECT_LT((Eigen::AngleAxisd(vector.norm(), vector.normalized()) * from - to).norm(), 1e-14);
      if (angle > 3.1) continue;  // near half a turn the opposite axis serves as well
      EXPECT_LT((vector - angle * axis).norm(), 2e-15 + 1e-14 * angle);
    }
  }
}

TEST(PoseError, IsWhatIsMissing) {
  RandomStream stream{409};
  const Chain chain = random_arm(stream, 6, Convention::standard_dh);
  const Eigen::Isometry3d pose = forward(chain, random_joints(stream, chain));
  const Eigen::Isometry3d target = forward(chain, random_joints(stream, chain));
  const PoseError error = pose_error(pose, target);
  const Eigen::Vector3d turn = error.tail<3>();
  Eigen::Isometry3d mended = pose;
  mended.translation() += error.head<3>();
  mended.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * pose.linear();
  EXPECT_LT((mended.matrix() - target.matrix()).norm(), 1e-14);
}

TEST(RotationBetween, EqualRotationsIsZero) {
  const Eigen::Matrix3d same = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitY()).toRotationMatrix();
  EXPECT_LT(rotation_between(same, same).norm(), 1e-16);
  EXPECT_EQ(rotation_between(Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()).norm(), 0.0);
}

}  // namespace
}  // namespace demecal
