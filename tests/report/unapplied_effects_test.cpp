// What a model holds and poses do not let it apply.
#include "report/unapplied_effects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "made_up_loop.hpp"
#include "report/report_json.hpp"

namespace demecal {
namespace {

using ::testing::IsEmpty;

DataSet three_poses() {
  DataSet data;
  data.robot = made_up_arm();
  data.poses.resize(3);
  for (MeasuredPose& pose : data.poses) pose.approach = ApproachSigns::Ones(6);
  return data;
}

CorrectedRobot with_backlash() {
  CorrectedRobot robot;
  robot.effects = {made_up_backlash(), made_up_harmonic(2, 9, 1e-4, 0.0)};
  return robot;
}

TEST(UnappliedEffects, AreNoneWherePosesHoldWhatEffectsNeed) {
  EXPECT_THAT(unapplied_effects(with_backlash(), three_poses()), IsEmpty());
}

TEST(UnappliedEffects, NameTheEffectItsNeedAndThePoses) {
  DataSet data = three_poses();
  data.poses[0].approach.reset();
  data.poses[2].approach.reset();
  const std::vector<UnappliedEffect> found = unapplied_effects(with_backlash(), data);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].lacking, "approach");
  EXPECT_EQ(found[0].sentence(),
            "backlash of joint 2 cannot be applied as it was calibrated at 2 of 3 poses: they have no approach "
            "direction, and no side is taken");
}

TEST(UnappliedEffects, StandInTheJsonOfAnEvaluation) {
  DataSet data = three_poses();
  data.poses[1].approach.reset();
  const std::vector<UnappliedEffect> found = unapplied_effects(with_backlash(), data);
  const nlohmann::json written = nlohmann::json::parse(errors_to_json({}, {}, found))["effects_not_applied"];
  ASSERT_EQ(written.size(), 1u);
  EXPECT_EQ(written[0]["kind"], "backlash");
  EXPECT_EQ(written[0]["joint"], 2);
  EXPECT_EQ(written[0]["poses"], 1);
  EXPECT_EQ(written[0]["lacking"], "approach");
}

}  // namespace
}  // namespace demecal
