#include "data_check/check_data.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "data/read_poses.hpp"
#include "data/spread_poses.hpp"
#include "data_check/searches.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "trials/explanations.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

constexpr std::size_t kTrialRows = 240;  ///< calibration rows that explanations are tried on
constexpr std::size_t kFewestRows = 6;   ///< below which base and tool alone explain anything

class DataChecker {
 public:
  explicit DataChecker(const DataSet& data) : data_(data), whole_(measured_trial(data, &target_of_)) {}

  std::optional<Eigen::Vector3d> tool_elsewhere() {
    trial_ = calibration_rows();
    if (whole_.tools_m.size() != 1 || trial_.rows.size() < kFewestRows) return std::nullopt;
    place();
    const Eigen::Vector3d &found_m = fit_.tools_m.front(), change_m = found_m - whole_.tools_m.front();
    const bool fits = fit_.has_links() && fit_.median_m <= kNotableShare * trial_.reach_m();
    return fits && is_another_tool(change_m, fit_.tool_covariance(0)) ? std::optional(found_m) : std::nullopt;
  }

  DataCheck run() {
    for (Finding& finding : find_lacking_spread(data_)) add(std::move(finding));
    for (Finding& finding : find_shared_poses(data_)) add(std::move(finding));
    if (auto payloads = find_implausible_payloads(data_)) add(std::move(*payloads));
    if (whole_.rows.empty())
      for (Finding& finding : find_small_angles(data_)) add(std::move(finding));
    if (!has_instrument(data_))
      for (Finding& finding : check_contacts(data_)) add(std::move(finding));
    trial_ = calibration_rows();
    if (trial_.rows.size() < kFewestRows) return std::move(check_);
    TrialFit placed = place();
    if (auto computed = find_computed_positions(trial_, placed)) add(std::move(*computed));
    note_axes(placed);
    if (fit_.median_m > kNotableShare * trial_.reach_m())
      note_motion(placed, std::min(0.5 * fit_.median_m, kImplausibleShare * trial_.reach_m()));
    for (Finding& finding : find_contradictions(data_, {whole_, trial_}, placed, fit_)) add(std::move(finding));
    if (check_.verdict() == DataVerdict::contradiction) return std::move(check_);
    note_moves();
    for (Finding& finding : find_wrong_orientations(data_, whole_, fit_)) add(std::move(finding));
    for (Finding& finding : find_other_base(data_, fit_)) add(std::move(finding));
    for (Finding& finding : find_other_tools(trial_, target_of_, fit_)) add(std::move(finding));
    if (check_.verdict() == DataVerdict::contradiction) return std::move(check_);
    if (!check_.has(FindingKind::computed_positions)) {
      for (Finding& finding : find_coarse_values(data_, trial_, fit_)) add(std::move(finding));
      if (!check_.has(FindingKind::taken_in_motion)) note_motion(placed, 0.85 * fit_.median_m);
      if (auto drift = find_drift_without_times(data_, trial_, fit_)) add(std::move(*drift));
    }
    check_rows();
    return std::move(check_);
  }

 private:
  const std::string& id_of(const TrialRow& row) const { return data_.poses[row.pose].pose_id; }
  void add(Finding finding) { check_.findings.push_back(std::move(finding)); }

