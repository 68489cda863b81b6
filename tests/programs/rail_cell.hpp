// An arm on a rail, and programs for it in languages that know rails.
#pragma once

#include <array>
#include <numbers>
#include <string>
#include <vector>

#include "corrected_arm.hpp"
#include "languages/written_program.hpp"

namespace demecal {

inline constexpr double kRight = std::numbers::pi / 2;
inline constexpr std::array kOnRails{WrittenIn::krl, WrittenIn::rapid, WrittenIn::fanuc_ls, WrittenIn::yaskawa_jbi};

/// Whether programs of this kind are written here; of Yaskawa's pulses see below.
inline bool is_written(WrittenIn language, bool of_poses) {
  return of_poses || language != WrittenIn::yaskawa_jbi;
}

/// The motions of a Yaskawa job name positions of its base axis.
inline std::string with_bases(std::string text) {
  for (int i = 1; i <= 9; ++i) {
    const std::string number = "C0000" + std::to_string(i), motion = "MOVL " + number + " V=";
    const std::size_t at = text.find(motion);
    if (at != std::string::npos) text.replace(at, motion.size(), "MOVL " + number + " B" + number + " V=");
  }
  return text;
}

/// The robot on a rail along x of the base frame.
inline Robot on_rail(Robot robot) {
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

inline RailCell rail_cell(std::uint64_t seed, int targets) {
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
inline Eigen::Isometry3d believed(const RailCell& cell, const JointVector& joints) {
  Eigen::Isometry3d pose = forward(cell.arm.chain, joints.tail<6>()) * Eigen::Translation3d(cell.arm.chain.tool_m);
  pose.translation().x() += joints[0];
  return pose;
}

/// A motion to it, in the language; `rail` is how the rail's value is written.
inline std::string rail_line(WrittenIn language, const RailCell& cell, std::size_t target, bool of_pose,
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
  if (language == WrittenIn::yaskawa_jbi && !rail.empty()) line += "\nBC0000" + std::to_string(index) + '=' + rail;
  if (language == WrittenIn::fanuc_ls && !rail.empty()) replace("\n   GP2", ",\tE1=   " + rail + "  mm\n   GP2");
  return line;
}

inline std::string rail_text(const RailCell& cell, std::size_t target) {
  return listed(std::vector<double>{1e3 * cell.meant[target][0]}, 3);
}

inline std::string rail_program(WrittenIn language, const RailCell& cell, bool of_poses) {
  return with_bases(written(
      language, of_poses, static_cast<int>(cell.meant.size()),
      [&](int i) {
        const auto target = static_cast<std::size_t>(i) - 1;
        return rail_line(language, cell, target, of_poses, rail_text(cell, target));
      },
      "\n"));
}

/// How far the real tool point comes from where it is meant, when the controller is given this program.
inline std::vector<double> misses_m(WrittenIn language, const RailCell& cell, const std::string& text) {
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

inline CorrectedProgram corrected_on_rail(WrittenIn language, const RailCell& cell, const std::string& text) {
  // Where the rail stood then says nothing of which posture is near.
  JointVector near = cell.meant.front();
  near[0] = 3.9;
  return correct_program(text, read_program(language, text, "p", cell.model.nominal.chain), cell.model, {.near = near});
}

}  // namespace demecal
