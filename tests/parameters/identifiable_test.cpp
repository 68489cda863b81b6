// What poses cannot see is found, named and held.
#include "parameters/parameter_space.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/known_arm.hpp"
#include "fitting/row_sums.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Eigen::MatrixXd random_matrix(RandomStream& stream, int rows, int columns) {
  Eigen::MatrixXd matrix(rows, columns);
  for (double& value : matrix.reshaped()) value = stream.normal();
  return matrix;
}

std::vector<ParameterId> some_links(int count) {
  std::vector<ParameterId> ids(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) ids[static_cast<std::size_t>(i)].index = i;
  return ids;
}

std::vector<std::string> sentences(const Fit& fit) {
  std::vector<std::string> result;
  for (const UnidentifiedDirection& direction : fit.unidentified) result.push_back(direction.sentence());
  return result;
}

TEST(TriangularFactor, HasTheProductsOfAnyNumberOfRows) {
  RandomStream stream{61};
  for (const int rows : {0, 3, 7, 600, 1300}) {
    const Eigen::MatrixXd matrix = random_matrix(stream, rows, 5);
    TriangularFactor factor(5);
    factor.add(matrix.topRows(rows / 2));
    factor.add(matrix.bottomRows(rows - rows / 2));
    const Eigen::MatrixXd r = factor.factor();
    EXPECT_TRUE(r.isUpperTriangular());
    EXPECT_LT((r.transpose() * r - matrix.transpose() * matrix).norm(), 1e-11 * (1 + rows));
  }
}

TEST(Identifiable, SplitsARandomJacobianByItsRank) {
  RandomStream stream{62};
  for (int rank = 1; rank <= 6; ++rank) {
    const Eigen::MatrixXd jacobian = random_matrix(stream, 6, rank) * random_matrix(stream, rank, 6);
    const auto ids = some_links(6);
    const IdentifiableSubspace seen = identifiable_subspace(ScaledJacobian(jacobian), ids, 1e-9);
    ASSERT_EQ(seen.basis.cols(), rank);
    EXPECT_EQ(seen.held.size(), static_cast<std::size_t>(6 - rank));
    const Eigen::MatrixXd image = jacobian * seen.basis;
    EXPECT_LT((image.transpose() * image - Eigen::MatrixXd::Identity(rank, rank)).norm(), 1e-9);
  }
}

TEST(Identifiable, HoldsAParameterWithoutEffectThoughRoundingGivesItSome) {
  RandomStream stream{63};
  Eigen::MatrixXd jacobian = random_matrix(stream, 10, 3);
  jacobian.col(1) *= 1e-17;
  const IdentifiableSubspace seen = identifiable_subspace(ScaledJacobian(jacobian), some_links(3), 1e-9);
  ASSERT_EQ(seen.held.size(), 1u);
  EXPECT_EQ(seen.held[0].sentence(), "joint 2 theta_deg does not show in these poses");
}

TEST(Identifiable, LaysAtTheBaseWhatBaseOrJointCouldExplain) {
  RandomStream stream{64};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
  arm.truth.chain.joints[0].d_m += 2e-3;
  arm.truth.chain.joints[0].theta_rad += 3e-3;
  measure(arm, stream, {}, 60);
  const Fit fit = fit_all(arm, kAll);
  EXPECT_LT(largest_error_m(fit.robot, arm, stream), 1e-8);
  EXPECT_NEAR(fit.robot.chain.joints[0].d_m, arm.data.robot.chain.joints[0].d_m, 1e-6);
  EXPECT_NEAR(fit.robot.chain.joints[0].theta_rad, arm.data.robot.chain.joints[0].theta_rad, 1e-6);
  EXPECT_NEAR(fit.robot.sensor_from_base.translation().z(), 2e-3, 1e-6);
}

TEST(Identifiable, NamesTheRedundanciesOfBaseAndFirstJointAndOfToolAndLast) {
  RandomStream stream{65};
  KnownArm arm = perfect_arm(parallel_arm(), Frame::sensor);
  measure(arm, stream, {.orientation = true}, 60);
  const Fit fit = fit_all(arm, kAll);
  EXPECT_EQ(fit.rank, 30);  // 4 per revolute joint and 6: Everett, Driels and Mooring 1987
  EXPECT_EQ(fit.unidentified.size(), 6u);
  const auto both = [](const char* one, const char* other) {
    return Contains(AllOf(HasSubstr(one), HasSubstr(other), HasSubstr(" have the same effect in these poses")));
  };
  EXPECT_THAT(sentences(fit), both("joint 1 d_mm", "base_z_mm"));
  EXPECT_THAT(sentences(fit), both("joint 1 theta_deg", "base_rz_deg"));
  EXPECT_THAT(sentences(fit), both("joint 6 d_mm", "tool_z_mm"));
  for (const UnidentifiedDirection& direction : fit.unidentified) {
    EXPECT_FALSE(direction.weak);
    EXPECT_LT(direction.relative_singular, 1e-9);
    EXPECT_GT(direction.parts[0].second, 0.0);
  }
}

TEST(Identifiable, CountsTheDirectionsThatPositionsSeeOfEveryArm) {
  RandomStream stream{66};
  const auto rank = [&](const Chain& chain) {
    KnownArm arm = perfect_arm(chain, Frame::sensor);
    measure(arm, stream, {}, 60);
    return fit_all(arm, kAll).rank;
  };
  EXPECT_EQ(rank(parallel_arm()), 4 * 6 + 3);
  EXPECT_EQ(rank(modified_arm()), 4 * 6 + 3);
  EXPECT_EQ(rank(seven_joint_arm()), 4 * 7 + 3);
  EXPECT_EQ(rank(stanford_arm()), 4 * 5 + 3 + 2);
}

TEST(Identifiable, FindsThatAToolOnTheLastAxisHidesTheLastJoint) {
  RandomStream stream{67};
  Chain chain = parallel_arm();
  chain.tool_m = {0, 0, 0.1};
  KnownArm arm = perfect_arm(chain, Frame::base);
  measure(arm, stream, {}, 60);
  const Fit fit = fit_all(arm, {.joint_offset = true});
  EXPECT_EQ(fit.rank, 5);
  EXPECT_THAT(sentences(fit), ::testing::ElementsAre("joint 6 theta_deg does not show in these poses"));
  EXPECT_EQ(fit.estimates[5].value, 0.0);
  EXPECT_EQ(fit.estimates[5].standard_error, 0.0);
}

TEST(Identifiable, KeepsNearNominalWhatThePosesHardlyShow) {
  RandomStream stream{68};
  Chain chain = parallel_arm();
  chain.tool_m = {1e-4, 0, 0.1};  // a tenth of a millimetre off the last axis
  KnownArm arm = perfect_arm(chain, Frame::base);
  measure(arm, stream, {.noise_m = 1e-4}, 60);
  const Fit fit = fit_all(arm, {.joint_offset = true});
  ASSERT_EQ(fit.unidentified.size(), 1u);
  EXPECT_TRUE(fit.unidentified[0].weak);
  EXPECT_THAT(fit.unidentified[0].sentence(), AllOf(StartsWith("joint 6 theta_deg"), HasSubstr("kept near nominal")));
  EXPECT_LT(std::abs(fit.estimates[5].value), 0.05);
  const Fit unbelieving = fit_all(arm, {.joint_offset = true}, {.prior_m = 0, .prior_rad = 0});
  EXPECT_TRUE(unbelieving.unidentified.empty());
  EXPECT_GT(unbelieving.estimates[5].standard_error, 3 * fit.estimates[5].standard_error);
}

}  // namespace
}  // namespace demecal
