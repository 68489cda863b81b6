// Distal learning: the index of the whole model, each joint's part in it, and steps that only ever lower it.
#include <gtest/gtest.h>

#include "calibration/island_evolution.hpp"
#include "distal/learning.hpp"
#include "distal_arm.hpp"
#include "fitness/fitness.hpp"

namespace demecal {
namespace {

EvolverFunction in_this_thread(const Job& job) {
  return EvolverFunction([&job](const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) {
    GpParameters parameters = job.gp;
    parameters.number_generations = terms.generations;
    EvolvedJoints evolved;
    for (const JointTraining& training : trainings) {
      evolved.joints.push_back({training, evolved_front(parameters, training, terms.seed)});
    }
    return evolved;
  });
}

class DistalLearning : public testing::TestWithParam<Measured> {
 protected:
  const DataSet data = measured(GetParam(), 17);
  const Job job = distal_job();
  const Preparation preparation = prepare(data, job);
  const DistalIndex index{data, preparation.targets.poses, preparation.declared};
};

TEST_P(DistalLearning, LinearisesTheIndexForSmallCorrections) {
  RandomStream random{31};
  for (int trial = 0; trial < 20; ++trial) {
    CorrectedRobot robot = corrected_puma(2e-3, random);
    const std::vector<LinearizedPose> poses = index.linearized(robot);
    const CorrectedRobot other = corrected_puma(2e-5, random);
    double expected = 0.0, before = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const JointVector& commanded = data.poses[preparation.targets.poses[i]].joints;
      const JointVector more = other.corrected_joints(commanded) - commanded;
      expected += (poses[i].residual_mm - poses[i].jacobian_mm * more).squaredNorm();
      before += poses[i].residual_mm.squaredNorm();
    }
    ASSERT_NEAR(index(robot), before, 1e-9 * before);
    for (std::size_t joint = 0; joint < 6; ++joint) {
      JointCorrection& one = robot.corrections[joint];
      const Tree both = apply(Primitive::add, one.formula(), other.corrections[joint].formula());
      one = JointCorrection(both, {}, {-M_PI, M_PI});
    }
    ASSERT_NEAR(index(robot), expected, 1e-2 * std::abs(expected - before) + 1e-9 * before);
  }
}

TEST_P(DistalLearning, TableOfAJointIsItsPartOfTheLinearizedIndex) {
  RandomStream random{32};
  const CorrectedRobot robot = corrected_puma(1e-3, random), other = corrected_puma(2e-3, random);
  const std::vector<LinearizedPose> poses = index.linearized(robot);
  for (const JointTraining& like : preparation.training) {
    const JointTraining training = distal_training(like, poses);
    Fitness fitness(training.table);
    const auto joint = static_cast<Eigen::Index>(like.joint);
    double most = 0.0;
    for (const LinearizedPose& pose : poses) most = std::max(most, pose.jacobian_mm.col(joint).squaredNorm());
    if (most == 0.0) continue;
    const auto linearized = [&](const Tree& tree) {
      double sum = 0.0;
      for (std::size_t i = 0; i < poses.size(); ++i) {
        const double theta = like.table.variables[0][i];
        const double more = training.scale_rad * evaluate(tree, {&theta, 1}) - poses[i].correction[joint];
        sum += (poses[i].residual_mm - poses[i].jacobian_mm.col(joint) * more).squaredNorm();
      }
      return sum;
    };
    const Tree one = neutral_tree(), two = apply(Primitive::cosine, variable_tree(0));
    const double factor = most * training.scale_rad * training.scale_rad;
    const double fall = linearized(one) - linearized(two);
    EXPECT_NEAR(factor * (fitness(one) - fitness(two)), fall, 1e-6 * (linearized(one) + linearized(two)));
  }
}

TEST_P(DistalLearning, NeverRaisesTheIndexAndLowersIt) {
  EvolverFunction evolver = in_this_thread(job);
  const DistalOutcome outcome = learn_in_rounds(index, preparation, job, evolver);
  const double before = index(preparation.declared.robot);
  double last = before;
  std::uint32_t generation = 0;
  for (const DistalStep& step : outcome.steps) {
    const bool is_of_the_same_round = step.generation == generation;
    EXPECT_TRUE(is_of_the_same_round ? step.index_mm2 == last : step.index_mm2 < last);
    last = step.index_mm2;
    generation = step.generation;
  }
  EXPECT_EQ(last, outcome.index_mm2);
  EXPECT_EQ(outcome.index_mm2, index(outcome.robot));
  EXPECT_LT(outcome.index_mm2, 0.2 * before);
  const Calibration calibration = conclude(data, job, preparation, outcome.candidates);
  EXPECT_LT(calibration.index_after_mm2, 0.3 * calibration.index_before_mm2);
}

/// A round that brings nothing does not end the learning: the next may.
TEST_P(DistalLearning, GoesOnToTheLastRound) {
  int rounds = 0;
  EvolverFunction often_nothing([&](const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) {
    return ++rounds % 2 == 0 ? in_this_thread(job).evolve(trainings, terms) : nothing_evolved(trainings);
  });
  const DistalOutcome outcome = learn_in_rounds(index, preparation, job, often_nothing);
  EXPECT_EQ(rounds, job.distal.rounds);
  EXPECT_LT(outcome.index_mm2, 0.5 * index(preparation.declared.robot));
}

TEST_P(DistalLearning, InSequenceNeverRaisesTheIndexEither) {
  const SequenceOutcome outcome = learn_in_sequence(index, preparation, job, [] { return true; });
  double last = index(preparation.declared.robot);
  std::uint32_t generation = 0;
  for (const DistalStep& step : outcome.learnt.steps) {
    EXPECT_LT(step.index_mm2, last);
    EXPECT_GT(step.generation, generation);
    last = step.index_mm2;
    generation = step.generation;
  }
  EXPECT_EQ(last, index(outcome.learnt.robot));
  EXPECT_LT(last, 0.8 * index(preparation.declared.robot));
  EXPECT_EQ(outcome.generations, 40U);
}

TEST_P(DistalLearning, InSequenceMayFitAmplitudesToo) {
  Job fitting = job;
  const SequenceOutcome thesis = learn_in_sequence(index, preparation, fitting, [] { return true; });
  fitting.distal.amplitudes = Amplitudes::fitted;
  const SequenceOutcome fitted = learn_in_sequence(index, preparation, fitting, [] { return true; });
  double last = index(preparation.declared.robot);
  for (const DistalStep& step : fitted.learnt.steps) {
    EXPECT_LE(step.index_mm2, last);
    last = step.index_mm2;
  }
  EXPECT_EQ(last, index(fitted.learnt.robot));
  EXPECT_NE(last, thesis.learnt.index_mm2);
}

/// What the thesis's algorithm does at its first step.
TEST_P(DistalLearning, InSequenceBeginsWithTheJointOfGreatestPotential) {
  const Eigen::VectorXd potentials = compensation_potentials(index.linearized(preparation.declared.robot));
  Eigen::Index greatest = 0;
  potentials.maxCoeff(&greatest);
  const SequenceOutcome outcome = learn_in_sequence(index, preparation, job, [] { return true; });
  ASSERT_FALSE(outcome.learnt.steps.empty());
  EXPECT_EQ(outcome.learnt.steps.front().joint, greatest);
}

TEST_P(DistalLearning, InSequenceEndsWhenTold) {
  int asked = 0;
  const SequenceOutcome outcome = learn_in_sequence(index, preparation, job, [&] { return ++asked <= 3; });
  EXPECT_LE(outcome.generations, 3U);
  EXPECT_EQ(outcome.learnt.candidates.size(), preparation.training.size());
}

TEST_P(DistalLearning, WeighsOrientationInWhereItIsMeasured) {
  const double whole = index(preparation.declared.robot);
  const double of_tool = performance_index_mm2(preparation.declared.robot, data, preparation.targets.poses);
  if (GetParam() == Measured::pose) {
    EXPECT_GT(whole, 1.1 * of_tool);
  } else {
    EXPECT_NEAR(whole, of_tool, 1e-9 * of_tool);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, DistalLearning, testing::Values(Measured::position, Measured::pose, Measured::distances),
                         word_of_measured);

TEST(DistalIndex, IsThePerformanceIndexWhereNoOrientationIsMeasured) {
  for (const Measured what : {Measured::position, Measured::distances}) {
    const DataSet data = measured(what, 3);
    const Preparation preparation = prepare(data, distal_job());
    const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
    const DistalIndex index(data, poses, preparation.declared);
    RandomStream random{33};
    const CorrectedRobot robot = corrected_puma(1e-3, random);
    const double expected = performance_index_mm2(robot, data, poses);
    EXPECT_NEAR(index(robot), expected, 1e-9 * expected);
  }
}

/// Two links of 1 m in a plane: the Jacobian is known by heart.
TEST(CompensationPotential, OfAPlanarArmIsAsByHand) {
  CorrectedRobot robot;
  robot.chain.joints = {{.a_m = 1.0, .lower = -M_PI, .upper = M_PI}, {.a_m = 1.0, .lower = -M_PI, .upper = M_PI}};
  robot.tools[""] = Eigen::Isometry3d::Identity();
  robot.corrections.resize(2);
  DataSet data;
  data.robot.chain = robot.chain;
  RandomStream random{34};
  double expected_first = 0.0, expected_second = 0.0;
  for (int i = 0; i < 10; ++i) {
    const double q1 = random.real(-2, 2), q2 = random.real(-2, 2), dx = random.real(-1e-3, 1e-3),
                 dy = random.real(-1e-3, 1e-3);
    MeasuredPose pose;
    pose.joints = Eigen::Vector2d(q1, q2);
    pose.position_m = {std::cos(q1) + std::cos(q1 + q2) + dx, std::sin(q1) + std::sin(q1 + q2) + dy, 0.0};
    data.poses.push_back(pose);
    const double by_second = -std::sin(q1 + q2) * dx + std::cos(q1 + q2) * dy;
    const double by_first = -std::sin(q1) * dx + std::cos(q1) * dy + by_second;
    expected_first += 1e6 * std::abs(by_first);
    expected_second += 1e6 * std::abs(by_second);
  }
  Fit fit;
  fit.robot = robot;
  fit.sigma_position_m = 1e-3;
  const DistalIndex index(data, poses_of(data, PoseSet::calibration), fit);
  const Eigen::VectorXd potentials = compensation_potentials(index.linearized(robot));
  ASSERT_EQ(potentials.size(), 2);
  EXPECT_NEAR(potentials[0], expected_first, 1e-9 * expected_first);
  EXPECT_NEAR(potentials[1], expected_second, 1e-9 * expected_second);
}

TEST(DistalStep, IsNotTakenWhereTheExactIndexWouldRise) {
  const DataSet data = measured(Measured::position, 5);
  const Preparation preparation = prepare(data, distal_job());
  const DistalIndex index(data, preparation.targets.poses, preparation.declared);
  DistalOutcome outcome{preparation.declared.robot, index(preparation.declared.robot)};
  const double before = outcome.index_mm2;
  const JointTraining& training = preparation.training.front();
  const JointCorrection wrong(parse("-0.002 * SIN(theta)"), training.branch, training.range_rad);
  EXPECT_FALSE(accept_correction(index, training, wrong, 1, outcome));
  EXPECT_TRUE(outcome.robot.corrections[0].is_neutral());
  EXPECT_EQ(outcome.index_mm2, before);
  const JointCorrection right(parse(kDistalErrors[0]), training.branch, training.range_rad);
  EXPECT_TRUE(accept_correction(index, training, right, 2, outcome));
  EXPECT_LT(outcome.index_mm2, before);
  ASSERT_EQ(outcome.steps.size(), 1U);
  EXPECT_EQ(outcome.steps.front().joint, 0);
}

TEST(EvolvedTree, IsWhatACorrectionWasMadeOf) {
  const JointTraining training{.joint = 0, .table = {}, .scale_rad = 2e-4, .range_rad = {-1, 1}, .branch = {}};
  const Tree tree = parse("theta * SIN(0.5 + theta)");
  EXPECT_EQ(evolved_tree(correction_from(training, tree)), tree);
}

}  // namespace
}  // namespace demecal
