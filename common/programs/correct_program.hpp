// The correction of a program: every target is sent to where the real robot then reaches what was meant.
#pragma once

#include <string_view>

#include "programs/command_model.hpp"
#include "programs/program.hpp"

namespace demecal {

/// Circumstances of targets that do not state their own; none: the model's reference.
struct Circumstances {
  double payload_kg = 0.0;
  std::optional<double> temperature_celsius{};
};

enum class Correctedness {
  corrected,  ///< or in no need of it
  nearest,    ///< the model has no exact inverse here; what could be corrected is
  no_joints   ///< the nominal robot cannot reach the pose; it is left as it is
};

struct CorrectedTarget {
  Correctedness outcome = Correctedness::no_joints;
  Stop stop{JointVector()};      ///< the nominal joints and the circumstances they were corrected for
  JointVector nominal, command;  ///< joints, rad or m: as the program means, and as it is to be sent
  JointVector inverse;           ///< the model's own, of the whole pose; `command` differs where an orientation is kept
  Eigen::Isometry3d nominal_tool, command_tool;  ///< of the nominal robot there, base frame
  double left_m = 0.0;                           ///< position error that the model predicts after correction
  std::vector<std::string> texts{};              ///< of the cells, joints or position and then orientation; empty: kept
};

struct CorrectedProgram {
  Program program;
  std::vector<CorrectedTarget> targets;  ///< one for each of program.targets
  std::vector<Remark> warnings;          ///< by place in the text
  std::string text;                      ///< the program with its targets replaced, all else byte for byte
};

/// Sends every target to where model(command) = nominal(target): joints are replaced by the command; a pose is solved
/// for joints by the nominal robot, as its controller does, and replaced by where the nominal robot stands at the
/// command. Position and orientation both change, except where the file's orientation is kept (VAL II, thesis 5.2.2) or
/// unknown: then the position is such that the real tool point is exact.
///
/// A target that states no approach is approached from the target before it in the text: each joint's sign is that of
/// its last change of 2 mrad (2 mm) or more, 0 before the first.
///
/// Each of these is a warning: a target outside joint limits or the calibrated range, a correction larger than the
/// model states or than arms' errors are, no exact inverse, a configuration that the program states and the arm does
/// not have.
CorrectedProgram correct_program(std::string_view text, Program program, const CommandModel& model,
                                 const Circumstances& circumstances);

}  // namespace demecal
