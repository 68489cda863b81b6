// The arm of a ROBOT.yaml as it is drawn there: rows or origins and axes, base and flange, couplings.
#pragma once

#include <string>

#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

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

}  // namespace demecal::inline config
