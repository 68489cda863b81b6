// No corrected program makes a robot worse in silence: random arms, the models found of them, and programs for them.
#include <gtest/gtest.h>

#include <cstdio>
#include <span>

#include "meant_program.hpp"
#include "parsed_programs/orientation.hpp"
#include "programs/nominal_joints.hpp"
#include "programs/target_correction.hpp"

namespace demecal {
namespace {

constexpr double kTolerance_m = 1e-5, kTolerance_rad = 1e-4;  // a repeatability of 0.01 mm, also at 0.1 m from the tool

struct Errors {
  double position_m = 0.0, orientation_rad = 0.0;
};

/// Of the real arm, sent to `commanded` where the program means its tool to stand as the nominal arm has it at `meant`.
Errors errors_of(const CalibratedCell& cell, const MeantProgram& program, const JointVector& commanded,
                 const JointVector& meant) {
  const Eigen::Vector3d described_m = cell.nominal.chain.tool_m;
  const bool same_tool = (program.tool.translation() - described_m).norm() < 1e-6;
  Eigen::Isometry3d real = cell.truth.robot.predict(Stop(commanded), "");
  const Eigen::Isometry3d& real_tool = cell.truth.robot.tool("");
  if (!same_tool) real = real * real_tool.inverse() * Eigen::Translation3d(program.tool.translation());
  Eigen::Isometry3d goal = forward(cell.nominal.chain, meant) * Eigen::Translation3d(program.tool.translation());
  const PoseError error = pose_error(real, goal);
  return {error.head<3>().norm(), error.tail<3>().norm()};
}

/// The joints that the controller takes for a target as written, knowing those that it takes for the target as meant.
std::optional<JointVector> sent(const CalibratedCell& cell, const MeantProgram& program, const Target& target,
                                const JointVector& meant) {
  if (!target.is_pose()) {
    JointVector joints(meant.size());
    for (Eigen::Index i = 0; i < joints.size(); ++i) joints[i] = target.joints[static_cast<std::size_t>(i)].inside();
    return joints;
  }
  std::vector<double> numbers;
  for (const Cell& cell_of : target.orientation) numbers.push_back(cell_of.inside());
  Eigen::Isometry3d pose(rotation_from(target.form, numbers));
  for (int i = 0; i < 3; ++i) pose.translation()[i] = target.position[static_cast<std::size_t>(i)].inside();
  Chain arm = cell.nominal.chain;
  arm.tool_m = program.tool.translation();
  Eigen::Isometry3d tool = program.frame * pose;
  tool.linear() = (tool.linear() * program.tool.linear().transpose()).eval();
  return nominal_joints(arm, tool, {.near = meant}, meant);
}

struct Tally {
  int programs = 0, lines = 0, warned = 0, worse = 0, ordinary = 0, ordinary_warned = 0, judged = 0;
  double before_m = 0.0, after_m = 0.0;  ///< sums over the lines judged
  std::string example{};                 ///< of a line that became worse
};

void run(const CalibratedCell& cell, const MeantProgram& program, Tally& tally) {
  const Program read = read_program(program.language, program.text, "p", cell.nominal.chain);
  ASSERT_EQ(read.targets.size(), program.joints.size()) << program.text;
  const CorrectedProgram corrected = correct_program(program.text, read, cell.model, {.near = program.near});
  const Program after = read_program(program.language, corrected.text, "p", cell.nominal.chain);
  ++tally.programs;
  for (std::size_t i = 0; i < program.joints.size(); ++i) {
    const auto on_line = [&](const Remark& remark) { return remark.place.line == read.targets[i].place.line; };
    const bool warned = std::any_of(corrected.warnings.begin(), corrected.warnings.end(), on_line);
    ++tally.lines;
    tally.warned += warned ? 1 : 0;
    const bool described_tool = (program.tool.translation() - cell.nominal.chain.tool_m).norm() < 1e-6;
    if (cell.ordinary && program.ordinary && described_tool) {
      ++tally.ordinary;
      tally.ordinary_warned += warned ? 1 : 0;
    }
    const auto joints = sent(cell, program, after.targets[i], program.joints[i]);
    const auto nominal = sent(cell, program, read.targets[i], program.joints[i]);
    if (!joints || !nominal) continue;
    const Errors before = errors_of(cell, program, *nominal, program.joints[i]),
                 now = errors_of(cell, program, *joints, program.joints[i]);
    if (warned) continue;
    ++tally.judged;
    tally.before_m += before.position_m;
    tally.after_m += now.position_m;
    const bool worse = now.position_m > before.position_m + kTolerance_m ||
                       now.orientation_rad > before.orientation_rad + kTolerance_rad;
    if (!worse) continue;
    ++tally.worse;
    tally.example = program.text + "\ntarget " + std::to_string(i + 1) + ": " + std::to_string(before.position_m) +
                    " m, " + std::to_string(before.orientation_rad) + " rad became " + std::to_string(now.position_m) +
                    " m, " + std::to_string(now.orientation_rad) + " rad";
  }
}

/// Joints after the controller's own idea of a motion to the pose at `wanted`; nothing where it would not come there.
std::optional<JointVector> reached(const CalibratedCell& cell, const MeantProgram& program,
                                   const std::optional<JointVector>& present, const JointVector& wanted, bool line,
                                   bool stated) {
  Chain arm = cell.nominal.chain;
  arm.tool_m = program.tool.translation();
  const Eigen::Isometry3d tool = forward(arm, wanted) * Eigen::Translation3d(arm.tool_m);
  if (stated || !present) return wanted;
  if (line) {
    const auto end = joints_after_line(arm, *present, tool);
    return end;
  }
  std::vector<JointVector> all = joints_reaching(arm, tool, *present);
  std::sort(all.begin(), all.end(), [&](const JointVector& one, const JointVector& other) {
    return (one - *present).norm() < (other - *present).norm();
  });
  if (all.empty()) return std::nullopt;
  return all.front();
}

/// Languages whose targets have any number of joints, and others, come first.
constexpr WrittenIn kStatingLanguages[] = {WrittenIn::val2, WrittenIn::csv, WrittenIn::krl, WrittenIn::rapid,
                                           WrittenIn::urscript};
/// Those that state configurations in words whose meaning is not known, or state none.
constexpr WrittenIn kWordedLanguages[] = {WrittenIn::fanuc_ls, WrittenIn::yaskawa_jbi, WrittenIn::val3,
                                          WrittenIn::kawasaki_as};

MeantProgram random_program(RandomStream& stream, const CalibratedCell& cell, int kind,
                            std::span<const WrittenIn> languages) {
  const WrittenIn language = languages[kind == 2 ? stream.index(2) : stream.index(languages.size())];
  ProgramWriter writer(language, cell);
  const bool of_joints = kind == 2 || (has_joint_targets(language) && stream.chance(0.3));
  const bool extends = stream.chance(0.1), singular = stream.chance(0.05);
  const double half_range = extends ? 2.0 : 0.5;
  const bool worded =
      language == WrittenIn::fanuc_ls || language == WrittenIn::yaskawa_jbi || language == WrittenIn::val3;
  const bool conf = language == WrittenIn::krl || language == WrittenIn::rapid || worded;
  const bool frames = language == WrittenIn::krl || language == WrittenIn::rapid || language == WrittenIn::val3;
  const bool tools = frames || language == WrittenIn::val2 || language == WrittenIn::urscript;
  writer.meant.states_tool = stream.chance(0.5) && tools;
  writer.meant.states_frame = stream.chance(0.5) && frames;
  if (writer.meant.states_tool) {
    if (stream.chance(0.5)) writer.meant.tool.translation() = random_change(stream, 3, 0.2);
    writer.meant.tool.linear() = random_pose(stream).linear();
  }
  if (writer.meant.states_frame) writer.meant.frame = random_pose(stream);
  writer.open();
  std::optional<JointVector> present;
  bool far_start = false;
  const bool starts_known =
      !of_joints && language != WrittenIn::csv && has_joint_targets(language) && stream.chance(0.6);
  if (starts_known) {
    const bool far = stream.chance(0.5);
    far_start = far;
    present = joints_about(stream, cell.middle, far ? 1.2 : 0.3);
    writer.joint_move(*present);
  } else if (!of_joints && stream.chance(0.5)) {
    present = joints_about(stream, cell.middle, 0.2);
    writer.meant.near = *present;
  }
  writer.meant.ordinary = !extends && !singular && !far_start && (of_joints || (conf && !worded) || present);
  for (int i = 0; i < 3; ++i) {
    JointVector wanted = joints_about(stream, cell.middle, half_range);
    if (singular && kind == 0) wanted[4] = stream.real(-0.02, 0.02);
    if (of_joints) {
      writer.joint_move(wanted);
      continue;
    }
    const bool line = stream.chance(0.6);
    // Where nothing tells, the arm may stand in any of its configurations.
    if (!conf && !present) {
      Chain arm = cell.nominal.chain;
      arm.tool_m = writer.meant.tool.translation();
      const Eigen::Isometry3d tool = forward(arm, wanted) * Eigen::Translation3d(arm.tool_m);
      const std::vector<JointVector> all = joints_reaching(arm, tool, wanted);
      wanted = all[stream.index(all.size())];
    }
    const bool follows_lines = language == WrittenIn::urscript || language == WrittenIn::kawasaki_as ||
                               language == WrittenIn::fanuc_ls || language == WrittenIn::yaskawa_jbi;
    const bool by_line = line && follows_lines && (i > 0 || starts_known);
    const auto joints = reached(cell, writer.meant, present, wanted, by_line, conf && !by_line);
    if (!joints || (*joints).cwiseAbs().maxCoeff() > 2.96) break;
    if ((*joints - cell.middle).cwiseAbs().maxCoeff() > 0.55) writer.meant.ordinary = false;
    writer.pose_move(*joints, line);
    present = joints;
  }
  return writer.finished();
}

/// Ten programs for each of so many cells.
Tally tally_of(std::uint64_t seed, int cells, bool certain, std::span<const WrittenIn> languages = kStatingLanguages) {
  constexpr int kProgramsEach = 10;
  RandomStream stream{seed};
  Tally tally;
  for (int i = 0; i < cells; ++i) {
    const bool of_seven = i % 5 == 4 && languages.data() == kStatingLanguages;
    const int kind = of_seven ? 2 : i % 2;
    CalibratedCell cell = calibrated_cell(stream, kind);
    if (!cell.fitted) continue;
    if (certain) cell.model.posterior.reset();
    for (int k = 0; k < kProgramsEach; ++k) {
      const MeantProgram program = random_program(stream, cell, kind, languages);
      if (!program.joints.empty()) run(cell, program, tally);
    }
  }
  std::printf(
      "%d programs, %d lines, %d warned about; %d judged, %d worse, mean error %.3f mm before, %.3f after; of %d "
      "ordinary lines %d warned about\n",
      tally.programs, tally.lines, tally.warned, tally.judged, tally.worse, 1e3 * tally.before_m / tally.judged,
      1e3 * tally.after_m / tally.judged, tally.ordinary, tally.ordinary_warned);
  return tally;
}

TEST(CorrectedPrograms, AreNeverWorseInSilence) {
  const Tally tally = tally_of(7601, 201, false);
  EXPECT_GE(tally.programs, 2000);
  EXPECT_EQ(tally.worse, 0) << tally.example;
  EXPECT_LT(tally.after_m, 0.1 * tally.before_m);
  EXPECT_GT(tally.ordinary, 1000);
  EXPECT_LT(tally.ordinary_warned, 0.05 * tally.ordinary);
}

TEST(CorrectedPrograms, AreNeverWorseInSilenceWhereWordsStateTheConfiguration) {
  const Tally tally = tally_of(7603, 101, false, kWordedLanguages);
  EXPECT_GE(tally.programs, 900);
  EXPECT_EQ(tally.worse, 0) << tally.example;
  EXPECT_LT(tally.after_m, 0.1 * tally.before_m);
  EXPECT_GT(tally.judged, 1000);
}

TEST(CorrectedPrograms, AreWorseWhereTheModelIsBelievedInAllDirections) {
  EXPECT_GT(tally_of(7602, 30, true).worse, 20);
}

}  // namespace
}  // namespace demecal
