// Amplitudes of several joints' corrections: what they come to, and that fitting them never makes it worse.
#include <gtest/gtest.h>

#include "distal/index.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

constexpr int kRows = 3;
const std::vector<std::size_t> kJoints{0, 1, 3};

Eigen::VectorXd random_vector(RandomStream& random, Eigen::Index size) {
  Eigen::VectorXd vector(size);
  for (double& value : vector) value = random.real(-1, 1);
  return vector;
}

/// Of four joints, all of which are corrected.
std::vector<LinearizedPose> random_poses(RandomStream& random) {
  std::vector<LinearizedPose> poses(40);
  for (LinearizedPose& pose : poses) {
    pose = {random_vector(random, 4), random_vector(random, kRows), Eigen::MatrixXd(kRows, 4)};
    for (Eigen::Index joint = 0; joint < 4; ++joint) pose.jacobian_mm.col(joint) = random_vector(random, kRows);
  }
  return poses;
}

/// Two for each of kJoints, after each other.
std::vector<CorrectionShape> random_shapes(RandomStream& random) {
  std::vector<CorrectionShape> shapes;
  for (const std::size_t joint : kJoints) {
    for (int i = 0; i < 2; ++i) {
      const Eigen::VectorXd values = random_vector(random, 40);
      shapes.push_back({joint, {values.begin(), values.end()}});
    }
  }
  return shapes;
}

/// With chosen shapes times factors instead of the corrections of kJoints.
double index_by_hand(const std::vector<LinearizedPose>& poses, const std::vector<CorrectionShape>& shapes,
                     const std::vector<std::size_t>& chosen, const std::vector<double>& factors) {
  double sum = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Eigen::VectorXd left = poses[i].residual_mm;
    for (const std::size_t joint : kJoints) {
      const auto at = static_cast<Eigen::Index>(joint);
      left += poses[i].jacobian_mm.col(at) * poses[i].correction[at];
    }
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const CorrectionShape& shape = shapes[chosen[k]];
      left -= poses[i].jacobian_mm.col(static_cast<Eigen::Index>(shape.joint)) * factors[k] * shape.value_rad[i];
    }
    sum += left.squaredNorm();
  }
  return sum;
}

const std::vector<std::vector<std::size_t>> kChoices{{}, {1}, {0, 3}, {5, 1, 2}, {0, 2, 4}};

TEST(AmplitudeFit, TellsTheLinearizedIndex) {
  RandomStream random{41};
  for (int trial = 0; trial < 50; ++trial) {
    const auto poses = random_poses(random);
    const auto shapes = random_shapes(random);
    const AmplitudeFit fit(poses, kJoints, shapes);
    for (const auto& chosen : kChoices) {
      for (const ChosenShapes& as : {fit.unscaled(chosen), fit.fitted(chosen)}) {
        ASSERT_EQ(as.factor.size(), chosen.size());
        const double expected = index_by_hand(poses, shapes, chosen, as.factor);
        EXPECT_NEAR(as.index_mm2, expected, 1e-9 * expected);
      }
      for (const double factor : fit.unscaled(chosen).factor) EXPECT_EQ(factor, 1.0);
    }
  }
}

TEST(AmplitudeFit, NeverRaisesTheIndexAndLeavesAlmostNothingToGain) {
  RandomStream random{42};
  for (int trial = 0; trial < 50; ++trial) {
    const auto poses = random_poses(random);
    const auto shapes = random_shapes(random);
    const AmplitudeFit fit(poses, kJoints, shapes);
    for (const auto& chosen : kChoices) {
      const ChosenShapes fitted = fit.fitted(chosen);
      EXPECT_LE(fitted.index_mm2, fit.unscaled(chosen).index_mm2 * (1.0 + 1e-12));
      for (std::size_t k = 0; k < chosen.size(); ++k) {
        for (const double change : {-0.03, 0.03}) {
          std::vector<double> other = fitted.factor;
          other[k] += change;
          EXPECT_GT(index_by_hand(poses, shapes, chosen, other), fitted.index_mm2);
        }
      }
    }
  }
}

TEST(AmplitudeFit, FindsTheFactorsThatLeaveNothing) {
  RandomStream random{43};
  for (int trial = 0; trial < 50; ++trial) {
    auto poses = random_poses(random);
    const auto shapes = random_shapes(random);
    const std::vector<std::size_t> chosen{1, 3, 4};
    const std::vector<double> factors{random.real(0.3, 3), random.real(0.3, 3), random.real(0.3, 3)};
    for (std::size_t i = 0; i < poses.size(); ++i) {
      poses[i].residual_mm.setZero();
      for (std::size_t k = 0; k < chosen.size(); ++k) {
        const auto joint = static_cast<Eigen::Index>(kJoints[k]);
        const double more = factors[k] * shapes[chosen[k]].value_rad[i] - poses[i].correction[joint];
        poses[i].residual_mm += poses[i].jacobian_mm.col(joint) * more;
      }
    }
    const ChosenShapes fitted = AmplitudeFit(poses, kJoints, shapes).fitted(chosen);
    for (std::size_t k = 0; k < chosen.size(); ++k) EXPECT_NEAR(fitted.factor[k], factors[k], 0.02);
  }
}

TEST(AmplitudeFit, LeavesWhatIsHeldAsItIs) {
  RandomStream random{45};
  for (int trial = 0; trial < 50; ++trial) {
    const auto poses = random_poses(random);
    const auto shapes = random_shapes(random);
    const AmplitudeFit fit(poses, kJoints, shapes);
    const std::vector<std::size_t> chosen{5, 1, 2}, held{1};
    const ChosenShapes fitted = fit.fitted(chosen, held);
    EXPECT_NEAR(fitted.factor[1], 1.0, 1e-6);
    EXPECT_LE(fitted.index_mm2, fit.unscaled(chosen).index_mm2 * (1.0 + 1e-12));
    EXPECT_GT(fitted.index_mm2, 0.99 * fit.fitted(chosen).index_mm2);
  }
}

/// One joint's motion is the other's: only the sum of both corrections shows.
TEST(AmplitudeFit, LetsNoneOfTwoJointsGrowThatAreNotToBeToldApart) {
  RandomStream random{44};
  auto poses = random_poses(random);
  auto shapes = random_shapes(random);
  for (LinearizedPose& pose : poses) pose.jacobian_mm.col(1) = pose.jacobian_mm.col(0);
  shapes[2].value_rad = shapes[0].value_rad;
  const std::vector<std::size_t> both{0, 2};
  const ChosenShapes fitted = AmplitudeFit(poses, kJoints, shapes).fitted(both);
  EXPECT_NEAR(fitted.factor[0], fitted.factor[1], 1e-6);
  EXPECT_LT(std::abs(fitted.factor[0]), 10.0);
}

}  // namespace
}  // namespace demecal
