// ROBOT.yaml: an arm as its maker describes it; and what may stand beside it: matrices of a derivation, frames and
// tools of a controller.
#pragma once

#include <filesystem>
#include <string>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "parsed_programs/program.hpp"
#include "symbolic/algebra.hpp"
#include "symbolic/code.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline data_files {

/// The robot of a ROBOT.yaml. Throws InputError with file, line, value and rule at the first fault.
Robot load_robot(const std::filesystem::path& path);

/// The same of a map already read, such as one inside another file; its version key is the caller's to check.
Robot read_robot(const YamlNode& node);

/// The keys of a ROBOT.yaml but its version, one or more lines each, every line moved `indent` spaces to the right.
/// read_robot() reads them back.
std::string robot_text(const Robot& robot, int indent = 0);

/// The product of the matrices of a MATRICES.yaml, in their order: `joints` names the joints' symbols, `values` what
/// other symbols are, and each of `matrices` is three rows of four expressions. The joints become q1 .. qn, rad or m,
/// uncorrected. Throws InputError with file, line, value and rule at the first fault; a name that is neither a joint
/// nor a value is one.
Listing load_matrices(Algebra& algebra, const std::filesystem::path& path);

/// The frames and tools of a FRAMES.yaml, which a controller keeps by number or name, and programs only name. Throws
/// InputError with file, line, value and rule at the first fault.
ControllerData load_frames(const std::filesystem::path& path);

// The arm as it is drawn there: rows or origins and axes, base and flange, couplings.

/// What `convention`, `base`, `joints`, `flange` and `couplings` of the map say. Throws InputError with file, line,
/// value and rule at the first fault.
DrawnArm read_drawing(const YamlNode& node);

/// Whether the drawing holds more than rows of Denavit-Hartenberg numbers, so that these alone would not write it back.
bool is_more_than_rows(const DrawnArm& arm);

/// One line of `joints`, without its margin.
std::string joint_text(const DrawnArm& arm, const DrawnJoint& joint);
/// "{xyz_mm: [...], rpy_deg: [...]}".
std::string origin_text(const Origin& origin);
/// "[{joint: 3, from: 2, factor: 1}]".
std::string couplings_text(const DrawnArm& arm);
/// As `convention` has it.
std::string convention_word(const DrawnArm& arm);

}  // namespace demecal::inline data_files
