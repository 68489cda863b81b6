// The correction of a program: every target is sent to where the real robot then reaches what was meant.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinematics/chain.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"
#include "programs/command_model.hpp"
#include "programs/target_correction.hpp"

namespace demecal::inline programs {

/// Circumstances of targets that do not state their own; none: the model's reference.
struct Circumstances {
  std::optional<double> payload_kg{};  ///< none: an empty hand
  std::optional<double> temperature_celsius{};
  JointVector near{};       ///< joints that the arm is near to where the program does not tell; empty: unknown
  bool tool_given = false;  ///< the model's tool is one that the user names
  /// Then, the model with the tool that was measured, for targets that state theirs; none: it is not needed.
  const CommandModel* own_tool = nullptr;
};

struct CorrectedProgram {
  Program program;
  std::vector<CorrectedTarget> targets;  ///< one for each of program.targets
  std::vector<Remark> warnings;          ///< by place in the files
  std::string
      text;  ///< the program, all its files behind each other, with its targets replaced, all else byte for byte
};

/// Sends every target to where model(command) = nominal(target): joints are replaced by the command; a pose is solved
/// for joints by the nominal robot, as its controller does, and replaced by where the nominal robot stands at the
/// command. Position and orientation both change, except where the file's orientation is kept (VAL II, thesis 5.2.2) or
/// unknown: then the position is such that the real tool point is exact.
///
/// A target that states no approach is approached as followed_motions() tells. Nothing is concluded from motions in
/// another of the program's files.
///
/// Where the program leaves several configurations possible (see ConfigurationFinder), and their corrections differ by
/// more than 0.05 mm or 0.03 deg, the target is left as it is; so is one whose frame or tool is not known, or
/// that would carry more than the arm can.
///
/// Each of these is a warning: a target that is left, a target outside joint limits or the measured range, a correction
/// larger than the model states or than arms' errors are, a direction that the calibration does not determine, no exact
/// inverse, a configuration that the program states and the arm does not have.
CorrectedProgram correct_program(std::string_view text, Program program, const CommandModel& model,
                                 const Circumstances& circumstances);

/// `text` with the cells of the program's targets replaced by their new texts; every other byte as it was. `begin`:
/// where in the program's text it stands, if it is a part of it.
std::string replaced(std::string_view text, const Program& program, const std::vector<CorrectedTarget>& targets,
                     std::size_t begin = 0);

/// The texts of the program's files, corrected.
std::vector<std::string> corrected_files(const ProgramSource& source, const CorrectedProgram& corrected);

/// A sentence for each thing that is not as it should be; none where all is well.
std::vector<std::string> warnings_of(const CorrectedTarget& corrected, const CommandModel& model);

/// The same of the program, as read, as a whole, such as a tool that was identified far from where it is described, or
/// effects that depend on what neither its targets nor `circumstances` state.
std::vector<std::string> warnings_of(const Program& program, const CommandModel& model,
                                     const Circumstances& circumstances);

}  // namespace demecal::inline programs
