// Which effects a plan looks for on an arm, and what it says of those it cannot show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planning/candidates.hpp"
#include "planning/plan.hpp"
#include "planning/planned_arm.hpp"

namespace demecal {
namespace {

using testing::HasSubstr;

std::vector<Effect> detected(const Robot& robot, const std::string& kind) {
  const FeasibleSpace space(robot, assumed_cell(robot));
  return effects_to_detect(robot, space.ranges(), {kind}, false);
}

/// With masses in its links.
Robot weighed_arm() {
  Robot robot = planned_arm();
  for (int i = 0; i < robot.chain.size(); ++i) robot.masses.push_back({5.0, {-0.1, 0.02, 0.03}});
  return robot;
}

TEST(EffectsToDetect, AreOfTheFirstFormThatTheArmsDescriptionAllows) {
  for (const char* kind : {"compliance", "link_bending"}) {
    SCOPED_TRACE(kind);
    const std::vector<Effect> weighed = detected(weighed_arm(), kind), unweighed = detected(planned_arm(), kind);
    ASSERT_FALSE(weighed.empty());
    for (const Effect& effect : weighed) EXPECT_EQ(effect.form, "masses");
    ASSERT_FALSE(unweighed.empty());
    for (const Effect& effect : unweighed) EXPECT_EQ(effect.form, "moments");
    for (std::size_t i = 1; i < unweighed.size(); ++i) EXPECT_NE(unweighed[i].joint, unweighed[i - 1].joint);
  }
}

TEST(EffectsToDetect, HoldOneGearHarmonicOfEveryJoint) {
  EXPECT_EQ(detected(planned_arm(), "gear_harmonic").size(), 6u);
}

TEST(EffectsToDetect, HoldTheFirstFormAloneWhereThereIsOne) {
  for (const Effect& effect : detected(planned_arm(), "backlash")) EXPECT_EQ(effect.form, "approach");
  EXPECT_EQ(detected(planned_arm(), "backlash").size(), 6u);
}

TEST(Plan, SaysWhatIsLackingForEffectsThatItCannotShow) {
  PlanRequest request;
  request.robot = planned_arm();
  request.poses = 14;
  request.detect = {"compliance", "hysteresis", "thermal_offset", "drift", "balancer"};
  const Plan plan = make_plan(request);
  const auto says = [&](const std::string& kind, const std::string& why) {
    return testing::Contains(testing::AllOf(HasSubstr("effects of the kind " + kind), HasSubstr(why)));
  };
  EXPECT_THAT(plan.warnings, says("hysteresis", "masses"));
  EXPECT_THAT(plan.warnings, says("thermal_offset", "several temperatures"));
  EXPECT_THAT(plan.warnings, says("drift", "times"));
  EXPECT_THAT(plan.warnings, says("balancer", "nothing on this arm"));
  EXPECT_THAT(plan.warnings, testing::Not(says("compliance", "")));
  EXPECT_FALSE(plan.detectable.empty());
}

}  // namespace
}  // namespace demecal
