#include "data_check/check_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "data/pose_rules.hpp"
#include "data_check/coverage.hpp"
#include "data_check/explanations.hpp"
#include "data_check/instrument.hpp"
#include "data_check/row_order.hpp"
#include "data_check/single_poses.hpp"
#include "fitting/median.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/rotation_vector.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

constexpr std::size_t kTrialRows = 240;   ///< calibration rows that explanations are tried on
constexpr std::size_t kFewestRows = 6;    ///< below which base and tool alone explain anything
constexpr double kHalf = 0.5;             ///< of the error, which an explanation must take away
constexpr double kFar_m = 0.02;           ///< that no arm errs by
constexpr double kManyRows = 0.15;        ///< share of rows that are no single ones
constexpr double kOtherTool_m = 0.01;     ///< as CommandModel's: farther off another tool was measured
constexpr double kSureDeviations = 5.0;   ///< by which the tool is known to be elsewhere
constexpr double kMedianLength = 1.5382;  ///< median length of a vector of three standard normals
constexpr double kTurnedTool_m = 3e-3;    ///< within which a tool stands where a turn of the last joint puts it

const char* set_name(PoseSet set) {
  return set == PoseSet::calibration ? "calibration" : set == PoseSet::validation ? "validation" : "accept";
}

std::string millimetres_text(double metres_value) {
  const double mm = millimetres(metres_value);
  return fmt::format("{:.{}f} mm", mm, mm < 10.0 ? 2 : mm < 100.0 ? 1 : 0);
}

/// "(median error 412 mm as given, 0.21 mm if changed)"
std::string before_and_after(double as_given_m, double if_changed_m) {
  return fmt::format("(median error {} as given, {} if changed)", millimetres_text(as_given_m),
                     millimetres_text(if_changed_m));
}

class Check {
 public:
  explicit Check(const DataSet& data) : data_(data) {
    whole_.chain = data.robot.chain;
    for (const MeasuredPose& pose : data.poses) {
      if (target_of_.try_emplace(pose.target, static_cast<int>(whole_.tools_m.size())).second)
        whole_.tools_m.push_back(nominal_tool(data, pose));
    }
    for (std::size_t i = 0; i < data.poses.size(); ++i) {
      const MeasuredPose& pose = data.poses[i];
      if (pose.position_m) whole_.rows.push_back({pose.joints, *pose.position_m, target_of_.at(pose.target), 0, i});
    }
  }

  DataCheck run() {
    for (Finding& finding : find_lacking_spread(data_)) add(std::move(finding));
    if (whole_.rows.empty())
      for (Finding& finding : find_small_angles(data_)) add(std::move(finding));
    trial_ = calibration_rows();
    if (trial_.rows.size() < kFewestRows) return std::move(check_);
    const TrialFit placed = fit_base_and_tools(trial_);
    fit_ = fit_arm(trial_, placed);
    const double reach_m = trial_.reach_m();
    if (fit_.median_m > kNotableShare * reach_m) {
      explain(placed, reach_m);
    } else {
      look_for_shifted_rows();
    }
    if (check_.verdict() == DataVerdict::contradiction) return std::move(check_);
    note_moves();
    check_base_frame();
    check_tools();
    if (check_.verdict() == DataVerdict::contradiction) return std::move(check_);
    check_rows();
    return std::move(check_);
  }

 private:
  const std::string& id_of(const TrialRow& row) const { return data_.poses[row.pose].pose_id; }
  std::vector<std::string> ids_of(const std::vector<std::size_t>& poses) const {
    std::vector<std::string> ids;
    for (const std::size_t pose : poses) ids.push_back(data_.poses[pose].pose_id);
    return ids;
  }

  void add(Finding finding) { check_.findings.push_back(std::move(finding)); }

