// Robot files: the arm as its maker describes it, by link parameters or as matrices of text.
#pragma once

#include <filesystem>
#include <string>

#include "data/data_set.hpp"
#include "symbolic/code.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

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

}  // namespace demecal::inline config
