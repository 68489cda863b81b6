#include "trials/finding.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstddef>

#include "errors/check.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline trials {
namespace {

struct KindRow {
  FindingKind kind;
  std::string_view name;
  bool contradicts;
};

constexpr std::array<KindRow, 40> kKinds{{{FindingKind::joint_sign, "joint_sign", true},
                                          {FindingKind::joint_offset, "joint_offset", true},
                                          {FindingKind::joints_exchanged, "joints_exchanged", true},
                                          {FindingKind::axes_exchanged, "axes_exchanged", true},
                                          {FindingKind::mirrored, "mirrored", true},
                                          {FindingKind::unit, "unit", true},
                                          {FindingKind::convention, "convention", true},
                                          {FindingKind::targets_exchanged, "targets_exchanged", true},
                                          {FindingKind::rows_shifted, "rows_shifted", true},
                                          {FindingKind::rows_shuffled, "rows_shuffled", true},
                                          {FindingKind::rows_exchanged, "rows_exchanged", false},
                                          {FindingKind::instrument_moved, "instrument_moved", false},
                                          {FindingKind::joint_zero_changed, "joint_zero_changed", false},
                                          {FindingKind::stations_differ, "stations_differ", false},
                                          {FindingKind::computed_positions, "computed_positions", false},
                                          {FindingKind::coarse_values, "coarse_values", false},
                                          {FindingKind::taken_in_motion, "taken_in_motion", false},
                                          {FindingKind::taken_on_the_way, "taken_on_the_way", true},
                                          {FindingKind::drift_without_times, "drift_without_times", false},
                                          {FindingKind::wrong_axes, "wrong_axes", false},
                                          {FindingKind::set_in_other_frame, "set_in_other_frame", false},
                                          {FindingKind::wrong_tool, "wrong_tool", false},
                                          {FindingKind::constant_joint, "constant_joint", false},
                                          {FindingKind::degenerate_points, "degenerate_points", false},
                                          {FindingKind::copied_rows, "copied_rows", false},
                                          {FindingKind::shared_poses, "shared_poses", false},
                                          {FindingKind::typing_error, "typing_error", false},
                                          {FindingKind::wrong_contact, "wrong_contact", false},
                                          {FindingKind::contact_moved, "contact_moved", false},
                                          {FindingKind::uneven_plane, "uneven_plane", false},
                                          {FindingKind::wrong_kind, "wrong_kind", true},
                                          {FindingKind::wrong_length, "wrong_length", true},
                                          {FindingKind::disagreeing_length, "disagreeing_length", false},
                                          {FindingKind::wrong_orientation, "wrong_orientation", false},
                                          {FindingKind::outlier, "outlier", false},
                                          {FindingKind::many_outliers, "many_outliers", true},
                                          {FindingKind::implausible_link, "implausible_link", false},
                                          {FindingKind::implausible_payload, "implausible_payload", false},
                                          {FindingKind::undeclared_registration, "undeclared_registration", true},
                                          {FindingKind::other_robot, "other_robot", true}}};

const KindRow& row_of(FindingKind kind) {
  const auto row = std::ranges::find(kKinds, kind, &KindRow::kind);
  DEMECAL_CHECK(row != kKinds.end(), "finding kind " << static_cast<int>(kind));
  return *row;
}

}  // namespace

std::string_view to_string(FindingKind kind) {
  return row_of(kind).name;
}

bool contradicts(FindingKind kind) {
  return row_of(kind).contradicts;
}

bool contradicts(std::string_view kind) {
  const auto row = std::ranges::find(kKinds, kind, &KindRow::name);
  return row != kKinds.end() && row->contradicts;
}

std::string_view to_string(DataVerdict verdict) {
  constexpr std::array<std::string_view, 3> kWords{"plausible", "suspicious", "contradiction"};
  return kWords.at(static_cast<std::size_t>(verdict));
}

DataVerdict DataCheck::verdict() const {
  if (findings.empty()) return DataVerdict::plausible;
  const bool contradiction = std::ranges::any_of(findings, [](const Finding& one) { return contradicts(one.kind); });
  return contradiction ? DataVerdict::contradiction : DataVerdict::suspicious;
}

bool DataCheck::has(FindingKind kind) const {
  return std::ranges::any_of(findings, [kind](const Finding& one) { return one.kind == kind; });
}

std::vector<std::string> DataCheck::kinds() const {
  std::vector<std::string> names;
  for (const bool contradicting : {true, false}) {
    for (const Finding& finding : findings) {
      const std::string_view name = to_string(finding.kind);
      if (contradicts(finding.kind) == contradicting && std::ranges::find(names, name) == names.end())
        names.emplace_back(name);
    }
  }
  return names;
}

std::string distance_text(double metres_value) {
  const double mm = millimetres(metres_value);
  return fmt::format("{:.{}f} mm", mm, mm < 10.0 ? 2 : mm < 100.0 ? 1 : 0);
}

std::string before_and_after(double as_given_m, double if_changed_m) {
  return fmt::format("(median error {} as given, {} if changed)", distance_text(as_given_m),
                     distance_text(if_changed_m));
}

}  // namespace demecal::inline trials
