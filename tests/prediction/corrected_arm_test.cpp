// Formulas of a model give what the model predicts where only the joints are known.
#include "prediction/corrected_arm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "effects/symbolic_state.hpp"
#include "prediction/random_effects.hpp"
#include "stop_at.hpp"
#include "symbolic/calculus.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The pose by the formulas, corrections first.
Eigen::Matrix4d pose_at(const CorrectedArm& arm, const Stop& stop) {
  const JointVector& q = stop.joints;
  SymbolValues at{{kPayload, stop.payload_kg},
                  {kWarming, stop.temperature_celsius ? *stop.temperature_celsius - arm.reference_celsius : 0.0}};
  for (Eigen::Index i = 0; i < q.size(); ++i)
    at[approach_symbol(static_cast<int>(i + 1))] = stop.approach.size() > 0 ? stop.approach[i] : 0.0;
  for (Eigen::Index i = 0; i < q.size(); ++i) at[commanded_joint(static_cast<int>(i + 1))] = q[i];
  const std::vector<double> actual = values_of(arm.actual, at);
  for (std::size_t i = 0; i < actual.size(); ++i) at[actual_joint(static_cast<int>(i + 1))] = actual[i];
  const std::vector<double> values = values_of(elements(arm.pose), at);
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
}

double farthest(const CorrectedRobot& robot, const std::string& target, RandomStream& stream, double reach) {
  Algebra algebra;
  const CorrectedArm arm = corrected_arm(algebra, robot, target);
  double most = 0.0;
  for (int i = 0; i < 30; ++i) {
    const Stop stop = stop_at(stream, robot.chain, reach * random_joints(stream, robot.chain));
    most = std::max(most, (pose_at(arm, stop) - robot.predict(stop, target).matrix()).cwiseAbs().maxCoeff());
  }
  return most;
}

TEST(CorrectedArm, FollowsCorrectionsOfEveryPrimitiveOnTheirBranchAndBeyondTheirRange) {
  RandomStream stream{631};
  for (int which = 0; which < 10; ++which) {
    const auto convention = which % 2 == 0 ? Convention::standard_dh : Convention::modified_dh;
    const Chain nominal = mounted_arm(stream, 5, convention, 0.2);
    CorrectedRobot robot = random_robot(stream, nominal, 1e-3, 1e-3);
    const Tree tree =
        parse("0.001 * SQRTp(theta - 0.3) - 0.002 % (theta - -1.5) * SIGN(theta) + 0.001 * ABS(COS(theta))");
    robot.corrections[0] = {tree, {true, 2.5}, {1.0, 4.0}};
    robot.corrections[1] = {tree, {}, {-0.5, 0.5}};
    robot.corrections[2] = {};
    for (const char* target : {"", "B"}) EXPECT_LT(farthest(robot, target, stream, 1.5), 1e-9);
  }
}

TEST(CorrectedArm, FollowsEveryEffectOfTheCatalogueAsTheModelPredictsIt) {
  RandomStream stream{632};
  for (int which = 0; which < 4; ++which) {
    const auto convention = which % 2 == 0 ? Convention::standard_dh : Convention::modified_dh;
    const Chain nominal = mounted_arm(stream, 5, convention, which == 3 ? 0.3 : 0.0);
    for (const EffectLaw* law : catalogue()) {
      CorrectedRobot robot = random_robot(stream, nominal, 1e-3, 1e-3);
      robot.described = heavy(stream, nominal);
      robot.described.balancers = {{1, 0.25, 0.4, 0.5}};
      for (const Effect& effect : random_effects(robot.described, stream, 2e-3, 2)) {
        if (effect.kind == law->kind()) robot.effects.push_back(effect);
      }
      ASSERT_FALSE(robot.effects.empty()) << law->kind();
      EXPECT_LT(farthest(robot, "", stream, 1.0), 1e-9) << law->kind();
    }
  }
}