  Trial calibration_rows() const {
    Trial trial{whole_.chain, whole_.tools_m, {}, 1};
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < whole_.rows.size(); ++i)
      if (data_.poses[whole_.rows[i].pose].set == PoseSet::calibration) rows.push_back(i);
    for (const std::size_t i : spread_indices(rows.size(), kTrialRows)) trial.rows.push_back(whole_.rows[rows[i]]);
    return trial;
  }

  /// What the notable error of the trial comes from, if that can be told.
  void explain(const TrialFit& placed, double reach_m) {
    const double as_given_m = fit_.median_m, plausible_m = kImplausibleShare * reach_m;
    const auto explained = best_explanation(trial_, placed, std::min(kHalf * as_given_m, plausible_m));
    const auto shift = best_shift(whole_);
    Trial moved = trial_;
    TrialFit moved_fit = fit_;
    const bool has_moved = !find_moves(moved, moved_fit).empty();
    const double by_reading_m = explained ? explained->fit.median_m : as_given_m,
                 by_shift_m = shift ? shift->median_m : as_given_m,
                 by_move_m = has_moved ? moved_fit.median_m : as_given_m;
    const double least_m = std::min({by_reading_m, by_shift_m, by_move_m});
    if (least_m < std::min(kHalf * as_given_m, plausible_m)) {
      if (least_m == by_move_m) return;  // named with what else the instrument did
      if (least_m == by_reading_m) return add_readings(*explained, as_given_m);
      return add_order(FindingKind::rows_shifted, *shift, as_given_m);
    }
    if (as_given_m < plausible_m) return;
    if (const auto shuffled = as_shuffled(whole_, 2.0 * plausible_m))
      return add_order(FindingKind::rows_shuffled, *shuffled, as_given_m);
    add_other_robot(as_given_m, reach_m);
  }

  /// Where most rows fit and many do not, these may stand beside the wrong joints.
  void look_for_shifted_rows() {
    const auto far = std::ranges::count_if(trial_.rows, [this](const TrialRow& row) { return error(row) > kFar_m; });
    if (static_cast<double>(far) < kManyRows * static_cast<double>(trial_.rows.size())) return;
    const auto shift = shift_of_rest(whole_);
    if (!shift) return;
    std::vector<double> errors;
    for (const TrialRow& row : whole_.rows)
      if (std::ranges::binary_search(shift->poses, row.pose)) errors.push_back(error(row));
    add_order(FindingKind::rows_shifted, *shift, median(std::move(errors)));
  }

  void add_readings(const Explained& explained, double as_given_m) {
    for (const Explanation& one : explained.explanations)
      add_reading(one, explained.fit, as_given_m, "The data fit if ");
    for (const Explanation& one : explained.equals)
      add_reading(one, explained.fit, as_given_m, "As well, and these data cannot tell which, the data fit if ");
  }

  void add_reading(const Explanation& one, const TrialFit& fit, double as_given_m, const std::string& lead) {
    Explanation named = one;
    if (one.kind == FindingKind::mirrored)
      named = axes_explanation(fit.sensor_from_base.front(), data_.frame == Frame::base);
    add({.kind = named.kind,
         .joint = named.joint,
         .as_given_mm = millimetres(as_given_m),
         .if_changed_mm = millimetres(fit.median_m),
         .sentence = lead + named.clause + " " + before_and_after(as_given_m, fit.median_m) +
                     ". Correct the data or the robot file."});
  }

  void add_order(FindingKind kind, const Reordered& order, double as_given_m) {
    std::string which;
    if (!order.poses.empty()) {
      const bool from_begin = order.poses.front() == whole_.rows.front().pose;
      const MeasuredPose& pose = data_.poses[from_begin ? order.poses.back() : order.poses.front()];
      which = fmt::format(" (line {}, {})", pose.line, pose.pose_id);
    }
    add({.kind = kind,
         .poses = ids_of(order.poses),
         .as_given_mm = millimetres(as_given_m),
         .if_changed_mm = millimetres(order.median_m),
         .sentence =
             kind == FindingKind::rows_shuffled
                 ? fmt::format("The rows are mixed up: {} (median error {} as given). Bring joints and measured "
                               "points together by their ids.",
                               order.clause, millimetres_text(as_given_m))
                 : "The data fit if " + order.clause + which + " " + before_and_after(as_given_m, order.median_m) +
                       ". Correct the file."});
  }

  void add_other_robot(double as_given_m, double reach_m) {
    add({.kind = FindingKind::other_robot,
         .as_given_mm = millimetres(as_given_m),
         .sentence = fmt::format(
             "The data are not of this robot: with base, tool and links fitted half of the poses are still {} off or "
             "more ({:.2g} % of the reach; real arms stay below {:.1g} %), and no sign, offset, exchange, unit, "
             "convention or order of rows explains it. Check the robot file against the arm.",
             millimetres_text(as_given_m), 100.0 * as_given_m / reach_m, 100.0 * kImplausibleShare)});
  }

  /// Moves of the instrument among the calibration poses; the other rows get the station of their neighbours.
  void note_moves() {
    const std::vector<InstrumentMove> moves = find_moves(trial_, fit_);
    assign_stations();
    for (const InstrumentMove& move : moves) {
      const std::size_t row = first_row_of(trial_.rows[move.first_row].station);
      const MeasuredPose& pose = data_.poses[whole_.rows[row].pose];
      Finding finding{.kind = FindingKind::instrument_moved,
                      .as_given_mm = millimetres(move.as_given_m),
                      .if_changed_mm = millimetres(move.if_changed_m)};
      for (std::size_t i = row; i < whole_.rows.size(); ++i) finding.poses.push_back(id_of(whole_.rows[i]));
      finding.sentence = fmt::format(
          "The instrument (or the robot's base) moved before line {} ({}): from there on points lie {} elsewhere {}. "
          "Treat the poses before and after as two data sets, or measure again.",
          pose.line, pose.pose_id, millimetres_text(move.shift_m),
          before_and_after(move.as_given_m, move.if_changed_m));
      add(std::move(finding));
    }
  }

  /// Rows between two of the trial belong to the station of which their errors say so, in one change.
  void assign_stations() {
    if (trial_.stations == 1) return;
    std::size_t next = 0;
    for (TrialRow& row : whole_.rows) {
      while (next + 1 < trial_.rows.size() && trial_.rows[next].pose < row.pose) ++next;
      row.station = trial_.rows[next].station;
    }
    for (int station = 1; station < trial_.stations; ++station) {
      // Rows just before the change in the trial may belong to either side.
      const auto first = std::ranges::find(whole_.rows, station, &TrialRow::station);
      for (auto row = first; row != whole_.rows.begin() && row != whole_.rows.end();) {
        TrialRow other = *row;
        other.station = station - 1;
        if (error(*row) <= error(other) || row->pose == trial_first_pose(station)) break;
        row->station = station - 1;
        ++row;
      }
    }
  }

  std::size_t trial_first_pose(int station) const {
    return std::ranges::find(trial_.rows, station, &TrialRow::station)->pose;
  }
  std::size_t first_row_of(int station) const {
    return static_cast<std::size_t>(std::ranges::find(whole_.rows, station, &TrialRow::station) - whole_.rows.begin());
  }
  double error(const TrialRow& row) const { return (row.point_m - predicted_point(fit_, row)).norm(); }

  void check_base_frame() {
    if (data_.frame != Frame::base) return;
    const auto explanation = base_frame_explanation(fit_.sensor_from_base.front());
    if (!explanation) return;
    add({.kind = explanation->kind,
         .joint = explanation->joint,
         .sentence = contradicts(explanation->kind)
                         ? "The data, said to be in the base's frame, fit if " + explanation->clause +
                               ". Correct the data or the robot file."
                         : "The data are not in the base's frame: " + explanation->clause + "."});
  }

  /// Tools that the poses put elsewhere than the robot's description does.
  void check_tools() {
    for (const auto& [name, target] : target_of_) {
      const auto at = static_cast<std::size_t>(target);
      const Eigen::Vector3d nominal = whole_.tools_m[at], change = fit_.tools_m[at] - nominal;
      if (nominal.norm() == 0.0 || change.norm() < kOtherTool_m || !fit_.has_links()) continue;
      if (change.dot(fit_.tool_covariance(target).ldlt().solve(change)) < kSureDeviations * kSureDeviations * 3.0)
        continue;
      const std::string which = name.empty() ? "The tool point" : "The tool point of target " + name;
      if (const auto turn_deg = turn_of_last_joint(nominal, fit_.tools_m[at])) {
        add({.kind = FindingKind::joint_offset,
             .joint = whole_.chain.size() - 1,
             .sentence =
                 fmt::format("{} lies where {:+g} deg of joint {} would put it: the joint's zero, or the way the "
                             "tool is mounted, is not that of the robot file. Correct the data or the file.",
                             which, *turn_deg, whole_.chain.size())});
        continue;
      }
      add({.kind = FindingKind::wrong_tool,
           .sentence = fmt::format(
               "{} lies {} from where the robot file has it, at ({:.1f}, {:.1f}, {:.1f}) mm: another tool, or another "
               "point of it, was measured. Correct tool_mm, or tools_mm of the data set.",
               which, millimetres_text(change.norm()), millimetres(fit_.tools_m[at].x()),
               millimetres(fit_.tools_m[at].y()), millimetres(fit_.tools_m[at].z()))});
    }
  }

  /// The quarter turns of a last revolute joint that put the nominal tool where it was found, if any do.
  std::optional<double> turn_of_last_joint(const Eigen::Vector3d& nominal, const Eigen::Vector3d& found) const {
    const Joint& last = whole_.chain.joints.back();
    const double radius_m = nominal.head<2>().norm();
    // A link that follows the last axis on a slant has no such simple form.
    const bool along_axis =
        whole_.chain.convention == Convention::modified_dh || (last.a_m == 0.0 && last.alpha_rad == 0.0);
    if (last.type != JointType::revolute || !along_axis || radius_m < 4.0 * kTurnedTool_m) return std::nullopt;
    for (const double turn_deg : {90.0, -90.0, 180.0}) {
      const Eigen::Vector3d turned = rotation_of(Eigen::Vector3d(0, 0, radians(turn_deg))) * nominal;
      if ((turned - found).norm() < kTurnedTool_m) return turn_deg;
    }
    return std::nullopt;
  }

  /// Sets that fit only by themselves, then single poses of all sets.
  void check_rows() {
    for (const PoseSet set : {PoseSet::validation, PoseSet::accept}) check_set(set);
    const PointPrediction predict{[this](const TrialRow& row) { return predicted_point(fit_, row); },
                                  [this](const TrialRow& row) { return fit_.deviations_off(row); }};
    for (Finding& finding : find_single_poses(data_, whole_.rows, predict)) add(std::move(finding));
  }

  void check_set(PoseSet set) {
    std::vector<TrialRow> rows;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < whole_.rows.size(); ++i) {
      if (data_.poses[whole_.rows[i].pose].set != set) continue;
      rows.push_back(whole_.rows[i]);
      places.push_back(i);
    }
    const auto other = find_other_set(fit_, rows);
    if (!other) return;
    for (std::size_t i = 0; i < rows.size(); ++i) whole_.rows[places[i]] = rows[i];
    Finding finding{.kind = other->by_tool ? FindingKind::wrong_tool : FindingKind::set_in_other_frame,
                    .as_given_mm = millimetres(other->as_given_m),
                    .if_changed_mm = millimetres(other->if_changed_m)};
    for (const TrialRow& row : rows) finding.poses.push_back(id_of(row));
    finding.sentence = fmt::format(
        "The {} poses were measured {}: their points lie {} from where the calibration poses put them {}. Errors of "
        "this "
        "set mean nothing until it is brought into the same frame.",
        set_name(set), other->by_tool ? "with another tool point" : "in another frame",
        millimetres_text(other->shift_m), before_and_after(other->as_given_m, other->if_changed_m));
    add(std::move(finding));
  }

  const DataSet& data_;
  DataCheck check_;
  std::map<std::string, int> target_of_;  ///< which of the tools
  Trial whole_, trial_;
  TrialFit fit_;
};

}  // namespace

