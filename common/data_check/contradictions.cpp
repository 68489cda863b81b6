#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "kinematics/units.hpp"
#include "random/distributions.hpp"
#include "trials/explanations.hpp"
#include "trials/finding.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kHalf = 0.5;  ///< of the error, which an explanation must take away

class Contradictions {
 public:
  Contradictions(const DataSet& data, const CheckedRows& rows, const TrialFit& placed, const TrialFit& fit)
      : data_(data), whole_(rows.whole), trial_(rows.trial), placed_(placed), fit_(fit) {}

  std::vector<Finding> find() {
    const double reach_m = trial_.reach_m();
    if (fit_.median_m > kNotableShare * reach_m) {
      explain(reach_m);
    } else {
      look_for_wrong_rows();
    }
    return std::move(found_);
  }

 private:
  void add(Finding finding) { found_.push_back(std::move(finding)); }

  double error(const TrialRow& row) const { return (row.point_m - predicted_point(fit_, row)).norm(); }

  /// What the notable error of the trial comes from, if that can be told.
  void explain(double reach_m) {
    const double as_given_m = fit_.median_m, plausible_m = kImplausibleShare * reach_m;
    if (const auto beside = median_without_positioner_m(); beside < std::min(kHalf * as_given_m, plausible_m))
      return add_frame_beside_positioner(as_given_m, beside);
    const auto explained = best_explanation(trial_, placed_, std::min(kHalf * as_given_m, plausible_m));
    const auto shift = best_shift(whole_);
    Trial moved = trial_;
    TrialFit moved_fit = fit_;
    const bool has_moved = !find_moves(moved, moved_fit).empty();
    const double by_reading_m = explained ? explained->fit.median_m : as_given_m,
                 by_shift_m = shift ? shift->median_m : as_given_m,
                 by_move_m = has_moved ? moved_fit.median_m : as_given_m;
    const double least_m = std::min({by_reading_m, by_shift_m, by_move_m});
    if (least_m < std::min(kHalf * as_given_m, plausible_m)) {
      if (least_m == by_move_m) return explain_moved_rows(moved);
      if (least_m == by_reading_m) return add_readings(*explained, as_given_m);
      return add_order(FindingKind::rows_shifted, *shift, as_given_m);
    }
    if (as_given_m < plausible_m) return look_for_wrong_rows();
    if (const auto shuffled = find_shuffled_rows(whole_, 2.0 * plausible_m))
      return add_order(FindingKind::rows_shuffled, *shuffled, as_given_m);
    add_other_robot(as_given_m, reach_m);
  }

  /// Rows that would have been measured from another place may be read otherwise from the same: a move is named with
  /// what else the instrument did.
  void explain_moved_rows(const Trial& moved) {
    std::vector<std::size_t> rows(static_cast<std::size_t>(moved.stations), 0);
    for (const TrialRow& row : moved.rows) ++rows[static_cast<std::size_t>(row.station)];
    const auto longest = static_cast<int>(std::ranges::max_element(rows) - rows.begin());
    Trial there{moved.chain, moved.tools_m, {}, 1};
    for (TrialRow row : moved.rows) {
      if (row.station != longest) continue;
      row.station = 0;
      there.rows.push_back(std::move(row));
    }
    auto explained = explain_wrong_rows(data_, whole_, fit_arm(there, fit_base_and_tools(there)));
    if (explained && has_no_number(explained->kind)) add(std::move(*explained));
  }

  /// Where most rows fit and many do not, these may be read wrongly or stand beside the wrong joints.
  void look_for_wrong_rows() {
    auto named = name_wrong_rows(data_, whole_, fit_);
    auto explained = explain_wrong_rows(data_, whole_, fit_);
    if (!named && !explained) return;
    if (explained && has_no_number(explained->kind)) return add(std::move(*explained));
    Trial moved = trial_;
    TrialFit moved_fit = fit_;
    if (!find_moves(moved, moved_fit).empty() && !has_many_far(moved_fit)) return;  // named with what else it did
    if (explained) return add(std::move(*explained));
    if (const auto shift = shift_of_rest(whole_)) return add_shift_of_rest(*shift);
    if (!has_many_far(fit_arm_to_all(trial_, fit_))) return;
    add(std::move(*named));
  }

  /// Readings without a number of their own that bring the rows back: no move of the instrument does so by chance.
  static bool has_no_number(FindingKind kind) {
    return kind != FindingKind::joint_offset && kind != FindingKind::rows_shifted;
  }

  bool has_many_far(const TrialFit& fit) const {
    const double far_m = kImplausibleShare * trial_.reach_m();
    const auto far = std::ranges::count_if(fit.error_m, [=](double error_m) { return error_m > far_m; });
    return static_cast<double>(far) > kManyRows * static_cast<double>(trial_.rows.size());
  }

