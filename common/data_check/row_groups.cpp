#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "random/distributions.hpp"
#include "trials/explanations.hpp"
#include "trials/finding.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kOffOverMedian = 10.0;  ///< times the median, beyond which a row is off while the others fit
constexpr double kMostRows = 0.7;        ///< of fitted ones, above which too few are left to hold the others against
constexpr double kShareExplained = 0.8;  ///< of the rows that are off, which an explanation must bring back
constexpr double kFallOfMedian = 0.2;    ///< ratio of their median errors, after to before
constexpr std::size_t kFewestOff = 5;
constexpr double kUnforeseen = 8.0;  ///< deviations that a set's prediction is off by where nothing foretells it
constexpr int kMostGroupShift = 3;
constexpr std::ptrdiff_t kNearEnd = 3;  ///< rows before the last one that may fit by chance

/// How rows that are off would fit: the row of the whole file taken otherwise.
struct GroupReading {
  FindingKind kind = FindingKind::joint_sign;
  int joint = -1;
  std::string clause;
  std::function<std::optional<TrialRow>(std::size_t)> row;  ///< nothing where there is no such row
  double median_m = 0.0;
  std::size_t fitting = 0;
};

class WrongRows {
 public:
  WrongRows(const DataSet& data, const Trial& whole, const TrialFit& fit, PoseSet set = PoseSet::calibration)
      : data_(data), whole_(whole), fit_(fit), set_(set) {
    limit_m_ = std::max(kNotableShare * whole.reach_m(), kOffOverMedian * fit.median_m);
    for (std::size_t i = 0; i < whole_.rows.size(); ++i) {
      if (data_.poses[whole_.rows[i].pose].set != set_) continue;
      const double error_m = error(whole_.rows[i]);
      if (error_m > limit_m_) off_.push_back(i), errors_m_.push_back(error_m), places_.push_back(fitted_);
      ++fitted_;
    }
  }

  /// Of a set that the fit did not see they may be all.
  bool are_many() const {
    const bool too_many = set_ == PoseSet::calibration && are_most();
    return off_.size() >= kFewestOff && !too_many && are_share(off_.size());
  }

  /// So many that what differs may be of the set as a whole.
  bool are_most() const { return static_cast<double>(off_.size()) > kMostRows * static_cast<double>(fitted_); }

  /// The rows that are off are fewer, but stand together as rows of another file or of a later day do.
  bool are_a_block() const {
    return !are_many() && off_.size() >= kFewestOff && !are_most() && stand_together(places_);
  }

