// Effects' columns over a field: what the corrected robot does, per unit of every coefficient.
#include <gtest/gtest.h>

#include "measured_arm.hpp"
#include "prediction/random_effects.hpp"

namespace demecal {
namespace {

/// Poses that measured position alone and with orientation, exactly.
KnownArm exact_arm(RandomStream& stream, Arm kind, int poses) {
  KnownArm arm = arm_of(stream, laden_arm(stream, kind));
  measure_anyhow(arm, stream, {}, poses / 2);
  measure_anyhow(arm, stream, {.orientation = true}, poses - poses / 2);
  return arm;
}

/// The residual (in scales) of the exact arm where the model has the effect.
Eigen::VectorXd residual_with(const KnownArm& arm, const Effect& effect) {
  CorrectedRobot robot = arm.truth;
  robot.effects = {effect};
  return residual_field(arm.data, all_poses(arm.data), ParameterSpace(robot, {}), kScales, false).residual;
}

TEST(EffectColumns, AreWhatEveryLawsCoefficientsChange) {
  RandomStream stream{83, 1};
  for (const Arm kind : kArms) {
    const KnownArm arm = exact_arm(stream, kind, 8);
    const ResidualField field = field_of(arm, {.registration = true});
    const std::vector<Effect> effects = random_effects(arm.data.robot, stream, 1e-6, 6);
    const EffectColumns columns = columns_of(effects, arm.data.robot, field);
    for (std::size_t i = 0; i < effects.size(); ++i) {
      const RowMatrix dense = columns.dense(field, i);
      ASSERT_EQ(dense.cols(), static_cast<Eigen::Index>(effects[i].values.size()));
      for (Eigen::Index k = 0; k < dense.cols(); ++k) {
        Effect up = effects[i];
        const double size = effects[i].values[static_cast<std::size_t>(k)];
        up.values.assign(up.values.size(), 0.0);
        Effect down = up;
        up.values[static_cast<std::size_t>(k)] = size;
        down.values[static_cast<std::size_t>(k)] = -size;
        const Eigen::VectorXd change = 0.5 * (residual_with(arm, down) - residual_with(arm, up));
        EXPECT_LT((change - size * dense.col(k)).norm(), 1e-5 * change.norm() + 1e-9)
            << effects[i].kind << ' ' << effects[i].form << ' ' << effects[i].joint + 1 << ' ' << k;
      }
    }
  }
}

TEST(EffectColumns, ProductsAreThoseOfTheDenseColumns) {
  RandomStream stream{83, 2};
  const KnownArm arm = exact_arm(stream, Arm::modified, 30);
  const ResidualField field = field_of(arm, {.registration = true});
  const std::vector<Effect> effects = random_effects(arm.data.robot, stream, 1e-4, 4);
  const EffectColumns columns = columns_of(effects, arm.data.robot, field);
  const RowMatrix rows = random_matrix(stream, field.rows(), 5);
  const Eigen::MatrixXd product = columns.transposed_times(field, rows);
  const Eigen::MatrixXf rough = transposed_times(columns.blocks(), field.first_row, field.motions, columns.size(),
                                                 RowMatrixF(rows.cast<float>()));
  ASSERT_EQ(columns.spans().size(), effects.size());
  ASSERT_EQ(product.rows(), columns.size());
  const std::vector<Eigen::MatrixXd> squares = columns.squares(field);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const auto [first, count] = columns.spans()[i];
    const RowMatrix dense = columns.dense(field, i);
    const Eigen::MatrixXd expected = dense.transpose() * rows;
    const double size = dense.norm() * rows.norm();
    EXPECT_LT((product.middleRows(first, count) - expected).norm(), 1e-12 * size) << effects[i].kind;
    EXPECT_LT((squares[i] - dense.transpose() * dense).norm(), 1e-12 * dense.squaredNorm()) << effects[i].kind;
    EXPECT_LT((rough.middleRows(first, count).cast<double>() - expected).norm(), 1e-5 * size) << effects[i].kind;
  }
}

TEST(EffectColumns, OfAnEffectThatDoesNothingAreZero) {
  RandomStream stream{83, 3};
  KnownArm arm = exact_arm(stream, Arm::standard, 6);
  for (MeasuredPose& pose : arm.data.poses) pose.approach.reset();
  const ResidualField field = field_of(arm, {.registration = true});
  const std::vector<Effect> effects = {{.kind = "backlash", .joint = 1, .settings = {}, .form = "approach"},
                                       {.kind = "gain", .joint = 2}};
  const EffectColumns columns = columns_of(effects, arm.data.robot, field);
  EXPECT_EQ(columns.dense(field, 0), RowMatrix::Zero(field.rows(), 1));
  EXPECT_GT(columns.dense(field, 1).norm(), 1.0);
}

TEST(EffectColumns, AppendedWithoutPosesAreEmpty) {
  RandomStream stream{83, 4};
  const KnownArm arm = exact_arm(stream, Arm::standard, 6);
  const ResidualField field = residual_field(arm.data, {}, space_of(arm, arm.truth, kPlacedAndZeroed), kScales, false);
  const EffectColumns columns = columns_of({{.kind = "gain", .joint = 2}}, arm.data.robot, field);
  EXPECT_EQ(columns.dense(field, 0).rows(), 0);
  EXPECT_EQ(columns.dense(field, 0).cols(), 1);
}

}  // namespace
}  // namespace demecal
