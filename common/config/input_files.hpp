// Files that stand on their own: an arm as its maker describes it, a simulated measurement, and where raw measurements,
// programs and taught points stand.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "preparation/prepared.hpp"
#include "preparation/readings.hpp"
#include "simulation/scenario.hpp"
#include "symbolic/algebra.hpp"
#include "symbolic/code.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

/// The robot of a ROBOT.yaml. Throws InputError with file, line, value and rule at the first fault.
Robot load_robot(const std::filesystem::path& path);

/// The same of a map already read, such as one inside another file; its version key is the caller's to check.
Robot read_robot(const YamlNode& node);

/// The ROBOT.yaml of an arm imported from a URDF, with what was assumed as comments. Paths are as in its arguments.
struct ImportRequest {
  std::string file;                      ///< the URDF
  std::optional<std::string> base, tip;  ///< links
  std::string beside;                    ///< the file that the text will stand in
};
struct ImportedRobot {
  std::string text;
  std::vector<std::string> notes;
};
ImportedRobot import_urdf(const ImportRequest& request);

/// The keys of a ROBOT.yaml but its version, one or more lines each, every line moved `indent` spaces to the right.
/// read_robot() reads them back.
std::string robot_text(const Robot& robot, int indent = 0);

/// The product of the matrices of a MATRICES.yaml, in their order: `joints` names the joints' symbols, `values` what
/// other symbols are, and each of `matrices` is three rows of four expressions. The joints become q1 .. qn, rad or m,
/// uncorrected. Throws InputError with file, line, value and rule at the first fault; a name that is neither a joint
/// nor a value is one.
Listing load_matrices(Algebra& algebra, const std::filesystem::path& path);

/// The scenario of a SCENARIO.yaml; its robot is named relative to it. Throws InputError with file, line, value and
/// rule at the first fault.
Scenario load_scenario(const std::filesystem::path& path);

/// Adds the errors of the map to the scenario, whose robot must be set. Throws InputError at the first fault.
void read_true_errors(const YamlNode& errors, Scenario& scenario);

/// Everything that a PREPARATION.yaml names, read; the files are taken relative to it. Throws InputError with file,
/// line, value and rule at the first fault in any of them.
RawMeasurements load_preparation(const std::filesystem::path& path);

/// What stands under `instrument`: three cords, or nothing where it is the word `points`, an instrument that reads
/// coordinates.
std::optional<CordInstrument> read_instrument(const YamlNode& node);

}  // namespace demecal::inline config