  /// The rows that are off by more than `least_m` alone are many; of a set that the fit did not see, those by more than
  /// it foretells besides: poses far from the calibrated ones may be off by much.
  bool are_many_beyond(double least_m) const {
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < off_.size(); ++i) {
      const bool foretold = set_ != PoseSet::calibration && fit_.deviations_off(whole_.rows[off_[i]]) < kUnforeseen;
      if (errors_m_[i] > least_m && !foretold) ++beyond;
    }
    return are_many() && are_share(beyond);
  }

  std::optional<Finding> explained() const {
    std::optional<GroupReading> best;
    const auto take = [&](GroupReading reading) { take_better(std::move(reading), best); };
    for (const Explanation& one : whole_set_explanations(whole_.chain)) take(reading_of(one));
    for (const Explanation& one : column_unit_explanations()) take(reading_of(one));
    for (const Explanation& one : axes_explanations()) take(reading_of(one));
    for (const Explanation& one : target_explanations()) take(reading_of(one));
    for (int shift = -kMostGroupShift; shift <= kMostGroupShift; ++shift)
      if (shift != 0) take(shifted(shift));
    if (!best && are_many() && !are_most()) best = best_offset();
    return best ? std::optional(finding_of(*best)) : std::nullopt;
  }

  /// Of a whole set: by an offset of one joint, which a turned frame looks like.
  std::optional<Finding> explained_by_offset() const {
    const auto best = best_offset();
    return best ? std::optional(finding_of(*best)) : std::nullopt;
  }

  Finding unexplained() const {
    Finding finding = started(FindingKind::many_outliers);
    finding.sentence +=
        ", and no sign, offset, exchange, unit or shift of rows that was tried explains them. Find out what differs in "
        "these rows (their order among them), or leave them out.";
    return finding;
  }

 private:
  double error(const TrialRow& row) const { return (row.point_m - predicted_point(fit_, row)).norm(); }
  const MeasuredPose& pose_of(std::size_t row) const { return data_.poses[whole_.rows[row].pose]; }

  bool are_share(std::size_t rows) const {
    return static_cast<double>(rows) >= kManyRows * static_cast<double>(fitted_);
  }

  void take_better(GroupReading reading, std::optional<GroupReading>& best) const {
    weigh(reading);
    if (reading.fitting < static_cast<std::size_t>(std::ceil(kShareExplained * static_cast<double>(off_.size()))) ||
        reading.median_m > kFallOfMedian * median(errors_m_))
      return;
    if (!best || reading.median_m < 0.5 * best->median_m) best = std::move(reading);
  }

  std::optional<GroupReading> best_offset() const {
    std::optional<GroupReading> best;
    for (int joint = 0; joint < whole_.chain.size(); ++joint)
      if (is_revolute(whole_.chain, joint)) take_better(offset_of(joint), best);
    return best;
  }

  Finding finding_of(const GroupReading& reading) const {
    Finding finding = started(reading.kind);
    finding.joint = reading.joint;
    finding.if_changed_mm = millimetres(reading.median_m);
    finding.sentence += "; they fit if " + reading.clause + " " +
                        before_and_after(median(errors_m_), reading.median_m) + ". Correct these rows.";
    return finding;
  }

  void weigh(GroupReading& reading) const {
    std::vector<double> errors_m;
    for (const std::size_t i : off_) {
      const std::optional<TrialRow> row = reading.row(i);
      errors_m.push_back(row ? error(*row) : errors_m_[errors_m.size()]);
    }
    reading.fitting = static_cast<std::size_t>(
        std::ranges::count_if(errors_m, [this](double error_m) { return error_m <= limit_m_; }));
    reading.median_m = median(std::move(errors_m));
  }

  GroupReading reading_of(const Explanation& one) const {
    return {.kind = one.kind, .joint = one.joint, .clause = one.clause, .row = [this, one](std::size_t i) {
              Trial trial{whole_.chain, whole_.tools_m, {whole_.rows[i]}, whole_.stations};
              one.apply(trial);
              return std::optional(trial.rows.front());
            }};
  }

  GroupReading shifted(int shift) const {
    return {.kind = FindingKind::rows_shifted,
            .clause = shift_clause(shift),
            .row = [this, shift](std::size_t i) -> std::optional<TrialRow> {
              const std::ptrdiff_t other = static_cast<std::ptrdiff_t>(i) + shift;
              if (other < 0 || other >= std::ssize(whole_.rows)) return std::nullopt;
              TrialRow row = whole_.rows[i];
              row.point_m = whole_.rows[static_cast<std::size_t>(other)].point_m;
              return row;
            }};
  }

  static std::vector<Explanation> axes_explanations() {
    std::vector<Explanation> all;
    for (int axis = 0; axis < 3; ++axis) {
      const char name = "xyz"[axis], next = "xyz"[(axis + 1) % 3];
      all.push_back(
          {FindingKind::mirrored, -1, fmt::format("{} of the measured point is negated", name), [axis](Trial& trial) {
             for (TrialRow& row : trial.rows) row.point_m[axis] *= -1.0;
           }});
      all.push_back({FindingKind::axes_exchanged, -1,
                     fmt::format("{} and {} of the measured point are exchanged", name, next), [axis](Trial& trial) {
                       for (TrialRow& row : trial.rows) std::swap(row.point_m[axis], row.point_m[(axis + 1) % 3]);
                     }});
    }
    return all;
  }

  /// Each pair of targets exchanged.
  std::vector<Explanation> target_explanations() const {
    std::vector<Explanation> all;
    const int targets = static_cast<int>(whole_.tools_m.size());
    for (int one = 0; one < targets; ++one) {
      for (int other = one + 1; other < targets; ++other) {
        all.push_back({FindingKind::targets_exchanged, -1,
                       fmt::format("targets {} and {} are exchanged", target_name(one), target_name(other)),
                       [one, other](Trial& trial) {
                         for (TrialRow& row : trial.rows)
                           row.target = row.target == one ? other : row.target == other ? one : row.target;
                       }});
      }
    }
    return all;
  }

  std::string target_name(int target) const {
    const auto row = std::ranges::find(whole_.rows, target, &TrialRow::target);
    return row == whole_.rows.end() ? "" : data_.poses[row->pose].target;
  }

  /// One number added to a joint of all rows that are off: that which leaves them least, large errors counting less.
  GroupReading offset_of(int joint) const {
    double by_rad = 0.0;
    for (int step = 0; step < 12; ++step) {
      double information = 1e-12, gradient = 0.0;
      for (const std::size_t i : off_) {
        constexpr double kStep_rad = 1e-6;
        TrialRow row = whole_.rows[i];
        row.joints[joint] += by_rad;
        const Eigen::Vector3d there = predicted_point(fit_, row), error = row.point_m - there;
        row.joints[joint] += kStep_rad;
        const Eigen::Vector3d slope = (predicted_point(fit_, row) - there) / kStep_rad;
        const double weight = 1.0 / std::max(error.norm(), 1e-5);
        information += weight * slope.squaredNorm();
        gradient += weight * slope.dot(error);
      }
      by_rad += gradient / information;
    }
    return {.kind = FindingKind::joint_offset,
            .joint = joint,
            .clause = fmt::format("{:+.3f} deg are added to joint {}", degrees(by_rad), joint + 1),
            .row = [this, joint, by_rad](std::size_t i) {
              TrialRow row = whole_.rows[i];
              row.joints[joint] += by_rad;
              return std::optional(row);
            }};
  }

  /// Places of rows, ascending, with few others between them.
  static bool stand_together(const std::vector<std::size_t>& off) {
    return static_cast<double>(off.size()) >= kShareExplained * static_cast<double>(off.back() - off.front() + 1);
  }

  /// "lines 72 to 101, P71 to P100", where they stand together.
  std::string where(const std::vector<std::size_t>& off) const {
    const MeasuredPose &first = pose_of(off.front()), &last = pose_of(off.back());
    if (!stand_together(off)) return fmt::format("here and there from line {} to line {}", first.line, last.line);
    if (static_cast<std::ptrdiff_t>(off.back()) + kNearEnd >= std::ssize(whole_.rows))
      return fmt::format("line {} on", first.line);
    return fmt::format("lines {} to {}", first.line, last.line);
  }

  Finding started(FindingKind kind) const {
    Finding finding{.kind = kind, .as_given_mm = millimetres(median(errors_m_))};
    std::vector<std::size_t> off;
    std::vector<double> fitting, wrong;
    std::size_t rows = 0;
    for (std::size_t i = 0; i < whole_.rows.size(); ++i) {
      const double error_m = error(whole_.rows[i]);
      const bool is_off = error_m > limit_m_, counts = set_ == PoseSet::calibration || pose_of(i).set == set_;
      if (!is_off) fitting.push_back(error_m);
      rows += counts ? 1 : 0;
      if (!is_off || !counts) continue;
      wrong.push_back(error_m);
      off.push_back(i);
      finding.poses.push_back(pose_of(i).pose_id);
    }
    finding.sentence =
        fmt::format("{} of {} {}rows ({}) are {} to {} off, while the others fit to {} at the median", off.size(), rows,
                    set_ == PoseSet::calibration ? "" : fmt::format("{} ", to_string(set_)), where(off),
                    distance_text(std::ranges::min(wrong)), distance_text(std::ranges::max(wrong)),
                    distance_text(median(std::move(fitting))));
    return finding;
  }

  const DataSet& data_;
  const Trial& whole_;
  const TrialFit& fit_;
  PoseSet set_;
  double limit_m_ = 0.0;
  std::size_t fitted_ = 0;             ///< rows of the set
  std::vector<std::size_t> off_{};     ///< those of them that do not fit
  std::vector<double> errors_m_{};     ///< of each that is off
  std::vector<std::size_t> places_{};  ///< of each among the rows of the set
};

}  // namespace

std::optional<Finding> explain_wrong_rows(const DataSet& data, const Trial& whole, const TrialFit& fit, PoseSet set) {
  const WrongRows wrong(data, whole, fit, set);
  return wrong.are_many() || wrong.are_a_block() ? wrong.explained() : std::nullopt;
}

std::optional<Finding> name_wrong_rows(const DataSet& data, const Trial& whole, const TrialFit& fit, PoseSet set) {
  const WrongRows wrong(data, whole, fit, set);
  if (!wrong.are_many_beyond(kImplausibleShare * whole.reach_m())) return std::nullopt;
  const auto offset = set != PoseSet::calibration && wrong.are_most() ? wrong.explained_by_offset() : std::nullopt;
  return offset ? offset : wrong.unexplained();
}

}  // namespace demecal::inline data_check
