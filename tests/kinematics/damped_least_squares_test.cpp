// Damped least squares: a minimum of what it says, position first, and small motions at singularities.
#include "kinematics/inverse.hpp"

#include <gtest/gtest.h>

#include "random_arm.hpp"

namespace demecal {
namespace {

Eigen::Isometry3d displaced(RandomStream& stream, Eigen::Isometry3d pose, double size) {
  pose.pretranslate(Eigen::Vector3d(stream.real(-size, size), stream.real(-size, size), stream.real(-size, size)));
  pose.linear() = pose.linear() * Eigen::AngleAxisd(stream.real(-size, size), Eigen::Vector3d::UnitX());
  return pose;
}

double cost(const Chain& chain, const Eigen::Isometry3d& target, const JointVector& q, const JointVector& start,
            const DampingOptions& options) {
  const PoseError error = pose_error(forward(chain, q), target);
  return error.head<3>().squaredNorm() / (options.length_m * options.length_m) + error.tail<3>().squaredNorm() +
         options.damping * options.damping * (q - start).squaredNorm();
}

TEST(DampedLeastSquares, IsAMinimumForAnyNumberOfJoints) {
  RandomStream stream{451};
  const DampingOptions options{.length_m = 0.5, .damping = 0.1};
  for (int joints = 2; joints <= kMaxJoints; ++joints) {
    for (int trial = 0; trial < 10; ++trial) {
      const Chain chain = random_arm(stream, joints, Convention::standard_dh, 0.2);
      const JointVector start = random_joints(stream, chain);
      const Eigen::Isometry3d target = displaced(stream, forward(chain, start), 0.02);
      const JointVector q = damped_least_squares(model_of(chain), target, start, options);
      const double least = cost(chain, target, q, start, options);
      EXPECT_LT(least, cost(chain, target, start, start, options));
      for (int i = 0; i < joints; ++i) {
        for (const double step : {1e-4, -1e-4}) {
          JointVector beside = q;
          beside[i] += step;
          EXPECT_GT(cost(chain, target, beside, start, options), least) << joints << ' ' << i;
        }
      }
    }
  }
}

TEST(DampedLeastSquares, AtASingularWristMendsThePositionWithSmallMotions) {
  RandomStream stream{452};
  const Chain chain = wrist_arm();
  for (int trial = 0; trial < 50; ++trial) {
    JointVector start = random_change(stream, 6, 0.5);
    start[4] = 0.0;
    const Eigen::Isometry3d target = displaced(stream, forward(chain, start), 0.005);
    const JointVector q = damped_least_squares(model_of(chain), target, start);
    EXPECT_LT((forward(chain, q).translation() - target.translation()).norm(), 2e-5);
    EXPECT_LT((q - start).cwiseAbs().maxCoeff(), 0.6);  // undamped: no bound
  }
}

TEST(DampedLeastSquares, AtTheTargetStays) {
  const Chain chain = wrist_arm();
  const JointVector start = JointVector::Constant(6, 0.3);
  EXPECT_EQ(damped_least_squares(model_of(chain), forward(chain, start), start), start);
}

}  // namespace
}  // namespace demecal
