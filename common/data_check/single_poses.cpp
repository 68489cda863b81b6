#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "pieces/pieces.hpp"
#include "random/distributions.hpp"
#include "trials/finding.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kFarDeviations = 8.0;  ///< beyond which no noise goes
constexpr double kFarOverMost = 3.5;    ///< over the deviations that four in five poses keep: 7.5 deviations if normal
constexpr double kWithinNoise = 3.2;    ///< deviations within which a changed pose fits (95 % of poses do)
constexpr double kMuchBetter = 0.1;     ///< ratio of errors that chance gives a wrong joint in few of 100 outliers
constexpr double kFarBetter = 0.02;     ///< the same where it is not asked for to be within noise
constexpr std::size_t kMostSearched = 60;  ///< poses whose joints are searched for typing errors
constexpr std::size_t kLongestCycle = 4;
constexpr int kSamplesPerTurn = 360;

struct FarPose {
  std::size_t row;
  double error_m;
};

double quantile_of(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

std::string amount_at(const Joint& joint, double value) {
  return is_revolute(joint) ? fmt::format("{:.3f} deg", degrees(value)) : fmt::format("{:.3f} mm", millimetres(value));
}

/// A value that fits, without the whole turns by which the given one lies beyond the joint's limits.
std::string in_place_of(const Joint& joint, double given, double value) {
  const double middle = 0.5 * (joint.lower + joint.upper);
  const bool turned = is_revolute(joint) && std::abs(given - middle) > 0.5 * (joint.upper - joint.lower) + kTurn_rad;
  const double turns = turned ? std::round((value - middle) / kTurn_rad) : 0.0;
  return fmt::format("{} in place of {}{}", amount_at(joint, value - turns * kTurn_rad), amount_at(joint, given),
                     turned ? fmt::format(", which is {:.0f} whole turns and more away", std::abs(turns)) : "");
}

class OutlierSearch {
 public:
  OutlierSearch(const DataSet& data, const std::vector<TrialRow>& rows, const PointPrediction& predict, double least_m)
      : data_(data), rows_(rows), predict_(predict) {
    std::vector<double> errors(rows.size()), off(rows.size());
    in_batches(rows.size(), [&](std::size_t i) {
      errors[i] = error(rows[i]);
      off[i] = predict.deviations_off(rows[i]);
    });
    median_m_ = median(errors);
    far_deviations_ = std::max(kFarDeviations, kFarOverMost * quantile_of(off, 0.8));
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!(off[i] <= far_deviations_ || errors[i] <= least_m)) far_.push_back({i, errors[i]});
  }

  std::vector<Finding> findings() {
    std::vector<Finding> found;
    std::vector<bool> explained(far_.size(), false);
    for (std::size_t i = 0; i < far_.size(); ++i)
      if (!explained[i]) add_cycle(i, explained, found);
    for (std::size_t i = 0; i < far_.size(); ++i)
      if (!explained[i]) found.push_back(single_pose_finding(far_[i], i < kMostSearched));
    return found;
  }

 private:
  const std::string& id(std::size_t row) const { return data_.poses[rows_[row].pose].pose_id; }
  /// By its name; with its line where another of `rows` has that name too.
  std::string name_among(const std::vector<std::size_t>& rows, std::size_t row) const {
    const auto same = [&](std::size_t other) { return id(other) == id(row); };
    if (std::ranges::count_if(rows, same) < 2) return id(row);
    const MeasuredPose& pose = data_.poses[rows_[row].pose];
    return fmt::format("line {}{}", pose.line, name_beside_line(pose));
  }
  double error(const TrialRow& row) const { return (row.point_m - predict_.point(row)).norm(); }
  /// Whether a row that was changed by a number found for it fits.
  bool fits(const TrialRow& row, double before_m) const {
    const double error_m = error(row), off = predict_.deviations_off(row);
    return (error_m < kMuchBetter * before_m && off < kWithinNoise) ||
           (error_m < kFarBetter * before_m && off <= far_deviations_);
  }
  /// The same of a change without such a number, which chance makes fit so well by far more seldom: poses of real arms
  /// err by more than noise.
  bool fits_unsearched(const TrialRow& row, double before_m) const {
    const double error_m = error(row);
    return error_m < kFarBetter * before_m ||
           (error_m < kMuchBetter * before_m && predict_.deviations_off(row) <= far_deviations_);
  }

  /// The far row at whose joints this row's point fits best, if one does.
  std::optional<std::size_t> place_of(std::size_t i) const {
    std::optional<std::size_t> place;
    double least = 0.0;
    for (std::size_t j = 0; j < far_.size(); ++j) {
      if (j == i) continue;
      TrialRow moved = rows_[far_[j].row];
      moved.point_m = rows_[far_[i].row].point_m;
      const double error_m = error(moved);
      if ((place && error_m >= least) || !fits_unsearched(moved, far_[i].error_m)) continue;
      place = j;
      least = error_m;
    }
    return place;
  }

  /// Follows the rows' points to where they fit; a cycle is one finding.
  void add_cycle(std::size_t first, std::vector<bool>& explained, std::vector<Finding>& found) const {
    std::vector<std::size_t> cycle{first};
    while (cycle.size() <= kLongestCycle) {
      const auto next = place_of(cycle.back());
      if (!next || explained[*next]) return;
      if (*next == first) break;
      cycle.push_back(*next);
    }
    if (cycle.size() < 2 || cycle.size() > kLongestCycle) return;
    Finding finding{.kind = FindingKind::rows_exchanged, .as_given_mm = 0.0, .if_changed_mm = 0.0};
    std::vector<std::size_t> rows;
    for (const std::size_t i : cycle) rows.push_back(far_[i].row);
    std::string names;
    for (std::size_t k = 0; k < cycle.size(); ++k) {
      const std::size_t i = cycle[k];
      explained[i] = true;
      finding.poses.push_back(id(far_[i].row));
      finding.as_given_mm = std::max(finding.as_given_mm, millimetres(far_[i].error_m));
      TrialRow moved = rows_[far_[cycle[(k + 1) % cycle.size()]].row];
      moved.point_m = rows_[far_[i].row].point_m;
      finding.if_changed_mm = std::max(finding.if_changed_mm, millimetres(error(moved)));
      names += (k == 0 ? "" : k + 1 == cycle.size() ? " and " : ", ") + name_among(rows, far_[i].row);
    }
    finding.sentence =
        fmt::format("{} fit if their measured points are exchanged: {:.2f} mm off as given, {:.2f} mm if exchanged.",
                    names, finding.as_given_mm, finding.if_changed_mm);
    found.push_back(std::move(finding));
  }

  /// A row whose measured point another row has too.
  std::optional<std::size_t> same_point_as(std::size_t row) const {
    for (std::size_t other = 0; other < rows_.size(); ++other)
      if (other != row && rows_[other].point_m == rows_[row].point_m) return other;
    return std::nullopt;
  }

  struct OtherJoints {
    int joint = -1, exchanged_with = -1;
    double value = 0.0, error_m = 0.0;
  };

  double error_at(const TrialRow& row, int joint, double value) const {
    TrialRow moved = row;
    moved.joints[joint] = value;
    return error(moved);
  }

  /// The value of one joint at which the row fits best: samples of its whole range, the best one refined.
  OtherJoints best_value(const TrialRow& row, int joint) const {
    const Joint& link = data_.robot.chain.joints[static_cast<std::size_t>(joint)];
    const bool revolute = is_revolute(link);
    const double lower = revolute ? row.joints[joint] - radians(180.0) : link.lower,
                 upper = revolute ? row.joints[joint] + radians(180.0) : link.upper;
    double step = (upper - lower) / kSamplesPerTurn;
    OtherJoints best{joint, -1, row.joints[joint], error(row)};
    for (int i = 0; i <= kSamplesPerTurn; ++i) {
      const double value = lower + i * step, error_m = error_at(row, joint, value);
      if (error_m < best.error_m) best = {joint, -1, value, error_m};
    }
    for (; step > 1e-9; step *= 0.5) {
      for (const double value : {best.value - step, best.value + step}) {
        const double error_m = error_at(row, joint, value);
        if (error_m < best.error_m) best = {joint, -1, value, error_m};
      }
    }
    return best;
  }

  std::optional<OtherJoints> typing_error(const TrialRow& row, double before_m) const {
    std::optional<OtherJoints> best;
    const auto take = [&](const OtherJoints& one, const JointVector& joints) {
      TrialRow moved = row;
      moved.joints = joints;
      if ((!best || one.error_m < best->error_m) && fits(moved, before_m)) best = one;
    };
    for (int joint = 0; joint < data_.robot.chain.size(); ++joint) {
      const OtherJoints one = best_value(row, joint);
      JointVector joints = row.joints;
      joints[joint] = one.value;
      take(one, joints);
    }
    if (best) return best;
    for (int one = 0; one < data_.robot.chain.size(); ++one) {
      for (int other = one + 1; other < data_.robot.chain.size(); ++other) {
        JointVector joints = row.joints;
        std::swap(joints[one], joints[other]);
        TrialRow moved = row;
        moved.joints = joints;
        take({one, other, joints[one], error(moved)}, joints);
      }
    }
    return best;
  }

  /// One coordinate with the other sign, or two exchanged, by which the row fits best, if it fits by one.
  std::optional<Finding> wrong_coordinates(const FarPose& misfit) const {
    constexpr std::string_view kAxes = "xyz";
    std::optional<Finding> best;
    double least_m = 0.0;
    const auto take = [&](const Eigen::Vector3d& point_m, const std::string& change) {
      TrialRow changed = rows_[misfit.row];
      changed.point_m = point_m;
      const double error_m = error(changed);
      if ((best && error_m >= least_m) || !fits_unsearched(changed, misfit.error_m)) return;
      least_m = error_m;
      best =
          Finding{.kind = FindingKind::typing_error,
                  .poses = {id(misfit.row)},
                  .as_given_mm = millimetres(misfit.error_m),
                  .if_changed_mm = millimetres(error_m),
                  .sentence = fmt::format("{} fits if {}: {:.2f} mm off as given, {:.2f} mm if changed.",
                                          id(misfit.row), change, millimetres(misfit.error_m), millimetres(error_m))};
    };
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      Eigen::Vector3d point_m = rows_[misfit.row].point_m;
      point_m[axis] = -point_m[axis];
      take(point_m, fmt::format("its measured {} is taken with the other sign", kAxes[static_cast<std::size_t>(axis)]));
      const Eigen::Index next = (axis + 1) % 3;
      point_m = rows_[misfit.row].point_m;
      std::swap(point_m[axis], point_m[next]);
      take(point_m,
           fmt::format("its measured {} and {} are exchanged", kAxes[static_cast<std::size_t>(std::min(axis, next))],
                       kAxes[static_cast<std::size_t>(std::max(axis, next))]));
    }
    return best;
  }

  Finding single_pose_finding(const FarPose& misfit, bool searched) const {
    const TrialRow& row = rows_[misfit.row];
    Finding finding{
        .kind = FindingKind::outlier, .poses = {id(misfit.row)}, .as_given_mm = millimetres(misfit.error_m)};
    if (const auto other = same_point_as(misfit.row)) {
      finding.kind = FindingKind::copied_rows;
      finding.poses.insert(finding.poses.begin(), id(*other));
      finding.sentence = fmt::format("{} has the measured point of {} to the last digit, and is {:.2f} mm off with it.",
                                     id(misfit.row), id(*other), finding.as_given_mm);
      return finding;
    }
    if (auto coordinates = wrong_coordinates(misfit)) return *std::move(coordinates);
    const auto typed = searched ? typing_error(row, misfit.error_m) : std::nullopt;
    if (!typed) {
      finding.sentence = fmt::format("{} is {:.2f} mm off, far more than the others ({:.2f} mm at the median).",
                                     id(misfit.row), finding.as_given_mm, millimetres(median_m_));
      return finding;
    }
    finding.kind = FindingKind::typing_error;
    finding.joint = typed->joint;
    finding.if_changed_mm = millimetres(typed->error_m);
    const Joint& joint = data_.robot.chain.joints[static_cast<std::size_t>(typed->joint)];
    const std::string change =
        typed->exchanged_with >= 0
            ? fmt::format("joints {} and {} are exchanged", typed->joint + 1, typed->exchanged_with + 1)
            : fmt::format("joint {} is {}", typed->joint + 1,
                          in_place_of(joint, row.joints[typed->joint], typed->value));
    finding.sentence = fmt::format("{} fits if {}: {:.2f} mm off as given, {:.2f} mm if changed.", id(misfit.row),
                                   change, finding.as_given_mm, finding.if_changed_mm);
    return finding;
  }

  const DataSet& data_;
  const std::vector<TrialRow>& rows_;
  const PointPrediction& predict_;
  double median_m_ = 0.0, far_deviations_ = 0.0;
  std::vector<FarPose> far_;
};

}  // namespace

std::vector<Finding> find_single_poses(const DataSet& data, const std::vector<TrialRow>& rows,
                                       const PointPrediction& predict, double least_m) {
  constexpr std::size_t kFewest = 6;
  if (rows.size() < kFewest) return {};
  return OutlierSearch(data, rows, predict, least_m).findings();
}

}  // namespace demecal::inline data_check
