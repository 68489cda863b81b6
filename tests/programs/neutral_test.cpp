// A neutral model changes no byte of any program, and no model changes a byte outside the targets.
#include <gtest/gtest.h>

#include "corrected_arm.hpp"
#include "kinematics/angles.hpp"
#include "languages/written_program.hpp"

namespace demecal {
namespace {

struct Case {
  WrittenIn language;
  bool of_poses;
  std::string text;
};

std::string random_program(RandomStream& stream, const CommandModel& model, WrittenIn language, bool of_poses,
                           JointVector& first) {
  const int decimals = static_cast<int>(3 + stream.index(10));
  const auto line = [&](int index) {
    const JointVector joints = 1.1 * random_joints(stream, model.nominal.chain);  // beyond the limits, too
    if (index == 1) first = joints.unaryExpr([](double angle) { return wrap_near(angle, 0.0); });
    if (!of_poses) return joints_line(language, joints, index, decimals);
    return pose_line(language, model.nominal_tool(joints), joints, index, decimals);
  };
  return written(language, of_poses, 4, line, stream.chance(0.5) ? "\n" : "\r\n");
}

/// Calls `check(model, program text, language, joints of the first target)` for random programs of every language.
template <typename Model, typename Check>
void on_random_programs(std::uint64_t seed, int repetitions, const Model& make_model, const Check& check) {
  RandomStream stream{seed};
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const Robot nominal = elbow_arm(stream);
    const CommandModel model = make_model(stream, nominal);
    for (const WrittenIn language : kLanguages) {
      for (const bool of_poses : {false, true}) {
        if (!of_poses && !has_joint_targets(language)) continue;
        SCOPED_TRACE(to_string(language) + (of_poses ? " of poses" : " of joints"));
        JointVector first;
        const std::string text = random_program(stream, model, language, of_poses, first);
        check(model, text, language, first);
      }
    }
  }
}

TEST(NeutralModel, ChangesNoByte) {
  on_random_programs(
      7101, 6, neutral_model,
      [](const CommandModel& model, const std::string& text, WrittenIn language, const JointVector& near) {
        Program program = read_program(language, text, "p", model.nominal.chain);
        ASSERT_EQ(program.targets.size(), 4u);
        const CorrectedProgram corrected = correct_program(text, std::move(program), model, {.near = near});
        EXPECT_EQ(corrected.text, text);
      });
}

TEST(AnyModel, ChangesOnlyTheNumbersOfTargets) {
  int programs = 0, changed = 0;
  on_random_programs(
      7102, 3, erring_model,
      [&](const CommandModel& model, const std::string& text, WrittenIn language, const JointVector& near) {
        const Program before = read_program(language, text, "p", model.nominal.chain);
        const CorrectedProgram corrected = correct_program(text, before, model, {.near = near});
        const bool any = std::ranges::any_of(corrected.targets, [](const CorrectedTarget& target) {
          return !target.is_uncorrected() && !target.is_as_programmed();
        });
        EXPECT_EQ(corrected.text != text, any);
        ++programs, changed += any;
        const Program after = read_program(language, corrected.text, "p", model.nominal.chain);
        EXPECT_EQ(without_cells(corrected.text, after), without_cells(text, before));
      });
  // Of some no target's configuration is known.
  EXPECT_GT(changed, 0.9 * programs) << "of " << programs;
}

TEST(CorrectedTwice, ChangesTheSameCellsTheSameWayEveryTime) {
  on_random_programs(
      7103, 1, erring_model,
      [](const CommandModel& model, const std::string& text, WrittenIn language, const JointVector& near) {
        const Program program = read_program(language, text, "p", model.nominal.chain);
        EXPECT_EQ(correct_program(text, program, model, {.near = near}).text,
                  correct_program(text, program, model, {.near = near}).text);
      });
}

}  // namespace
}  // namespace demecal
