// Where arms with transforms after their links stand, how they move, and the same arms without these transforms.
#include <gtest/gtest.h>

#include "random_structure.hpp"
#include "structure/structured_arm.hpp"

namespace demecal {
namespace {

constexpr Convention kConventions[] = {Convention::standard_dh, Convention::modified_dh};

TEST(StructuredArm, WithoutGenesStandsWhereTheRobotDoes) {
  RandomStream stream{1211};
  for (const Convention convention : kConventions) {
    const Chain chain = random_arm(stream, 6, convention, 0.2);
    const StructuredArm arm{placed_robot(stream, chain), Genome(6)};
    const JointVector q = random_joints(stream, chain);
    EXPECT_LT((arm.predict(q, "").matrix() - arm.robot.predict(Stop(q), "").matrix()).norm(), 1e-12);
  }
}

TEST(StructuredArm, AddsUpConsecutiveEqualTransforms) {
  RandomStream stream{1212};
  const Chain chain = wrist_arm();
  const CorrectedRobot robot = placed_robot(stream, chain);
  const Gene turn{true, 1}, shift{false, 0};
  const Genome doubled{{}, {turn, turn, shift}, {}, {}, {}, {}};
  for (int i = 0; i < 20; ++i) {
    const StructuredArm twice = with_structure(stream, robot, doubled, 0.1);
    const StructuredArm once{robot, expressed(doubled), {twice.values[0] + twice.values[1], twice.values[2]}};
    const JointVector q = random_joints(stream, chain);
    EXPECT_LT((once.predict(q, "").matrix() - twice.predict(q, "").matrix()).norm(), 1e-12);
  }
}

TEST(StructuredArm, MovesAsDifferencesDo) {
  RandomStream stream{1213};
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 20; ++i) {
    const Chain chain = random_arm(stream, 5, kConventions[i % 2], 0.2);
    const StructuredArm arm = with_structure(stream, placed_robot(stream, chain), random_genome(5, stream), 0.3);
    const StructureFreedom freedom{true, true, {""}};
    const JointVector q = random_joints(stream, chain);
    const StructureMotion motion = motion_of(arm, freedom, q, "");
    EXPECT_LT((motion.predicted.matrix() - arm.predict(q, "").matrix()).norm(), 1e-12);
    const auto n = static_cast<Eigen::Index>(12 + gene_count(arm.genome));
    ASSERT_EQ(motion.twists.cols(), n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(n, k);
      const Eigen::Isometry3d ahead = changed(arm, freedom, step).predict(q, ""),
                              behind = changed(arm, freedom, -step).predict(q, "");
      Eigen::Matrix<double, 6, 1> twist;
      twist << ahead.translation() - behind.translation(), vector_of(ahead.linear() * behind.linear().transpose());
      EXPECT_LT((twist / (2 * kStep) - motion.twists.col(k)).norm(), 1e-7) << "number " << k;
    }
  }
}

TEST(EquivalentLinks, PredictWhatTheStructureDoesWithTheSameBase) {
  RandomStream stream{1214};
  for (int i = 0; i < 100; ++i) {
    const bool parallels = i % 4 == 0;
    Chain chain = parallels ? wrist_arm() : random_arm(stream, 6, kConventions[i % 2], 0.2);
    if (i % 8 == 4) {
      chain.convention = Convention::modified_dh;
      chain.joints[2].a_m = 0.4;
    }
    const StructuredArm arm = with_structure(stream, placed_robot(stream, chain), random_genome(6, stream), 0.01);
    const CorrectedRobot robot = equivalent_robot(arm);
    EXPECT_EQ(robot.sensor_from_base.matrix(), arm.robot.sensor_from_base.matrix());
    for (int k = 0; k < 10; ++k) {
      const JointVector q = random_joints(stream, chain);
      EXPECT_LT((robot.predict(Stop(q), "").matrix() - arm.predict(q, "").matrix()).norm(), 1e-10) << "arm " << i;
    }
  }
}

TEST(EquivalentLinks, AreTheRobotsOwnWhereNothingIsInserted) {
  RandomStream stream{1215};
  const CorrectedRobot robot = placed_robot(stream, random_arm(stream, 6, Convention::standard_dh));
  const CorrectedRobot same = equivalent_robot({robot, Genome(6)});
  for (std::size_t i = 0; i < 6; ++i) {
    for (const LinkParameter parameter :
         {LinkParameter::theta, LinkParameter::d, LinkParameter::a, LinkParameter::alpha, LinkParameter::beta}) {
      EXPECT_EQ(same.chain.joints[i].parameter(parameter), robot.chain.joints[i].parameter(parameter));
    }
  }
}

}  // namespace
}  // namespace demecal
