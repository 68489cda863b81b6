// Joints that a program holds and its correction turns back: they are not taken to come from the side of their last
// motion in the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "named_motions.hpp"

namespace demecal {
namespace {

/// Wrong in all links, its joint 1 with lost motion.
CommandModel erring_lost_motion_model() {
  RandomStream stream{7547};
  const Robot nominal = elbow_arm(stream);
  CorrectedRobot identified = random_robot(stream, nominal.chain, 1e-3, 2e-3);
  identified.effects = {
      {.kind = "backlash", .joint = 0, .settings = {}, .form = "approach", .formula = {}, .values = {2e-3}}};
  return unbounded_model(nominal, identified);
}

CorrectedProgram moved_through(const CommandModel& model, const std::vector<JointVector>& places) {
  std::string text = "DEF m()\n";
  for (const JointVector& joints : places)
    text += "PTP {" + named({"A1", "A2", "A3", "A4", "A5", "A6"}, in_degrees(joints), 9) + "}\n";
  text += "END\n";
  return correct_program(text, read_program(WrittenIn::krl, text, "p", model.nominal.chain), model,
                         {.temperature_celsius = 20.0});
}

std::size_t warnings_of_turning(const CorrectedProgram& corrected) {
  std::size_t count = 0;
  for (const Remark& warning : corrected.warnings)
    count += warning.sentence.find("turns a joint back") != std::string::npos ? 1 : 0;
  return count;
}

/// Joint 1 comes to both from below, and is held between them.
struct HeldJoint {
  JointVector start = joints_named("LOW"), one = joints_named("MIDDLE"), other = joints_named("HIGH");

  HeldJoint() { other[0] = one[0]; }
};

TEST(Approach, IsNotKnownWhereTheCorrectionTurnsAHeldJointBack) {
  const CommandModel model = erring_lost_motion_model();
  const HeldJoint held;
  const CorrectedProgram there = moved_through(model, {held.start, held.one, held.other}),
                         back = moved_through(model, {held.start, held.other, held.one});
  const bool turns_there = there.targets[2].command[0] < there.targets[1].command[0];
  const CorrectedProgram& turned = turns_there ? there : back;
  const CorrectedProgram& carried_on = turns_there ? back : there;
  EXPECT_GT(std::abs(there.targets[2].command[0] - there.targets[1].command[0]), 1e-4);
  EXPECT_EQ(carried_on.targets[2].stop.approach[0], 1.0) << "it turns on, to the side that it came from";
  EXPECT_EQ(warnings_of_turning(carried_on), 0U);
  EXPECT_EQ(turned.targets[1].stop.approach[0], 1.0);
  EXPECT_EQ(turned.targets[2].stop.approach[0], 0.0);
  EXPECT_EQ(warnings_of_turning(turned), 1U);
  const CorrectedTarget& last = turned.targets[2];
  EXPECT_GT(last.unknown_side_m, 1e-4);
  for (const double side : {-1.0, 1.0}) {
    Stop stop = last.stop.with_joints(last.command);
    stop.approach[0] = side;
    const Eigen::Vector3d error_m = model.robot.predict(stop, "").translation() - last.nominal_tool.translation();
    EXPECT_LT(error_m.norm(), 0.55 * last.unknown_side_m) << "the middle is between the sides";
  }
}

TEST(Approach, StaysUnknownUntilTheJointMovesAgain) {
  const CommandModel model = erring_lost_motion_model();
  const HeldJoint held;
  JointVector on = held.one, moved = held.other;
  on[5] += 0.3;
  moved[0] -= 0.3;
  const CorrectedProgram corrected = moved_through(model, {held.start, held.one, held.other, held.one, on, moved});
  EXPECT_EQ(corrected.targets[1].stop.approach[0], 1.0);
  EXPECT_EQ(corrected.targets[3].stop.approach[0], 0.0) << "it was turned back on the way there or on the way back";
  EXPECT_EQ(corrected.targets[4].stop.approach[0], 0.0);
  EXPECT_EQ(corrected.targets[5].stop.approach[0], -1.0);
}

}  // namespace
}  // namespace demecal