  Trial calibration_rows() const {
    Trial trial{whole_.chain, whole_.tools_m, {}, 1};
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < whole_.rows.size(); ++i)
      if (data_.poses[whole_.rows[i].pose].set == PoseSet::calibration) rows.push_back(i);
    for (const std::size_t i : spread_poses(rows, kTrialRows)) trial.rows.push_back(whole_.rows[i]);
    return trial;
  }

  /// Fits base, tools and links to the trial; returns the fit of base and tools alone. Where the error is notable these
  /// are searched for, and taken from there if all fits so.
  TrialFit place() {
    TrialFit placed = fit_base_and_tools(trial_);
    fit_ = fit_arm(trial_, placed);
    const double notable_m = kNotableShare * trial_.reach_m();
    if (fit_.median_m <= notable_m) return placed;
    TrialFit searched = search_base_and_tools(trial_, placed);
    TrialFit with_links = fit_arm(trial_, searched);
    if (with_links.median_m > notable_m) return placed;
    fit_ = std::move(with_links);
    return searched;
  }

  void note_axes(TrialFit& placed) {
    CheckedRows rows{whole_, trial_};
    if (auto axes = find_wrong_axes(data_, rows, placed, fit_)) go_on_with(std::move(rows), std::move(*axes));
  }

  void note_motion(TrialFit& placed, double most_m) {
    CheckedRows rows{whole_, trial_};
    auto motion = find_taken_in_motion(data_, most_m, rows, placed, fit_);
    if (!motion) return;
    // Further off than any arm is: a fit to what was recorded would be of no arm.
    if (motion->as_given_mm > millimetres(kImplausibleShare * trial_.reach_m()))
      motion->kind = FindingKind::taken_on_the_way;
    go_on_with(std::move(rows), std::move(*motion));
  }

  void go_on_with(CheckedRows rows, Finding finding) {
    whole_ = std::move(rows.whole);
    trial_ = std::move(rows.trial);
    add(std::move(finding));
  }

  void note_moves() {
    CheckedRows rows{whole_, trial_};
    for (Finding& finding : take_out_moves(data_, rows, fit_)) add(std::move(finding));
    whole_ = std::move(rows.whole);
    trial_ = std::move(rows.trial);
  }

  /// Sets that fit only by themselves, then single poses of all sets.
  void check_rows() {
    for (const PoseSet set : {PoseSet::validation, PoseSet::accept}) {
      if (auto read = explain_wrong_rows(data_, whole_, fit_, set)) {
        add(std::move(*read));
      } else if (auto other = other_place_of(set)) {
        add(std::move(*other));
      } else if (auto named = name_wrong_rows(data_, whole_, fit_, set)) {
        add(std::move(*named));
      }
    }
    if (check_.verdict() == DataVerdict::contradiction) return;
    const PointPrediction predict{[this](const TrialRow& row) { return predicted_point(fit_, row); },
                                  [this](const TrialRow& row) { return fit_.deviations_off(row); }};
    for (Finding& finding : find_single_poses(data_, whole_.rows, predict, kNotableShare * trial_.reach_m()))
      add(std::move(finding));
  }

  /// Another frame or tool of a whole set; its points come back as they would lie without.
  std::optional<Finding> other_place_of(PoseSet set) {
    std::vector<TrialRow> rows;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < whole_.rows.size(); ++i) {
      if (data_.poses[whole_.rows[i].pose].set != set) continue;
      rows.push_back(whole_.rows[i]);
      places.push_back(i);
    }
    const auto other = find_other_set(fit_, rows);
    if (!other) return std::nullopt;
    for (std::size_t i = 0; i < rows.size(); ++i) whole_.rows[places[i]] = rows[i];
    Finding finding{.kind = other->by_tool ? FindingKind::wrong_tool : FindingKind::set_in_other_frame,
                    .as_given_mm = millimetres(other->as_given_m),
                    .if_changed_mm = millimetres(other->if_changed_m)};
    for (const TrialRow& row : rows) finding.poses.push_back(id_of(row));
    finding.sentence = fmt::format(
        "The {} poses were measured {}: their points lie {} from where the calibration poses put them {}. Errors of "
        "this set mean nothing until it is brought into the same frame.",
        to_string(set), other->by_tool ? "with another tool point" : "in another frame", distance_text(other->shift_m),
        before_and_after(other->as_given_m, other->if_changed_m));
    return finding;
  }

  const DataSet& data_;
  DataCheck check_;
  std::map<std::string, int> target_of_;  ///< which of the tools
  Trial whole_, trial_;
  TrialFit fit_;
};

}  // namespace

Trial measured_trial(const DataSet& data, std::map<std::string, int>* target_of) {
  Trial trial{data.robot.chain, {}, {}, std::max(1, static_cast<int>(data.stations.size()))};
  std::map<std::string, int> targets, stations;
  for (const MeasuredPose& pose : data.poses) {
    if (targets.try_emplace(pose.target, static_cast<int>(trial.tools_m.size())).second)
      trial.tools_m.push_back(nominal_tool(data, pose));
  }
  // The first station's poses name none.
  for (std::size_t i = 1; i < data.stations.size(); ++i) stations[data.stations[i].name] = static_cast<int>(i);
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    const MeasuredPose& pose = data.poses[i];
    if (!pose.position_m) continue;
    trial.rows.push_back({.joints = pose.joints,
                          .point_m = *pose.position_m,
                          .target = targets.at(pose.target),
                          .station = pose.station.empty() ? 0 : stations.at(pose.station),
                          .pose = i,
                          .sides = pose.approach.value_or(ApproachSigns()),
                          .payload_kg = pose.payload_kg.value_or(0.0),
                          .temperature_celsius = pose.temperature_celsius.value_or(0.0)});
  }
  if (target_of != nullptr) *target_of = std::move(targets);
  return trial;
}

std::optional<Eigen::Vector3d> tool_elsewhere(const DataSet& data) {
  return DataChecker(data).tool_elsewhere();
}

DataCheck check_data(const DataSet& data) {
  return DataChecker(data).run();
}

void require_joint_limits(const DataSet& data, const DataCheck& check) {
  std::vector<MeasuredPose> others;
  for (const MeasuredPose& pose : data.poses) {
    const auto names = [&pose](const Finding& finding) {
      return std::ranges::find(finding.poses, pose.pose_id) != finding.poses.end();
    };
    if (std::ranges::none_of(check.findings, names)) others.push_back(pose);
  }
  check_joint_limits(others, data.robot.chain, data.file);
}

DataCheck check_without_copies(DataSet& data) {
  std::vector<Finding> copies = take_out_copies(data);
  DataCheck check = check_data(data);
  for (Finding& copy : copies) check.findings.push_back(std::move(copy));
  if (check.verdict() != DataVerdict::contradiction) require_joint_limits(data, check);
  return check;
}

}  // namespace demecal::inline data_check
