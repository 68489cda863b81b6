// Programs with motions to a few named places, and what apply makes of those; NEAR and FLIPPED are close to POSE in two
// postures, LOW and HIGH on either side of MIDDLE.
#pragma once

#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "corrected_arm.hpp"
#include "languages/written_program.hpp"

namespace demecal {

inline JointVector joints_named(const std::string& name) {
  const double by = name == "LOW" ? -0.2 : name == "HIGH" ? 0.2 : name == "NEAR" || name == "FLIPPED" ? 0.05 : 0.0;
  JointVector joints(6);
  joints << 0.3, -1.0, 1.2, 0.35, 0.9, 0.1;
  joints.array() += by;
  if (name != "FLIPPED") return joints;
  joints[3] -= std::numbers::pi;
  joints[4] = -joints[4];
  joints[5] -= std::numbers::pi;
  return joints;
}

/// The place as the language writes it where a motion names no other: a pose for POSE, joints for others.
inline std::string place_named(WrittenIn language, const std::string& name, const CommandModel& model) {
  const JointVector joints = joints_named(name);
  const Eigen::Isometry3d pose = model.nominal_tool(joints);
  const bool of_pose = name == "POSE";
  if (language == WrittenIn::urscript) {
    const Eigen::Vector3d turn = vector_of(pose.linear());
    if (!of_pose) return '[' + listed({joints.data(), 6}, 9) + ']';
    return "p[" + listed({pose.translation().data(), 3}, 9) + ", " + listed({turn.data(), 3}, 9) + ']';
  }
  if (language == WrittenIn::krl) {
    if (!of_pose) return '{' + named({"A1", "A2", "A3", "A4", "A5", "A6"}, in_degrees(joints), 9) + '}';
    std::vector<double> values = in_mm(pose);
    for (const double angle : abc(pose)) values.push_back(angle);
    return '{' + named({"X", "Y", "Z", "A", "B", "C"}, values, 9) + '}';
  }
  if (language == WrittenIn::rapid)  // joints alone
    return "[[" + listed(in_degrees(joints), 9) + "],[9E9,9E9,9E9,9E9,9E9,9E9]],v1,fine,tool0;";
  if (!of_pose) return "#PPOINT(" + listed(in_degrees(joints), 9, ",") + ')';
  return "TRANS(" + listed(six_numbers(pose, pose.linear().eulerAngles(2, 1, 2)), 9, ",") + ')';
}

/// `lines` with every "@NAME" as what moves there, of one program of KRL, URScript, RAPID or AS.
inline std::string program_with_motions(WrittenIn language, const std::string& lines, const CommandModel& model) {
  struct Frame {
    std::string opening, before, behind, closing;
  };
  static const std::map<WrittenIn, Frame> kFrames{
      {WrittenIn::krl, {"DEF m()\n", "PTP ", "", "END\n"}},
      {WrittenIn::urscript, {"def m():\n", "movej(", ")", "end\nm()\n"}},
      {WrittenIn::rapid, {"MODULE m\nPROC main()\n", "MoveAbsJ ", "", "ENDPROC\nENDMODULE\n"}},
      {WrittenIn::kawasaki_as, {".PROGRAM m()\n", "JMOVE ", "", ".END\n"}}};
  const Frame& frame = kFrames.at(language);
  std::string text = frame.opening;
  for (std::size_t at = 0; at < lines.size(); ++at) {
    std::size_t end = at + 1;
    while (lines[at] == '@' && end < lines.size() && lines[end] >= 'A' && lines[end] <= 'Z') ++end;
    text += lines[at] != '@'
                ? lines.substr(at, 1)
                : frame.before + place_named(language, lines.substr(at + 1, end - at - 1), model) + frame.behind;
    at = end - 1;
  }
  return text + frame.closing;
}

/// An arm whose joint 1 stops elsewhere by the side that it comes from.
inline CommandModel lost_motion_model() {
  RandomStream stream{7541};
  const Robot nominal = elbow_arm(stream);
  CorrectedRobot identified = random_robot(stream, nominal.chain, 0.0, 0.0);
  identified.corrections.assign(nominal.chain.joints.size(), {});
  identified.effects = {
      {.kind = "backlash", .joint = 0, .settings = {}, .form = "approach", .formula = {}, .values = {2e-3}}};
  return unbounded_model(nominal, identified);
}

inline CorrectedProgram corrected_motions(WrittenIn language, const std::string& lines, const CommandModel& model) {
  const std::string text = program_with_motions(language, lines, model);
  return correct_program(text, read_program(language, text, "p", model.nominal.chain), model,
                         {.temperature_celsius = 20.0});
}

/// Which of the program's targets has the place's joints or is its pose.
inline std::size_t index_of(const CorrectedProgram& corrected, const std::string& place) {
  std::size_t found = corrected.targets.size();
  for (std::size_t i = 0; i < corrected.targets.size(); ++i) {
    const Target& target = corrected.program.targets[i];
    const bool first = !target.is_pose() && std::abs(target.joints[3].inside() - joints_named(place)[3]) < 1e-6;
    if (place == "POSE" ? target.is_pose() : first) found = std::min(found, i);
  }
  return found;
}

}  // namespace demecal
