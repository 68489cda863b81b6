// Tests that name no effect: dependence of the residual on circumstances, and scatter against repeats.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

#include "measured_arm.hpp"
#include "residuals/found_noise.hpp"
#include "residuals/structure.hpp"

namespace demecal {
namespace {

struct TestedArm {
  KnownArm arm;
  ResidualField field;
};

TestedArm tested_arm(RandomStream& stream, int poses) {
  TestedArm made{arm_of(stream, laden_arm(stream, Arm::standard)), {}};
  measure_anyhow(made.arm, stream, {.noise_m = 5e-5}, poses);
  made.field = field_of(made.arm, {.registration = true, .joint_offset = true});
  return made;
}

double p_value(const TestedArm& tested, std::uint64_t seed) {
  return structure_p_value(tested.field, projection_of(tested.field), tested.arm.data.robot.chain, 99,
                           RandomStream{86, seed});
}

/// Fresh noise and an error of a joint that is `error` of the state, its root mean square `size` times the noise.
template <typename Error>
void plant(TestedArm& tested, int joint, double size, RandomStream& stream, const Error& error) {
  renew_noise(tested.field, stream);
  Eigen::VectorXd signal = tested.field.motions.col(motion_column(joint, kTurnAboutZ));
  for (std::size_t i = 0; i < tested.field.states.size(); ++i) {
    signal.segment(tested.field.first_row[i], tested.field.rows_of_pose(i)) *= error(tested.field.states[i]);
  }
  tested.field.residual += size * std::sqrt(static_cast<double>(tested.field.rows())) * signal.normalized();
}

TEST(Structure, IsFoundWhateverTheResidualDependsOn) {
  RandomStream stream{86, 1};
  TestedArm tested = tested_arm(stream, 120);
  for (ArmState& state : tested.field.states) state.stop.payload_kg = stream.chance(0.5) ? 3.0 : 0.0;
  const Chain& chain = tested.arm.data.robot.chain;
  const auto expect_found = [&](const char* circumstance, int joint, const auto& error) {
    plant(tested, joint, 1.0, stream, error);
    EXPECT_LE(p_value(tested, 2), 0.05) << circumstance;
  };
  expect_found("joint", 1, [](const ArmState& state) { return std::sin(2 * state.joints()[1]); });
  expect_found("another joint", 1, [](const ArmState& state) { return std::cos(state.joints()[4]); });
  expect_found("pair of joints", 2,
               [](const ArmState& state) { return std::sin(state.joints()[1] + state.joints()[3]); });
  expect_found("approach", 2, [](const ArmState& state) { return state.approach(2); });
  expect_found("torque", 3, [&](const ArmState& state) { return std::tanh(state.torque(chain, 3)); });
  expect_found("payload", 1, [](const ArmState& state) { return state.stop.payload_kg - 1.5; });
  expect_found("temperature", 0, [](const ArmState& state) { return *state.stop.temperature_celsius - 28; });
  expect_found("time", 4, [](const ArmState& state) { return std::sin(*state.stop.time_s / 100); });
}

TEST(Structure, IsFoundOfPosesThatMeasuredDifferentThings) {
  RandomStream stream{86, 3};
  TestedArm tested{arm_of(stream, laden_arm(stream, Arm::standard)), {}};
  measure_anyhow(tested.arm, stream, {.noise_m = 5e-5}, 60);
  measure_anyhow(tested.arm, stream, {.noise_m = 5e-5, .noise_rad = 1e-4, .orientation = true}, 60);
  tested.field = field_of(tested.arm, {.registration = true});
  plant(tested, 1, 1.0, stream, [](const ArmState& state) { return std::sin(state.joints()[1]); });
  EXPECT_LE(p_value(tested, 4), 0.05);
}

TEST(Structure, IsFoundInNoiseAsOftenAsItsPValuesSay) {
  RandomStream stream{86, 5};
  TestedArm tested = tested_arm(stream, 50);
  constexpr int kDraws = 100;
  int rare = 0;
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    renew_noise(tested.field, stream);
    const double p = p_value(tested, 100 + static_cast<std::uint64_t>(draw));
    rare += p <= 0.05;
    sum += p;
  }
  EXPECT_LE(rare, 12);
  EXPECT_NEAR(sum / kDraws, 0.5, 0.15);
}

TEST(NullResiduals, OfSomePosesScatterAsIfAllHadBeenDrawn) {
  RandomStream stream{86, 8};
  TestedArm tested = tested_arm(stream, 620);
  renew_noise(tested.field, stream);
  const Projection model = projection_of(tested.field);
  std::vector<std::size_t> poses;
  std::vector<Eigen::Index> rows;
  for (std::size_t pose = 0; pose < 100; ++pose) {
    poses.push_back(pose);
    for (Eigen::Index row = 0; row < 3; ++row) rows.push_back(tested.field.first_row[pose] + row);
  }
  constexpr Eigen::Index kDraws = 2000;
  const NullResiduals drawn = null_residuals(tested.field, model, poses);
  ASSERT_GT(drawn.others_root.size(), 0);
  const NullResiduals whole{drawn.noise, poses, model.basis(), model.prior_basis(), {}, model.squares()};
  const Eigen::MatrixXd some = drawn.draw(kDraws, stream), all = whole.draw(kDraws, stream);
  EXPECT_NEAR(some.squaredNorm() / all.squaredNorm(), 1.0, 0.01);
  // Along what the model follows, where the other poses' say shows most.
  const Eigen::MatrixXd basis = model.basis()(rows, Eigen::all);
  const Eigen::VectorXd followed = (basis.transpose() * some).rowwise().squaredNorm(),
                        wanted = (basis.transpose() * all).rowwise().squaredNorm();
  for (Eigen::Index i = 0; i < wanted.size(); ++i) EXPECT_NEAR(followed[i] / wanted[i], 1.0, 0.2) << i;
}

TEST(Structure, IsAFunctionOfItsSeed) {
  RandomStream stream{86, 6};
  const TestedArm tested = tested_arm(stream, 40);
  EXPECT_EQ(p_value(tested, 7), p_value(tested, 7));
}

TEST(Structure, IsNotFoundInAHandfulOfPoses) {
  RandomStream stream{86, 8};
  EXPECT_EQ(p_value(tested_arm(stream, 3), 9), 1.0);
}

DataSet repeats(const std::vector<std::pair<std::string, Eigen::Vector3d>>& positions) {
  DataSet data;
  for (const auto& [id, position_m] : positions) {
    MeasuredPose pose;
    pose.pose_id = id;
    pose.position_m = position_m;
    data.poses.push_back(pose);
  }
  return data;
}

TEST(PureError, IsTheScatterOfRepeatsAboutTheirMeans) {
  const DataSet data = repeats({{"A", {0.001, 0, 0}},
                                {"B", {5, 5, 5}},
                                {"A", {-0.001, 0, 0}},
                                {"C", {1, 0, 0}},
                                {"C", {1, 0.003, 0}},
                                {"C", {1, -0.003, 0}}});
  const auto pure = pure_error(data, all_poses(data));
  ASSERT_TRUE(pure.has_value());
  EXPECT_DOUBLE_EQ(pure->freedom, 9.0);
  EXPECT_NEAR(pure->squares, 2e-6 + 18e-6, 1e-15);
  EXPECT_NEAR(pure->deviation_m, std::sqrt(20e-6 / 9), 1e-12);
}

TEST(PureError, CountsRepeatsInUnitsOfTheirStation) {
  DataSet data = repeats({{"A", {0.001, 0, 0}}, {"A", {-0.001, 0, 0}}, {"B", {0, 0.01, 0}}, {"B", {0, -0.01, 0}}});
  data.poses[2].station = data.poses[3].station = "coarse";
  RowScales scales;
  scales.stations = {{"coarse", {10.0, 1.0, 1.0}}};
  EXPECT_NEAR(pure_error(data, all_poses(data))->squares, 2e-6 + 2e-4, 1e-15);
  EXPECT_NEAR(pure_error(data, all_poses(data), scales)->squares, 2e-6 + 2e-6, 1e-15);
}

TEST(PureError, NeedsRepeats) {
  EXPECT_FALSE(pure_error(repeats({{"A", {1, 0, 0}}, {"B", {1, 0, 0}}}), std::vector<std::size_t>{0, 1}).has_value());
  EXPECT_FALSE(pure_error(repeats({{"", {1, 0, 0}}, {"", {1, 0, 0}}}), std::vector<std::size_t>{0, 1}).has_value());
  DataSet targets = repeats({{"A", {1, 0, 0}}, {"A", {2, 0, 0}}});
  targets.poses[1].target = "ball 2";
  EXPECT_FALSE(pure_error(targets, all_poses(targets)).has_value());
  DataSet sides = repeats({{"A", {1, 0, 0}}, {"A", {1.001, 0, 0}}});
  for (MeasuredPose& pose : sides.poses) pose.approach = ApproachSigns::Ones(6);
  EXPECT_TRUE(pure_error(sides, all_poses(sides)).has_value());
  (*sides.poses[1].approach)[2] = -1.0;
  EXPECT_FALSE(pure_error(sides, all_poses(sides)).has_value());
}

/// F with `numerator` and `denominator` degrees of freedom.
double p_of(double ratio, double numerator, double denominator) {
  const PureError pure{0.0, denominator, denominator};
  return lack_of_fit_p_value(pure, denominator + numerator * ratio, numerator + denominator);
}

TEST(LackOfFit, HasThePValuesOfTheTablesOfF) {
  EXPECT_NEAR(p_of(4.965, 1, 10), 0.05, 1e-4);
  EXPECT_NEAR(p_of(3.326, 5, 10), 0.05, 1e-4);
  EXPECT_NEAR(p_of(2.348, 10, 20), 0.05, 1e-4);
  EXPECT_NEAR(p_of(1.534, 60, 60), 0.05, 2e-4);
  EXPECT_NEAR(p_of(5.953, 3, 12), 0.01, 1e-4);
  EXPECT_NEAR(p_of(3.368, 10, 20), 0.01, 1e-4);
}

TEST(LackOfFit, IsNoneWhereTheModelScattersNoMoreThanRepeats) {
  const PureError pure{1e-4, 30, 30e-8};
  EXPECT_EQ(lack_of_fit_p_value(pure, 20e-8, 100), 1.0);
  EXPECT_EQ(lack_of_fit_p_value(pure, 60e-8, 30), 1.0);
  EXPECT_EQ(lack_of_fit_p_value({0.0, 30, 0.0}, 1e-8, 100), 0.0);
}

}  // namespace
}  // namespace demecal