TEST(CorrectedArm, HoldsAndFadesEffectsBeyondTheirRangesAsTheModelDoes) {
  RandomStream stream{633};
  for (int which = 0; which < 30; ++which) {
    const Chain nominal = mounted_arm(stream, 4, Convention::standard_dh);
    CorrectedRobot robot = random_robot(stream, nominal, 1e-3, 1e-3);
    robot.described = heavy(stream, nominal);
    for (Effect effect : random_effects(robot.described, stream, 2e-3, 1)) {
      for (const int joint : law_of(effect).ranged_joints(effect, robot.described)) {
        const double lower = stream.real(-3, 1);
        const double width = stream.chance(0.3) ? stream.real(6.5, 9) : stream.real(0.2, 5);
        effect.ranges[joint] = {lower, lower + width};
      }
      if (!effect.ranges.empty()) robot.effects.push_back(effect);
    }
    ASSERT_GT(robot.effects.size(), 3u);
    EXPECT_LT(farthest(robot, "", stream, 2.0), 1e-9);
  }
}

TEST(CorrectedArm, DifferentiatesByEveryJointAsDifferencesDo) {
  RandomStream stream{635};
  const Chain nominal = mounted_arm(stream, 4, Convention::standard_dh, 0.2);
  CorrectedRobot robot = random_robot(stream, nominal, 1e-3, 1e-2);
  robot.described = heavy(stream, nominal);
  robot.effects = random_effects(robot.described, stream, 2e-3, 1);
  Algebra algebra;
  const CorrectedArm arm = corrected_arm(algebra, robot, "");
  for (int joint = 1; joint <= 4; ++joint) {
    const Listing slope = derivative(listing_of(arm, robot, ""), joint);
    for (int i = 0; i < 5; ++i) {
      const JointVector q = random_joints(stream, nominal);
      constexpr double kStep = 1e-5;
      JointVector before = q, after = q;
      before[joint - 1] -= kStep;
      after[joint - 1] += kStep;
      const Eigen::Matrix4d difference = (pose_at(arm, after) - pose_at(arm, before)) / (2 * kStep);
      EXPECT_LT((pose_at({arm.actual, slope.pose, {}}, q) - difference).cwiseAbs().maxCoeff(), 1e-6) << joint;
    }
  }
}

TEST(CorrectedArm, SaysOnWhatItDependsBesideTheJointsAndWhatItLeavesOut) {
  RandomStream stream{634};
  const Chain nominal = mounted_arm(stream, 3, Convention::standard_dh);
  CorrectedRobot robot = random_robot(stream, nominal, 1e-3, 1e-3);
  robot.described = heavy(stream, nominal);
  Algebra algebra;
  EXPECT_THAT(corrected_arm(algebra, robot, "").notes, IsEmpty());
  robot.effects = {
      {.kind = "backlash", .joint = 1, .settings = {}, .form = "approach", .formula = {}, .values = {1e-3}},
      {.kind = "gain", .joint = 0, .settings = {}, .form = "", .formula = {}, .values = {1e-3}},
      {.kind = "compliance", .joint = 1, .settings = {}, .form = "masses", .formula = {}, .values = {1e-6}},
      {.kind = "drift", .joint = -1, .settings = {{"reference_time_s", 0.0}}}};
  const CorrectedArm arm = corrected_arm(algebra, robot, "");
  ASSERT_EQ(arm.notes.size(), 1u);
  EXPECT_EQ(arm.notes[0], "drift is left out, for it depends on the time.");
  const std::string code = code_of(listing_of(arm, robot, "title"), CodeLanguage::c);
  EXPECT_THAT(code, HasSubstr("// Note: " + arm.notes[0]));
  EXPECT_THAT(code,
              HasSubstr("// The pose depends also on payload_kg (carried at the tool point as described), approach2 "
                        "(the sign of the joint's last motion; 0 where it is not known); left out, they are 0."));
}

TEST(CorrectedArm, SaysInWhichFrameItsPoseIs) {
  RandomStream stream{635};
  const Chain nominal = mounted_arm(stream, 3, Convention::standard_dh);
  CorrectedRobot robot = random_robot(stream, nominal, 1e-3, 1e-3);
  robot.described = heavy(stream, nominal);
  Algebra algebra;
  const CorrectedArm arm = corrected_arm(algebra, robot, "");
  EXPECT_THAT(code_of(listing_of(arm, robot, ""), CodeLanguage::text), HasSubstr("in the frame of the measurements"));
  const std::string own = code_of(listing_of(arm, robot, "", PoseFrame::own_base), CodeLanguage::text);
  EXPECT_THAT(own, HasSubstr("in the frame of the arm's base as described"));
  EXPECT_THAT(own, testing::Not(HasSubstr("frame of the measurements")));
}

}  // namespace
}  // namespace demecal
