// Arms on rails in robot programs: where the rail stands is read and kept, and the arm's joints take the correction.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "programs/configuration.hpp"
#include "rail_cell.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

TEST(Rail, StaysWhereTheProgramHasItAndTheArmTakesTheCorrection) {
  const RailCell cell = rail_cell(11, 9);
  for (const WrittenIn language : kOnRails) {
    for (const bool of_poses : {false, true}) {
      if (!is_written(language, of_poses)) continue;
      SCOPED_TRACE(to_string(language) + (of_poses ? " poses" : " joints"));
      const std::string text = rail_program(language, cell, of_poses);
      const CorrectedProgram corrected = corrected_on_rail(language, cell, text);
      ASSERT_EQ(corrected.targets.size(), 9u);
      for (std::size_t i = 0; i < 9; ++i) {
        EXPECT_EQ(corrected.targets[i].outcome, CorrectionOutcome::corrected)
            << i << ' ' << testing::PrintToString(corrected.targets[i].remarks);
        EXPECT_EQ(corrected.targets[i].command[0], corrected.targets[i].nominal[0]) << "the rail stands still";
        EXPECT_NEAR(corrected.targets[i].nominal[0], cell.meant[i][0], 1e-12);
      }
      for (const double miss : misses_m(language, cell, text)) EXPECT_GT(miss, 2e-4);
      for (const double miss : misses_m(language, cell, corrected.text)) EXPECT_LT(miss, 2e-8);
      const Program before = read_program(language, text, "p", cell.model.nominal.chain);
      const Program after = read_program(language, corrected.text, "p", cell.model.nominal.chain);
      EXPECT_EQ(without_cells(corrected.text, after), without_cells(text, before)) << "the rail's bytes are kept";
    }
  }
}

TEST(Rail, ThatALineDoesNotTellLeavesTheLine) {
  const RailCell cell = rail_cell(12, 2);
  for (const WrittenIn language : kOnRails) {
    for (const bool of_poses : {false, true}) {
      if (!is_written(language, of_poses)) continue;
      SCOPED_TRACE(to_string(language) + (of_poses ? " poses" : " joints"));
      const auto line = [&](int i) {
        const auto target = static_cast<std::size_t>(i) - 1;
        return rail_line(language, cell, target, of_poses, i == 1 ? "" : rail_text(cell, target));
      };
      const std::string text = with_bases(written(language, of_poses, 2, line, "\n"));
      const CorrectedProgram corrected = corrected_on_rail(language, cell, text);
      EXPECT_EQ(corrected.targets.size(), 1u);
      ASSERT_FALSE(corrected.program.uncorrected.empty());
      EXPECT_THAT(corrected.program.uncorrected.front().sentence,
                  HasSubstr("where the rail that carries the arm is to stand"));
      const std::size_t first = text.find(line(1));
      EXPECT_EQ(corrected.text.find(line(1)), first) << "left byte for byte";
      EXPECT_EQ(corrected.text.find(line(2)), std::string::npos) << "the other is corrected";
    }
  }
}

TEST(Rail, IsFollowedThroughTheMotionsOfAProgram) {
  const RailCell cell = rail_cell(13, 3);
  // No S and T: the configuration is known from the joints before, though the rail has gone 3 m meanwhile.
  const auto pose = [&](std::size_t target, const std::string& rail) {
    std::string line = rail_line(WrittenIn::krl, cell, target, true, rail);
    line = line.substr(line.find('{'));
    const std::size_t stated = line.find(",S 2");
    return line.erase(stated, line.find(rail.empty() ? "}" : ",E1") - stated);
  };
  const std::string joints = rail_line(WrittenIn::krl, cell, 0, false, "3400.0");
  const std::string text = "DEF m()\nPTP " + joints.substr(joints.find('{')) + "\nPTP " + pose(0, rail_text(cell, 0)) +
                           "\nPTP " + pose(1, "") + "\nLIN " + pose(0, rail_text(cell, 0)) + "\nEND\n";
  const CorrectedProgram corrected =
      correct_program(text, read_program(WrittenIn::krl, text, "p", cell.model.nominal.chain), cell.model, {});
  ASSERT_EQ(corrected.targets.size(), 3u);
  EXPECT_EQ(corrected.targets[1].outcome, CorrectionOutcome::corrected);
  EXPECT_EQ(corrected.targets[1].from, JointsFrom::before);
  EXPECT_LT((corrected.targets[1].nominal - cell.meant[0]).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(corrected.targets[2].from, JointsFrom::undetermined) << "where the arm is before is not known";
}

TEST(Rail, LinesAreThoseOfTheArmOnIt) {
  const RailCell cell = rail_cell(14, 1);
  JointVector from = cell.meant[0], to = from;
  from[0] += 2.0;
  to[0] -= 0.2;
  to[3] += 0.1;
  const auto ends = joints_after_line(
      cell.model.nominal.chain,
      [&] {
        JointVector carried = from;
        carried[0] = to[0];
        return carried;
      }(),
      believed(cell, to), 1);
  ASSERT_TRUE(ends);
  EXPECT_LT((*ends - to).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ((*ends)[0], to[0]);
}

TEST(Rail, ExternalAxesBehindItMayCarryTheArmAsEver) {
  const RailCell cell = rail_cell(15, 1);
  const Chain& chain = cell.model.nominal.chain;
  const auto frame_of = [&](WrittenIn language, const std::string& rail) {
    const Program program =
        read_program(language,
                     written(
                         language, true, 1, [&](int) { return rail_line(language, cell, 0, true, rail); }, "\n"),
                     "p", chain);
    EXPECT_EQ(program.targets.size(), 1u);
    return program.targets.empty() ? "" : program.targets.front().frames.unknown_frame;
  };
  EXPECT_EQ(frame_of(WrittenIn::krl, "100.0,E2 0.0"), "");
  EXPECT_THAT(frame_of(WrittenIn::krl, "100.0,E2 30.0"), HasSubstr("E2"));
  EXPECT_THAT(frame_of(WrittenIn::rapid, "100.0,30"), HasSubstr("eax_b"));
  EXPECT_THAT(frame_of(WrittenIn::fanuc_ls, "100.0 mm, E2= 30.0"), HasSubstr("e2"));
  const std::string moved = "EOffsOn;\n" + rail_line(WrittenIn::rapid, cell, 0, true, "100.0");
  EXPECT_TRUE(read_program(WrittenIn::rapid, moved, "p", chain).targets.empty()) << "the rail is moved besides";
}

TEST(Rail, IsOneOfLanguagesThatTellIt) {
  Robot arm;
  arm.chain = wrist_arm();
  const Chain chain = on_rail(arm).chain;
  EXPECT_THROW(read_program(WrittenIn::urscript, "movej([1,2,3,4,5,6])", "p", chain), InputError);
  Chain seven = wrist_arm();
  seven.joints.push_back(seven.joints.back());
  try {
    read_program(WrittenIn::krl, "PTP {A1 1,A2 2,A3 3,A4 4,A5 5,A6 6}", "p", seven);
    FAIL() << "joints that turn are no rail";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("7 joints, of which the first 0 slide"));
  }
}

}  // namespace
}  // namespace demecal