DataCheck check_data(const DataSet& data) {
  return Check(data).run();
}

void check_fitted(const DataSet& data, const CorrectedRobot& robot, DataCheck& check) {
  std::set<std::string> named;
  for (const Finding& finding : check.findings) named.insert(finding.poses.begin(), finding.poses.end());
  std::vector<TrialRow> rows;
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    const MeasuredPose& pose = data.poses[i];
    if (pose.position_m && !named.contains(pose.pose_id)) rows.push_back({pose.joints, *pose.position_m, 0, 0, i});
  }
  const auto point = [&](const TrialRow& row) -> Eigen::Vector3d {
    const MeasuredPose& pose = data.poses[row.pose];
    return robot.predict(Stop(pose).with_joints(row.joints), pose.target).translation();
  };
  const auto error = [&](const TrialRow& row) { return (row.point_m - point(row)).norm(); };
  std::vector<double> errors;
  for (const TrialRow& row : rows) errors.push_back(error(row));
  if (errors.empty()) return;
  const double deviation_m = std::max(median(errors) / kMedianLength, 1e-6);
  const PointPrediction predict{point, [&](const TrialRow& row) { return error(row) / deviation_m; }};
  for (Finding& finding : find_single_poses(data, rows, predict)) check.findings.push_back(std::move(finding));
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

}  // namespace demecal
