// What apply makes of the points of a program, and what it says of each.
#pragma once

#include "corrected_arm.hpp"
#include "languages/written_program.hpp"

namespace demecal {

inline JointVector usual_joints() {
  JointVector joints(6);
  joints << 0.2, -1.0, 1.2, 0.35, 0.9, 0.1;
  return joints;
}

inline Eigen::Isometry3d flange_pose() {
  RandomStream stream{7521};
  return forward(elbow_arm(stream).chain, usual_joints());
}

inline Eigen::Isometry3d tool_pose() {
  RandomStream stream{7521};
  return flange_pose() * Eigen::Translation3d(elbow_arm(stream).chain.tool_m);
}

/// "corrected" or "left", and what is said of the target of this name: "left: line 5 changes it ...".
inline std::string judged(WrittenIn language, const std::vector<ProgramFile>& files, const std::string& name) {
  RandomStream stream{7521};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  const ProgramSource source(files);
  const CorrectedProgram corrected = correct_program(
      source.text(), read_program(row_of(language), source, model.nominal.chain), model, {.temperature_celsius = 20.0});
  std::string said = "left:";
  for (std::size_t i = 0; i < corrected.targets.size(); ++i) {
    const bool moved = corrected.program.targets[i].name == name && !corrected.targets[i].is_uncorrected();
    if (moved) said = "corrected:";
  }
  for (const Remark& warning : corrected.warnings) {
    if (warning.name == name) said += ' ' + warning.sentence;
  }
  return said;
}

inline std::string judged(WrittenIn language, const std::string& text, const std::string& name) {
  return judged(language, std::vector<ProgramFile>{{"p", text}}, name);
}

inline constexpr const char* kChanged = "changes it when the program runs";
inline constexpr const char* kUsed = "uses it otherwise than to move to it";

}  // namespace demecal
