#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data/spread_poses.hpp"
#include "data_check/check_data.hpp"
#include "data_check/searches.hpp"
#include "kinematics/units.hpp"
#include "trials/explanations.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

constexpr std::size_t kStationRows = 120;     ///< of each, that are tried
constexpr std::size_t kFewestOfStation = 20;  ///< below which a station says nothing of the arm by itself
constexpr double kTogetherOverAlone = 3.0;    ///< ratio of median errors that no single arm leaves
constexpr double kNoticedDifference_m = 1e-4;

/// The calibration rows of all stations.
Trial trial_of_stations(const DataSet& joined) {
  Trial whole = measured_trial(joined);
  Trial trial{whole.chain, whole.tools_m, {}, whole.stations};
  for (int station = 0; station < whole.stations; ++station) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < whole.rows.size(); ++i) {
      const TrialRow& row = whole.rows[i];
      if (row.station == station && joined.poses[row.pose].set == PoseSet::calibration) rows.push_back(i);
    }
    for (const std::size_t i : spread_poses(rows, kStationRows)) trial.rows.push_back(whole.rows[i]);
  }
  return trial;
}

Trial of_station(const Trial& trial, int station) {
  Trial alone{trial.chain, trial.tools_m, {}, 1};
  for (TrialRow row : trial.rows) {
    if (row.station != station) continue;
    row.station = 0;
    alone.rows.push_back(std::move(row));
  }
  return alone;
}

std::string names_of_stations(const DataSet& joined, const std::vector<int>& stations) {
  std::string names;
  for (const int station : stations)
    names += (names.empty() ? "" : " and ") + joined.stations[static_cast<std::size_t>(station)].name;
  return names;
}

Finding zero_finding(const DataSet& joined, const StationZero& zero) {
  Finding finding{.kind = FindingKind::joint_zero_changed,
                  .joint = zero.joint,
                  .as_given_mm = millimetres(zero.as_given_m),
                  .if_changed_mm = millimetres(zero.if_changed_m)};
  for (const TrialRow& row : measured_trial(joined).rows)
    if (std::ranges::find(zero.stations, row.station) != zero.stations.end())
      finding.poses.push_back(joined.poses[row.pose].pose_id);
  finding.sentence = fmt::format(
      "The zero of joint {} is another, by {}, in {} than at the other station{}, as after a collision or a new "
      "mastering {}. A model of all is wrong for each: take the stations one by one, the later with the model of the "
      "earlier as "
      "--prior, or measure again.",
      zero.joint + 1, zero_text(joined.robot.chain, zero.joint, zero.by), names_of_stations(joined, zero.stations),
      joined.stations.size() - zero.stations.size() > 1 ? "s" : "",
      before_and_after(zero.as_given_m, zero.if_changed_m));
  return finding;
}

/// How an arm of its own fits a station better than one arm fits all.
struct OtherArm {
  int station = 0;
  double together_m = 0.0, alone_m = 0.0;
};

std::optional<OtherArm> find_other_arm(const Trial& trial, const TrialFit& fit) {
  std::optional<OtherArm> worst;
  double most = kTogetherOverAlone;
  for (int station = 0; station < trial.stations; ++station) {
    const Trial own = of_station(trial, station);
    if (own.rows.size() < kFewestOfStation) return std::nullopt;
    std::vector<double> together;
    for (std::size_t i = 0; i < trial.rows.size(); ++i)
      if (trial.rows[i].station == station) together.push_back(fit.error_m[i]);
    const OtherArm one{station, median(std::move(together)), fit_arm(own, fit_base_and_tools(own)).median_m};
    if (one.together_m < one.alone_m + kNoticedDifference_m || one.together_m < most * one.alone_m) continue;
    most = one.together_m / one.alone_m;
    worst = one;
  }
  return worst;
}

}  // namespace

std::vector<Finding> check_stations(const DataSet& joined) {
  if (joined.stations.size() < 2) return {};
  const Trial trial = trial_of_stations(joined);
  const TrialFit fit = fit_arm(trial, fit_base_and_tools(trial));
  if (!fit.has_links()) return {};
  if (const auto zero = find_station_zero(trial, fit)) return {zero_finding(joined, *zero)};
  const auto other = find_other_arm(trial, fit);
  if (!other) return {};
  Finding finding{.kind = FindingKind::stations_differ,
                  .as_given_mm = millimetres(other->together_m),
                  .if_changed_mm = millimetres(other->alone_m)};
  finding.sentence = fmt::format(
      "The stations do not fit one arm: {} of errors are left at {} by one arm for all, {} by one of its own "
      "(medians). Another arm was measured, or this one was changed or loaded otherwise in between. Take the stations "
      "one by one, "
      "the later with the model of the earlier as --prior, and see what `check` says of it.",
      distance_text(other->together_m), names_of_stations(joined, {other->station}), distance_text(other->alone_m));
  return {finding};
}

}  // namespace demecal::inline data_check
