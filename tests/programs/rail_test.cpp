// Arms on rails in robot programs: where the rail stands is read and kept, and the arm's joints take the correction.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corrected_arm.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "languages/written_program.hpp"
#include "programs/configuration.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

constexpr double kRight = std::numbers::pi / 2;
constexpr std::array kOnRails{WrittenIn::krl, WrittenIn::rapid, WrittenIn::fanuc_ls};

/// The robot on a rail along x of the base frame.
Robot on_rail(Robot robot) {
  Chain& chain = robot.chain;
  chain.base = Eigen::AngleAxisd(kRight, Eigen::Vector3d::UnitY()) * chain.base;
  Joint rail;
  rail.type = JointType::prismatic;
  rail.theta_rad = kRight;
  rail.alpha_rad = -kRight;
  rail.upper = 4.0;
  chain.joints.front().theta_rad -= kRight;
  chain.joints.insert(chain.joints.begin(), rail);
  return robot;
}

struct RailCell {
  Robot arm;  ///< without the rail
  CommandModel model;
  std::vector<JointVector> meant{};  ///< of the rail and the arm

  JointVector arm_joints(std::size_t target) const { return meant[target].tail<6>(); }
};

RailCell rail_cell(std::uint64_t seed, int targets) {
  RandomStream stream{seed};
  Robot arm;
  arm.chain = wrist_arm();
  arm.chain.tool_m = {0.15, 0.002, 0.056};
  const Robot railed = on_rail(arm);
  CorrectedRobot real = random_robot(stream, railed.chain, 1e-3, 1e-3);
  RailCell cell{arm, unbounded_model(railed, real)};
  for (int i = 0; i < targets; ++i) {
    JointVector joints(7);
    joints << 0.4 * (i + 1), 0.3, -0.5, 0.5, 0.35, 0.9, 0.1;
    for (Eigen::Index joint = 1; joint < 7; ++joint) joints[joint] += stream.real(-0.2, 0.2);
    cell.meant.push_back(joints);
  }
  return cell;
}

/// Where the controller, which believes the nominal arm to stand at the rail's value, means the tool to go.
Eigen::Isometry3d believed(const RailCell& cell, const JointVector& joints) {
  Eigen::Isometry3d pose = forward(cell.arm.chain, joints.tail<6>()) * Eigen::Translation3d(cell.arm.chain.tool_m);
  pose.translation().x() += joints[0];
  return pose;
}

/// A motion to it, in the language; `rail` is how the rail's value is written.
std::string rail_line(WrittenIn language, const RailCell& cell, std::size_t target, bool of_pose,
                      const std::string& rail) {
  const JointVector joints = cell.arm_joints(target);
  const Eigen::Isometry3d pose = believed(cell, cell.meant[target]);
  const int index = static_cast<int>(target) + 1;
  std::string line = of_pose ? pose_line(language, pose, joints, index, 7) : joints_line(language, joints, index, 7);
  const auto replace = [&](const std::string& old, const std::string& fresh) {
    const std::size_t at = line.find(old);
    if (at != std::string::npos) line.replace(at, old.size(), fresh);
  };
  if (language == WrittenIn::krl) replace(",E1 0.0", rail.empty() ? "" : ",E1 " + rail);
  if (language == WrittenIn::rapid)
    replace("[9E+09,9E+09,",
            rail.empty() ? "[9E+09,9E+09," : '[' + rail + (rail.find(',') != rail.npos ? "," : ",9E+09,"));
  if (language == WrittenIn::fanuc_ls && !rail.empty()) replace("\n   GP2", ",\tE1=   " + rail + "  mm\n   GP2");
  return line;
}

std::string rail_text(const RailCell& cell, std::size_t target) {
  return listed(std::vector<double>{1e3 * cell.meant[target][0]}, 3);
}

std::string rail_program(WrittenIn language, const RailCell& cell, bool of_poses) {
  return written(
      language, of_poses, static_cast<int>(cell.meant.size()),
      [&](int i) {
        const auto target = static_cast<std::size_t>(i) - 1;
        return rail_line(language, cell, target, of_poses, rail_text(cell, target));
      },
      "\n");
}

/// How far the real tool point comes from where it is meant, when the controller is given this program.
std::vector<double> misses_m(WrittenIn language, const RailCell& cell, const std::string& text) {
  const Program program = read_program(language, text, "p", cell.model.nominal.chain);
  std::vector<double> misses;
  for (std::size_t i = 0; i < program.targets.size(); ++i) {
    const Target& target = program.targets[i];
    JointVector sent = cell.meant[i];
    if (target.is_pose()) {
      // By the six joints of an arm that stands there, which knows of no rail.
      Eigen::Isometry3d pose = stated_tool_pose(target);
      pose.translation().x() -= cell.meant[i][0];
      sent.tail<6>() = nominal_joints(cell.arm.chain, pose, {.near = cell.arm_joints(i)}, cell.arm_joints(i)).value();
    } else {
      for (Eigen::Index joint = 0; joint < 6; ++joint)
        sent[joint + 1] = target.joints[static_cast<std::size_t>(joint)].inside();
    }
    const Eigen::Vector3d reached = cell.model.robot.predict(Stop(sent), "").translation();
    misses.push_back((reached - believed(cell, cell.meant[i]).translation()).norm());
  }
  return misses;
}

CorrectedProgram corrected_on_rail(WrittenIn language, const RailCell& cell, const std::string& text) {
  // Where the rail stood then says nothing of which posture is near.
  JointVector near = cell.meant.front();
  near[0] = 3.9;
  return correct_program(text, read_program(language, text, "p", cell.model.nominal.chain), cell.model, {.near = near});
}

TEST(Rail, StaysWhereTheProgramHasItAndTheArmTakesTheCorrection) {
  const RailCell cell = rail_cell(11, 9);
  for (const WrittenIn language : kOnRails) {
    for (const bool of_poses : {false, true}) {
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
      SCOPED_TRACE(to_string(language) + (of_poses ? " poses" : " joints"));
      const auto line = [&](int i) {
        const auto target = static_cast<std::size_t>(i) - 1;
        return rail_line(language, cell, target, of_poses, i == 1 ? "" : rail_text(cell, target));
      };
      const std::string text = written(language, of_poses, 2, line, "\n");
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
