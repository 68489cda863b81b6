// What the model takes of several joints' candidates: together, at amplitudes that suit each other, never at a loss.
#include <gtest/gtest.h>

#include <cmath>

#include "calibration/calibration.hpp"
#include "distal/learning.hpp"
#include "distal/steps.hpp"
#include "distal_arm.hpp"

namespace demecal {
namespace {

class DistalChoice : public testing::TestWithParam<Measured> {
 protected:
  DistalOutcome outcome_of(const CorrectedRobot& robot) const { return {robot, index(robot)}; }
  CorrectedRobot declared() const { return without_corrections(preparation.declared.robot); }
  /// What every joint learns from where nothing is corrected yet.
  std::vector<JointTraining> trainings() const {
    const std::vector<LinearizedPose> poses = index.linearized(declared());
    std::vector<JointTraining> trainings;
    for (const JointTraining& like : preparation.training) trainings.push_back(distal_training(like, poses));
    return trainings;
  }
  /// The true errors of the joints, each times a factor of its own.
  std::vector<JointCandidates> true_but_for_size(RandomStream& random) const {
    std::vector<JointCandidates> candidates;
    for (const JointTraining& training : trainings()) {
      JointCandidates joint{training, {}};
      const std::string& truth = kDistalErrors[training.joint];
      const Tree factor = constant_tree(random.real(0.4, 2.5) / training.scale_rad);
      if (!truth.empty()) joint.front.push_back({apply(Primitive::multiply, factor, parse(truth)), 1.0});
      candidates.push_back(joint);
    }
    return candidates;
  }

