// Where a pose was measured and which way it missed, and the arm that was there: what pictures of a report are drawn
// from.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace demecal::inline report {

/// Lists are empty, and numbers none, where nothing is known.
struct PosePlace {
  std::vector<double> joints{};           ///< commanded, deg (mm of prismatic joints)
  std::vector<double> position_mm{};      ///< measured
  std::vector<double> before_error_mm{};  ///< measured less predicted, by axis, of what the closed loop started from
  std::vector<double> after_error_mm{};   ///< of the model
  std::optional<double> temperature_celsius{}, time_s{};
};

/// Three rows of four numbers: a rotation, and a translation in mm as the last column.
using PlacementNumbers = std::vector<double>;

struct ArmJointEntry {
  std::string type;              ///< "revolute", "prismatic": about or along its axis z
  PlacementNumbers placement{};  ///< of its axis in the link before it, at value 0
};

/// The calibrated arm without corrections and effects: enough to draw it.
struct ArmEntry {
  PlacementNumbers base{};  ///< in the frame of the measurements
  std::vector<ArmJointEntry> joints{};
  PlacementNumbers flange{};      ///< in the last link
  std::vector<double> tool_mm{};  ///< in the flange
};

}  // namespace demecal::inline report
