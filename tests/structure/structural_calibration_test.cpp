// Structures of simulated arms are fitted, found, and better than links alone on poses that had no part in anything.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "errors/input_error.hpp"
#include "random_structure.hpp"
#include "structure/structural_calibration.hpp"

namespace demecal {
namespace {

const Gene kTurnY{true, 1}, kTurnX{true, 0}, kShiftX{false, 0};

struct Measured {
  DataSet data;
  StructuredArm truth;
};

Chain puma() {
  Chain chain = wrist_arm();
  chain.tool_m = {0.15025, 0.00163, 0.05569};
  for (Joint& joint : chain.joints) joint.lower = -1.0, joint.upper = 1.0;
  return chain;
}

/// 30 + 30 poses, noisy, and 30 exact ones to judge by at the end.
Measured measured(const Genome& genome, std::vector<double> values, double noise_m, std::uint64_t seed) {
  RandomStream stream{1221, seed};
  Measured result{data_of(puma()), {placed_robot(stream, puma()), genome, std::move(values)}};
  measure(result.data, result.truth, stream, PoseSet::calibration, 30, noise_m);
  measure(result.data, result.truth, stream, PoseSet::validation, 30, noise_m);
  measure(result.data, result.truth, stream, PoseSet::accept, 30, 0.0);
  return result;
}

double accept_mm(const CorrectedRobot& robot, const DataSet& data) {
  return error_figures(robot, data, poses_of(data, PoseSet::accept)).mean_mm;
}

StructureProblem problem_of(const Measured& arm) {
  CorrectedRobot start = arm.truth.robot;
  start.sensor_from_base.translation() += Eigen::Vector3d(0.002, -0.001, 0.001);
  return structure_problem(arm.data, {true, false, {}}, start, poses_of(arm.data, PoseSet::calibration),
                           poses_of(arm.data, PoseSet::validation));
}

TEST(StructureFit, FindsTheAmountsOfAKnownStructure) {
  const Genome genome{{}, {kTurnY, kShiftX}, {}, {kTurnX}, {}, {}};
  const Measured arm = measured(genome, {0.003, -0.001, 0.002}, 0.0, 1);
  const StructureProblem problem = problem_of(arm);
  const StructureFit fit = fit_structure(problem, genome);
  EXPECT_TRUE(fit.solved);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(fit.arm.values[i], arm.truth.values[i], 1e-9);
  EXPECT_LT(fit.selection_cost, 1e-12);
}

TEST(StructureFit, SolvesStructuresWhoseJacobianIsSingular) {
  const Measured arm = measured({{}, {kTurnY}, {}, {}, {}, {}}, {0.003}, 0.0, 2);
  // The second turn about y says what the first does, since the one about x between them begins at nothing.
  const StructureFit fit = fit_structure(problem_of(arm), {{}, {kTurnY, kTurnX, kTurnY}, {}, {}, {}, {}});
  EXPECT_TRUE(fit.solved);
  EXPECT_LT(fit.selection_cost, 1e-6);
  EXPECT_NEAR(fit.arm.values[0] + fit.arm.values[2], 0.003, 1e-6);
}

TEST(StructureFit, RefusesMoreNumbersThanRows) {
  Measured arm = measured({{}, {kTurnY}, {}, {}, {}, {}}, {0.003}, 0.0, 3);
  arm.data.poses.erase(arm.data.poses.begin() + 2, arm.data.poses.begin() + 30);
  const StructureFit fit = fit_structure(problem_of(arm), {{}, {kTurnY}, {}, {}, {}, {}});
  EXPECT_FALSE(fit.solved);
  EXPECT_TRUE(std::isinf(fit.selection_cost));
}

TEST(StructureFit, StandardErrorsAreTheScatterOfRepeatedExperiments) {
  constexpr int kExperiments = 60;
  const Genome genome{{}, {kTurnY}, {}, {}, {}, {}};
  double squares = 0.0, expected = 0.0;
  for (int i = 0; i < kExperiments; ++i) {
    const Measured arm = measured(genome, {0.003}, 1e-4, static_cast<std::uint64_t>(100 + i));
    const StructureProblem problem = problem_of(arm);
    const std::vector<FoundTransform> found = found_transforms(problem, fit_structure(problem, genome));
    ASSERT_EQ(found.size(), 1U);
    squares += std::pow(found[0].value - 0.003, 2) / kExperiments;
    expected += std::pow(found[0].standard_error, 2) / kExperiments;
  }
  EXPECT_NEAR(std::sqrt(squares / expected), 1.0, 0.3);
}

class KnownStructure : public testing::TestWithParam<std::uint64_t> {};

TEST_P(KnownStructure, FindsAnEquivalentOfAKnownExtraTransformAndBeatsLinksOnAcceptPoses) {
  // About 3 mm at the tool, of a kind that a link between parallel axes has no number for.
  const Measured arm = measured({{}, {kTurnY}, {}, {kShiftX}, {}, {}}, {0.003, 0.0012}, 1e-4, GetParam());
  const auto calibration = poses_of(arm.data, PoseSet::calibration);
  const DeclaredModel declared{.registration = true};
  const Fit registered = fit_registration(arm.data, calibration, declared, nominal_robot(arm.data));
  RandomStream random{GetParam()};
  const StructuralCalibration found =
      calibrate_structure(arm.data, declared, registered.robot, {.population = 30, .generations = 25}, random);
  const Fit links = fit_declared(arm.data, calibration, {.registration = true, .joint_offset = true, .geometry = true},
                                 registered.robot);
  EXPECT_LT(accept_mm(found.robot, arm.data), accept_mm(links.robot, arm.data));
  EXPECT_LT(accept_mm(found.robot, arm.data), 0.1);  // of 1.0 to 3.0 before, with noise of 0.16
  EXPECT_LE(found.transforms.size(), 8U);
  for (const ParameterEstimate& estimate : found.estimates) EXPECT_GT(estimate.standard_error, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, KnownStructure, testing::Values(1, 2, 3));

/// Two targets in turn, the one on the axis of the last joint, where what the structure turns moves it least.
Measured measured_in_turn(const Genome& genome, std::vector<double> values) {
  RandomStream stream{1222};
  Measured result{data_of(puma()), {placed_robot(stream, puma()), genome, std::move(values)}};
  result.data.tools_m = {{"axis", Eigen::Vector3d::Zero()}, {"far", {0.15, 0.0, 0.0}}};
  result.truth.robot.tools = nominal_robot(result.data).tools;
  for (int i = 0; i < 120; ++i) {
    MeasuredPose pose;
    pose.target = i % 2 == 0 ? "axis" : "far";
    pose.set = i < 60 ? PoseSet::calibration : PoseSet::validation;
    pose.joints = random_joints(stream, puma());
    pose.position_m = result.truth.predict(pose.joints, pose.target).translation();
    result.data.poses.push_back(pose);
  }
  return result;
}

TEST(StructureSearch, LearnsFromEveryTargetMeasuredInTurn) {
  const Measured arm = measured_in_turn({{}, {}, {}, {}, {}, {kTurnY}}, {0.003});
  RandomStream random{8};
  const StructureFound found =
      search_structure(problem_of(arm), {.population = 20, .generations = 10, .most_poses = 30}, random);
  EXPECT_LT(found.fit.selection_cost, 1e-3);
}

TEST(StructureSearch, GivesTheSameOnEveryRun) {
  const Measured arm = measured({{}, {kTurnY}, {}, {}, {}, {}}, {0.003}, 1e-4, 4);
  const StructureOptions options{.population = 10, .generations = 5};
  RandomStream first{7}, second{7};
  const StructureFound a = search_structure(problem_of(arm), options, first);
  const StructureFound b = search_structure(problem_of(arm), options, second);
  EXPECT_EQ(a.fit.arm.genome, b.fit.arm.genome);
  EXPECT_EQ(a.fit.arm.values, b.fit.arm.values);
  EXPECT_EQ(a.evaluations, b.evaluations);
}

TEST(StructureSearch, BestNeverWorsensAndStopsWhenTold) {
  const Measured arm = measured({{}, {kTurnY}, {}, {}, {}, {}}, {0.003}, 1e-4, 5);
  RandomStream random{8};
  double before = std::numeric_limits<double>::infinity();
  const auto watch = [&](int generation, double best) {
    EXPECT_LE(best, before);
    before = best;
    return generation < 4;
  };
  EXPECT_EQ(search_structure(problem_of(arm), {.population = 10, .generations = 50}, random, watch).generations, 4);
}

TEST(StructureSearch, NeedsPosesToJudgeBy) {
  Measured arm = measured({{}, {kTurnY}, {}, {}, {}, {}}, {0.003}, 1e-4, 6);
  for (MeasuredPose& pose : arm.data.poses) pose.set = PoseSet::calibration;
  RandomStream random{9};
  EXPECT_THROW(calibrate_structure(arm.data, {.registration = true}, arm.truth.robot, {}, random), InputError);
}

TEST(FoundTransform, SaysWhereItStandsAndByHowMuch) {
  const FoundTransform turn{1, kTurnY, 0.001, 0.0001}, shift{3, kShiftX, -0.0012, 0.0001};
  EXPECT_EQ(turn.name(), "after link 2 Ry_deg");
  EXPECT_EQ(shift.name(), "after link 4 Tx_mm");
  EXPECT_NEAR(turn.at_border(turn.value), 0.0573, 1e-4);
  EXPECT_NEAR(shift.at_border(shift.value), -1.2, 1e-12);
}

}  // namespace
}  // namespace demecal