  const DataSet data = measured(GetParam(), 18);
  const Preparation preparation = prepare(data, distal_job());
  const DistalIndex index{data, preparation.targets.poses, preparation.declared};
};

TEST_P(DistalChoice, TakesTogetherWhatIsRightButForItsSize) {
  RandomStream random{51};
  for (int trial = 0; trial < 10; ++trial) {
    const auto candidates = true_but_for_size(random);
    DistalOutcome fitted = outcome_of(declared()), as_evolved = fitted;
    const double before = fitted.index_mm2;
    ASSERT_TRUE(accept_candidates(index, candidates, Amplitudes::fitted, 7, fitted));
    EXPECT_LT(fitted.index_mm2, 0.02 * before);
    EXPECT_EQ(fitted.index_mm2, index(fitted.robot));
    accept_candidates(index, candidates, Amplitudes::as_evolved, 7, as_evolved);
    EXPECT_GT(as_evolved.index_mm2, fitted.index_mm2);
    for (const DistalStep& step : fitted.steps) {
      EXPECT_EQ(step.generation, 7U);
      EXPECT_EQ(step.index_mm2, fitted.index_mm2);
      const JointCorrection& taken = fitted.robot.corrections[static_cast<std::size_t>(step.joint)];
      EXPECT_EQ(step.correction.formula(), taken.formula());
    }
  }
}

TEST_P(DistalChoice, FitsWhatTheModelHasWhereNothingIsOffered) {
  RandomStream random{52};
  CorrectedRobot robot = declared();
  for (const JointCandidates& joint : true_but_for_size(random)) {
    if (joint.front.empty()) continue;
    robot.corrections[joint.training.joint] = correction_from(joint.training, joint.front.front().tree);
  }
  std::vector<JointCandidates> none;
  for (const JointTraining& training : trainings()) none.push_back({training, {}});
  DistalOutcome outcome = outcome_of(robot), same = outcome;
  EXPECT_FALSE(accept_candidates(index, none, Amplitudes::as_evolved, 3, same));
  EXPECT_TRUE(same.steps.empty());
  ASSERT_TRUE(accept_candidates(index, none, Amplitudes::fitted, 3, outcome));
  EXPECT_LT(outcome.index_mm2, 0.02 * index(declared()));
  for (std::size_t joint = 0; joint < 6; ++joint) {
    const JointCorrection &before = robot.corrections[joint], &after = outcome.robot.corrections[joint];
    ASSERT_EQ(before.is_neutral(), after.is_neutral());
    if (before.is_neutral()) continue;
    EXPECT_EQ(evolved_tree(before), evolved_tree(after));
  }
}

TEST_P(DistalChoice, IsAnAlternativeForJointsThatLearntByThemselves) {
  RandomStream random{53};
  const std::vector<std::size_t> poses = preparation.targets.poses;
  const auto left = [&](const std::vector<JointCandidates>& candidates) {
    return index(select_corrections(data, poses, poses, declared(), candidates).robot);
  };
  for (int trial = 0; trial < 5; ++trial) {
    const std::vector<JointCandidates> apart = true_but_for_size(random);
    std::vector<JointCandidates> together = apart;
    add_choices_of_all_joints(data, preparation, together);
    for (std::size_t i = 0; i < apart.size(); ++i)
      EXPECT_EQ(together[i].alternatives.size(), apart[i].alternatives.size() + 3);
    EXPECT_LT(left(together), 0.1 * left(apart));
  }
}

TEST_P(DistalChoice, LeavesTheModelAloneWhereTheIndexWouldNotFall) {
  const CorrectedRobot truth = [&] {
    CorrectedRobot robot = declared();
    for (const JointTraining& training : trainings()) {
      const std::string& error = kDistalErrors[training.joint];
      const Tree factor = constant_tree(1.0 / training.scale_rad);
      if (!error.empty())
        robot.corrections[training.joint] = correction_from(training, apply(Primitive::multiply, factor, parse(error)));
    }
    return robot;
  }();
  std::vector<JointCandidates> wrong;
  for (const JointTraining& training : trainings())
    wrong.push_back({training, {{parse("-3 * COS(theta + 1)"), 1.0}, {parse("1 % SIN(theta - theta)"), 1.0}}});
  DistalOutcome outcome = outcome_of(truth);
  const double before = outcome.index_mm2;
  EXPECT_FALSE(accept_candidates(index, wrong, Amplitudes::as_evolved, 3, outcome));
  EXPECT_EQ(outcome.index_mm2, before);
  EXPECT_TRUE(outcome.steps.empty());
}

TEST_P(DistalChoice, TakesNothingThatIsNotBounded) {
  std::vector<JointCandidates> candidates;
  const std::vector<JointTraining> all = trainings();
  for (const JointTraining& training : all) {
    // Between two poses lies a pole.
    std::vector<double> theta = training.table.variables[0];
    std::ranges::sort(theta);
    const std::size_t middle = theta.size() / 2;
    const double pole = 0.5 * (theta[middle] + theta[middle - 1]);
    const Tree steep = apply(Primitive::divide, constant_tree(1e-3),
                             apply(Primitive::subtract, variable_tree(0), constant_tree(pole)));
    const Tree wave = apply(Primitive::sine, variable_tree(0)), still = parse(kDistalErrors[0]);
    candidates.push_back({training, {{apply(Primitive::add, wave, steep), 1.0}, {still, 1.0}}});
  }
  for (const Amplitudes amplitudes : {Amplitudes::as_evolved, Amplitudes::fitted}) {
    DistalOutcome outcome = outcome_of(declared());
    accept_candidates(index, candidates, amplitudes, 1, outcome);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const JointCorrection& taken = outcome.robot.corrections[all[i].joint];
      EXPECT_TRUE(taken.is_neutral() || is_bounded(taken, all[i]));
    }
  }
}

TEST_P(DistalChoice, ShowsThreeDigitsOfAnAmplitude) {
  RandomStream random{53};
  DistalOutcome outcome = outcome_of(declared());
  ASSERT_TRUE(accept_candidates(index, true_but_for_size(random), Amplitudes::fitted, 1, outcome));
  for (const DistalStep& step : outcome.steps) {
    const double scale_rad = evolved_scale_rad(step.correction);
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2e", scale_rad);
    EXPECT_EQ(std::strtod(text.data(), nullptr), scale_rad);
  }
}

TEST_P(DistalChoice, TrainingsFollowTheAmplitudes) {
  RandomStream random{54};
  DistalOutcome outcome = outcome_of(declared());
  ASSERT_TRUE(accept_candidates(index, true_but_for_size(random), Amplitudes::fitted, 1, outcome));
  std::vector<JointTraining> followed = trainings();
  const std::vector<JointTraining> before = followed;
  rescale_trainings(outcome.robot, followed);
  for (std::size_t i = 0; i < followed.size(); ++i) {
    const JointCorrection& correction = outcome.robot.corrections[followed[i].joint];
    const double expected_rad = correction.is_neutral() ? before[i].scale_rad : evolved_scale_rad(correction);
    EXPECT_EQ(followed[i].scale_rad, expected_rad);
    for (std::size_t row = 0; row < followed[i].table.target.size(); ++row) {
      EXPECT_NEAR(followed[i].scale_rad * followed[i].table.target[row],
                  before[i].scale_rad * before[i].table.target[row], 1e-15);
    }
    EXPECT_NEAR(followed[i].scale_rad * followed[i].table.limit, before[i].scale_rad * before[i].table.limit, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, DistalChoice, testing::Values(Measured::position, Measured::pose, Measured::distances),
                         word_of_measured);

}  // namespace
}  // namespace demecal
