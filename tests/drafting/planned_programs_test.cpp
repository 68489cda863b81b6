// Programs of a plan drive along its way alone, and say what they leave out.
#include "drafting/planned_programs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "kinematics/random_arm.hpp"
#include "languages/languages.hpp"

namespace demecal {
namespace {

/// Two poses on the way, the second behind two other stops; nothing leads to the third.
Plan plan_with_a_pose_by_hand(const Chain& arm) {
  RandomStream random{9501};
  Plan plan;
  for (int i = 1; i <= 3; ++i)
    plan.stops.push_back({"P" + std::to_string(i), PoseSet::calibration, {random_joints(random, arm), {}}});
  for (const int pose : {-1, 0, -1, -1, -1, 1})
    plan.way.stops.push_back(
        {pose < 0 ? random_joints(random, arm) : plan.stops[static_cast<std::size_t>(pose)].pose.joints, pose});
  plan.way.blocked = {2};
  return plan;
}

TEST(PlannedPrograms, NameEveryStopOnce) {
  const Plan plan = plan_with_a_pose_by_hand(wrist_arm());
  std::vector<std::string> names;
  for (const ProgrammedStop& stop : programmed_stops(plan)) {
    names.push_back(stop.name);
    EXPECT_EQ(stop.waits, stop.name.front() == 'P');
  }
  EXPECT_THAT(names, testing::ElementsAre("A1", "P1", "W2", "W2b", "A2", "P2"));
}

TEST(PlannedPrograms, LeaveOutWhatNoFreeWayLeadsToAndSaySo) {
  const Chain arm = wrist_arm();
  const Plan plan = plan_with_a_pose_by_hand(arm);
  int written = 0;
  for (const Language& language : all_languages()) {
    const std::string text = planned_program(plan, arm, language);
    if (text.empty()) continue;
    SCOPED_TRACE(language.name);
    ++written;
    const std::string file = "program." + std::string(written_ending(language));
    const Program program = read_program(language, text, file, arm);
    ASSERT_EQ(program.targets.size(), plan.way.stops.size());
    for (std::size_t i = 0; i < program.targets.size(); ++i) {
      const std::vector<double> joints = inside(program.targets[i].joints);
      for (std::size_t k = 0; k < joints.size(); ++k)
        EXPECT_NEAR(joints[k], plan.way.stops[i].joints[static_cast<Eigen::Index>(k)], 1e-6);
    }
    EXPECT_THAT(text, testing::HasSubstr("Left out"));
    EXPECT_THAT(text, testing::HasSubstr("P3"));
    EXPECT_THAT(text, testing::HasSubstr("Drive to A1 by hand first"));
    Plan whole = plan;
    whole.way.blocked.clear();
    EXPECT_THAT(planned_program(whole, arm, language), testing::Not(testing::HasSubstr("Left out")));
  }
  EXPECT_GE(written, 5);
}

TEST(PlannedPrograms, OfTwoFilesAreReadBackTogether) {
  const Chain arm = wrist_arm();
  const Plan plan = plan_with_a_pose_by_hand(arm);
  int written = 0;
  for (const Language& language : all_languages()) {
    const std::string beside = planned_program_beside(plan, language);
    if (beside.empty()) continue;
    SCOPED_TRACE(language.name);
    ++written;
    EXPECT_THAT(beside, testing::AllOf(testing::HasSubstr("Left out"), testing::HasSubstr("P2: measure")));
    const ProgramSource source({{"program.dtx", planned_program(plan, arm, language)}, {"program.pgx", beside}});
    const Program program = read_program(language, source, arm);
    EXPECT_THAT(program.uncorrected, testing::IsEmpty());
    EXPECT_THAT(program.remarks, testing::IsEmpty());
    ASSERT_EQ(program.targets.size(), plan.way.stops.size());
    for (std::size_t i = 1; i < program.targets.size(); ++i)
      EXPECT_LT(program.targets[i - 1].order, program.targets[i].order) << "driven to in the plan's order";
  }
  EXPECT_EQ(written, 1);
}

TEST(PlannedPrograms, SayWhereTheRailStandsOrThatTheyCannot) {
  Chain arm = wrist_arm();
  Joint rail;
  rail.type = JointType::prismatic;
  rail.upper = 3.0;
  arm.joints.insert(arm.joints.begin(), rail);
  const Plan plan = plan_with_a_pose_by_hand(arm);
  int written = 0;
  for (const Language& language : all_languages()) {
    const std::string text = planned_program(plan, arm, language);
    if (text.empty()) continue;
    SCOPED_TRACE(language.name);
    ++written;
    const Program program = read_program(language, text, "program." + std::string(written_ending(language)), arm);
    ASSERT_EQ(program.targets.size(), plan.way.stops.size());
    for (std::size_t i = 0; i < program.targets.size(); ++i)
      EXPECT_LT((stated_joints(program.targets[i]) - plan.way.stops[i].joints).cwiseAbs().maxCoeff(), 1e-6);
  }
  EXPECT_GE(written, 5);
  EXPECT_THAT(programs_left_out(plan, arm), testing::AllOf(testing::HasSubstr("URScript"), testing::HasSubstr("slides"),
                                                           testing::Not(testing::HasSubstr("KRL"))));
  EXPECT_EQ(programs_left_out(plan_with_a_pose_by_hand(wrist_arm()), wrist_arm()), "");
}

}  // namespace
}  // namespace demecal
