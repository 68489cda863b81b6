// What a check of measured data found: which mistake, where, how much it costs, and in words.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace demecal::inline trials {

/// The mistakes that the check knows. Reports write their names as they stand here.
enum class FindingKind {
  joint_sign,
  joint_offset,
  joints_exchanged,
  axes_exchanged,
  mirrored,
  unit,
  convention,
  targets_exchanged,
  rows_shifted,
  rows_shuffled,
  rows_exchanged,
  instrument_moved,
  joint_zero_changed,
  stations_differ,
  computed_positions,
  coarse_values,
  taken_in_motion,
  drift_without_times,
  wrong_axes,
  set_in_other_frame,
  wrong_tool,
  constant_joint,
  degenerate_points,
  copied_rows,
  shared_poses,
  typing_error,
  wrong_contact,
  contact_moved,
  uneven_plane,
  wrong_kind,
  wrong_length,
  disagreeing_length,
  wrong_orientation,
  outlier,
  many_outliers,
  implausible_link,
  implausible_payload,
  taken_on_the_way,
  undeclared_registration,
  other_robot
};

std::string_view to_string(FindingKind kind);

/// Whether a finding of this kind is of the data set as a whole, so that no model of it means anything.
bool contradicts(FindingKind kind);
/// The same of a kind by its name; false of names that are none.
bool contradicts(std::string_view kind);

struct Finding {
  FindingKind kind = FindingKind::outlier;
  int joint = -1;                    ///< from 0; -1: of no joint
  std::vector<std::string> poses{};  ///< ids; empty: all
  /// The error as given, and that with the change the sentence proposes, mm: of single poses their own, otherwise the
  /// median over the poses that were tried; NaN where there is none.
  double as_given_mm = std::numeric_limits<double>::quiet_NaN();
  double if_changed_mm = std::numeric_limits<double>::quiet_NaN();
  std::string sentence{};
};

enum class DataVerdict { plausible, suspicious, contradiction };

std::string_view to_string(DataVerdict verdict);

struct DataCheck {
  std::vector<Finding> findings{};

  /// The worst of the findings'.
  DataVerdict verdict() const;
  /// Whether a finding of that kind is there.
  bool has(FindingKind kind) const;
  /// The names of the kinds that were found, each once, those that contradict the arm first.
  std::vector<std::string> kinds() const;
};

/// "0.21 mm", with as many digits as a reader needs.
std::string distance_text(double metres_value);

/// "(median error 412 mm as given, 0.21 mm if changed)"
std::string before_and_after(double as_given_m, double if_changed_m);

}  // namespace demecal::inline trials
