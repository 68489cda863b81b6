// What a report says of single poses and contacts: how far they are off, where they were measured and which way they
// missed, and the arm that was there.
#pragma once

#include <algorithm>
#include <cstdint>
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

/// A joint that turns by `factor` of what another is commanded, beside its own command.
struct ArmCouplingEntry {
  std::uint64_t joint = 0, from = 0;
  double factor = 0.0;
};

/// The calibrated arm without corrections and effects: enough to draw it.
struct ArmEntry {
  PlacementNumbers base{};  ///< in the frame of the measurements
  std::vector<ArmJointEntry> joints{};
  PlacementNumbers flange{};      ///< in the last link
  std::vector<double> tool_mm{};  ///< in the flange
  std::vector<ArmCouplingEntry> couplings{};
};

/// One pose (one row of the data set).
struct PoseErrorEntry {
  std::string id, target, set;
  std::optional<double> before_mm;      ///< of what the closed loop started from
  std::optional<double> after_mm;       ///< of the model
  std::optional<double> interval95_mm;  ///< radius that holds 95 % of the errors there, measurement noise included
  std::vector<std::string> flags{};     ///< "outlier", "near_singular", "outside_measured"
  PosePlace place{};
};

/// The poses of one set that touch one contact: how far from where they have it on average (rms).
struct ContactEntry {
  std::string contact, set, kind;
  std::uint64_t poses = 0;
  std::optional<double> registered_rms_mm, before_rms_mm, after_rms_mm;
};

/// A known length between contacts as the poses of one set have it, minus what is known.
struct LengthErrorEntry {
  std::vector<std::string> between;
  std::string set;
  std::optional<double> known_mm, sigma_mm;
  std::optional<double> before_mm;  ///< of what the closed loop started from
  std::optional<double> error_mm;   ///< of the model
  /// Standard uncertainty of these, of the length and by the scatter of the touches at both ends.
  std::optional<double> uncertainty_mm{};
};

}  // namespace demecal::inline report