  void add_shift_of_rest(const RowReordering& shift) {
    std::vector<double> errors;
    for (const TrialRow& row : whole_.rows)
      if (std::ranges::binary_search(shift.poses, row.pose)) errors.push_back(error(row));
    add_order(FindingKind::rows_shifted, shift, median(std::move(errors)));
  }

  void add_readings(const BestExplanation& explained, double as_given_m) {
    for (const Explanation& one : explained.explanations)
      add_reading(one, explained.fit, as_given_m, "The data fit if ");
    for (const Explanation& one : explained.equals)
      add_reading(one, explained.fit, as_given_m, "As well, and these data cannot tell which, the data fit if ");
  }

  void add_reading(const Explanation& one, const TrialFit& fit, double as_given_m, const std::string& lead) {
    Explanation named = one;
    if (one.kind == FindingKind::mirrored) {
      Trial mirrored = trial_;
      one.apply(mirrored);
      named = axes_explanation(fit_base_and_tools(mirrored).sensor_from_base.front(), data_.frame == Frame::base);
    }
    add({.kind = named.kind,
         .joint = named.joint,
         .as_given_mm = millimetres(as_given_m),
         .if_changed_mm = millimetres(fit.median_m),
         .sentence = lead + named.clause + " " + before_and_after(as_given_m, fit.median_m) +
                     ". Correct the data or the robot file."});
  }

  void add_order(FindingKind kind, const RowReordering& order, double as_given_m) {
    std::string which;
    if (!order.poses.empty()) {
      const bool from_begin = order.poses.front() == whole_.rows.front().pose;
      const MeasuredPose& pose = data_.poses[from_begin ? order.poses.back() : order.poses.front()];
      which = fmt::format(" (line {}{})", pose.line, name_beside_line(pose));
    }
    add({.kind = kind,
         .poses = ids_of(order.poses),
         .as_given_mm = millimetres(as_given_m),
         .if_changed_mm = millimetres(order.median_m),
         .sentence =
             kind == FindingKind::rows_shuffled
                 ? fmt::format("The rows are mixed up: {} (median error {} as given). Bring joints and measured "
                               "points together by their ids.",
                               order.clause, distance_text(as_given_m))
                 : "The data fit if " + order.clause + which + " " + before_and_after(as_given_m, order.median_m) +
                       ". Correct the file."});
  }

  /// The median error of points that do not move with the positioner; infinite where there is none.
  double median_without_positioner_m() const {
    if (trial_.chain.positioner == 0) return std::numeric_limits<double>::infinity();
    Trial beside = trial_;
    for (TrialRow& row : beside.rows) row.joints.head(beside.chain.positioner).setZero();
    return fit_arm(beside, fit_base_and_tools(beside)).median_m;
  }

  void add_frame_beside_positioner(double as_given_m, double beside_m) {
    const int last = trial_.chain.positioner;
    add({.kind = FindingKind::other_robot,
         .as_given_mm = millimetres(as_given_m),
         .if_changed_mm = millimetres(beside_m),
         .sentence = fmt::format(
             "The positions fit if they do not move with the positioner ({} left out) {}: they are measured from "
             "where the arm stands, but with `positioner:` in the robot file they count from the workpiece that it "
             "carries. Give positions in the workpiece's frame, or calibrate a robot file without `positioner:` and "
             "`workpiece:` by the joints of the arm alone.",
             last == 1 ? std::string("joint 1") : fmt::format("joints 1 to {}", last),
             before_and_after(as_given_m, beside_m))});
  }

  void add_other_robot(double as_given_m, double reach_m) {
    add({.kind = FindingKind::other_robot,
         .as_given_mm = millimetres(as_given_m),
         .sentence = fmt::format(
             "The data are not of this robot: with base, tool and links fitted half of the poses are still {} off or "
             "more ({:.2g} % of the reach; real arms stay below {:.1g} %), and no sign, offset, exchange, unit, "
             "convention or order of rows explains it. Check the robot file against the arm.",
             distance_text(as_given_m), 100.0 * as_given_m / reach_m, 100.0 * kImplausibleShare)});
  }

  std::vector<std::string> ids_of(const std::vector<std::size_t>& poses) const {
    std::vector<std::string> ids;
    for (const std::size_t pose : poses) ids.push_back(data_.poses[pose].pose_id);
    return ids;
  }

  const DataSet& data_;
  const Trial &whole_, &trial_;
  const TrialFit &placed_, &fit_;
  std::vector<Finding> found_;
};

}  // namespace

std::vector<Finding> find_contradictions(const DataSet& data, const CheckedRows& rows, const TrialFit& placed,
                                         const TrialFit& fit) {
  return Contradictions(data, rows, placed, fit).find();
}

}  // namespace demecal::inline data_check
