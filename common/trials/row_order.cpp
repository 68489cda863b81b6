#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/spread_poses.hpp"
#include "decompositions/decompositions.hpp"
#include "fitting/base_search.hpp"
#include "kinematics/forward.hpp"
#include "random/distributions.hpp"
#include "trials/explanations.hpp"
#include "trials/point_pairs.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline trials {
namespace {

constexpr int kMostShift = 30;
constexpr std::size_t kFewestShifted = 8;
constexpr std::size_t kShiftRows = 200;  ///< rows that a shift is tried on
constexpr std::size_t kCloudRows = 250;  ///< points of the clouds that are brought together
constexpr double kShareOfRows = 0.35;    ///< at either end, by which a shift of the rest is looked for
constexpr int kClosestPointSteps = 40, kTurns = 60;

/// Row `i` with the measured point, and where there are several the target, of row `i + shift`.
TrialRow shifted_row(const Trial& whole, std::size_t i, int shift, bool with_target) {
  const TrialRow& other = whole.rows[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + shift)];
  TrialRow row = whole.rows[i];
  row.point_m = other.point_m;
  if (with_target) row.target = other.target;
  return row;
}

bool has_row(const Trial& whole, std::size_t i, int shift) {
  const auto at = static_cast<std::ptrdiff_t>(i) + shift;
  return at >= 0 && at < std::ssize(whole.rows);
}

Trial shifted(const Trial& whole, int shift, bool with_target) {
  Trial trial{whole.chain, whole.tools_m, {}, whole.stations};
  for (const std::size_t i : spread_indices(whole.rows.size(), kShiftRows))
    if (has_row(whole, i, shift)) trial.rows.push_back(shifted_row(whole, i, shift, with_target));
  return trial;
}

std::optional<RowReordering> shift_of_all(const Trial& whole) {
  const int most = std::min<int>(kMostShift, static_cast<int>(whole.rows.size() / 2));
  int best = 0;
  bool target = false;
  double least = std::numeric_limits<double>::infinity();
  for (const bool with_target : {false, true}) {
    if (with_target && whole.tools_m.size() < 2) continue;
    for (int shift = -most; shift <= most; ++shift) {
      if (shift == 0) continue;
      const double median_m = fit_base_and_tools(shifted(whole, shift, with_target)).median_m;
      if (median_m >= least) continue;
      least = median_m;
      best = shift;
      target = with_target;
    }
  }
  if (best == 0) return std::nullopt;
  const Trial trial = shifted(whole, best, target);
  return RowReordering{shift_clause(best), fit_arm(trial, fit_base_and_tools(trial)).median_m};
}

/// Whether rows [begin, end) fit far better shifted than as given by an arm that is fitted to all others: one that was
/// fitted to fewer may err there.
bool fit_shifted(const Trial& whole, std::size_t begin, std::size_t end, int shift) {
  Trial others{whole.chain, whole.tools_m, {}, whole.stations};
  for (const std::size_t i : spread_indices(whole.rows.size() - (end - begin), kShiftRows))
    others.rows.push_back(whole.rows[i < begin ? i : i + (end - begin)]);
  const TrialFit fit = fit_arm(others, fit_base_and_tools(others));
  std::vector<double> given, moved;
  for (std::size_t i = begin; i < end; ++i) {
    if (!has_row(whole, i, shift)) continue;
    given.push_back((whole.rows[i].point_m - predicted_point(fit, whole.rows[i])).norm());
    const TrialRow row = shifted_row(whole, i, shift, false);
    moved.push_back((row.point_m - predicted_point(fit, row)).norm());
  }
  return !given.empty() && median(std::move(moved)) < kLeastFall * median(std::move(given));
}

/// A fit to one end of the rows, and the shift of all behind (or before) a row that it then shows.
std::optional<RowReordering> shift_of_one_end(const Trial& whole, bool from_begin) {
  const std::size_t n = whole.rows.size(), kept = static_cast<std::size_t>(kShareOfRows * static_cast<double>(n));
  Trial end{whole.chain, whole.tools_m, {}, whole.stations};
  for (const std::size_t i : spread_indices(kept, kShiftRows))
    end.rows.push_back(whole.rows[from_begin ? i : n - 1 - i]);
  const TrialFit fit = fit_arm(end, fit_base_and_tools(end));
  const auto error = [&](std::size_t i, int shift) {
    return has_row(whole, i, shift)
               ? (whole.rows[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + shift)].point_m -
                  predicted_point(fit, whole.rows[i]))
                     .norm()
               : 0.0;
  };
  const double enough_m = 10.0 * fit.median_m + 1e-3;
  for (const int shift : {1, -1, 2, -2, 3, -3}) {
    // The fewest rows that do not fit, over all places where the shift may begin.
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < n; ++i) wrong += error(i, from_begin ? shift : 0) > enough_m ? 1 : 0;
    std::size_t least = wrong, begin = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const bool wrong_before = error(i, from_begin ? 0 : shift) > enough_m;
      const bool wrong_after = error(i, from_begin ? shift : 0) > enough_m;
      wrong += (wrong_before ? 1 : 0);
      wrong -= (wrong_after ? 1 : 0);
      if (wrong < least) {
        least = wrong;
        begin = i + 1;
      }
    }
    if (begin < 3 || begin + 3 > n || static_cast<double>(least) > 0.1 * static_cast<double>(n)) continue;
    if (!fit_shifted(whole, from_begin ? begin : 0, from_begin ? n : begin, shift)) continue;
    RowReordering found{shift_clause(shift) + (from_begin ? ", from this row on" : ", up to this row"), fit.median_m};
    for (std::size_t i = from_begin ? begin : 0; i < (from_begin ? n : begin); ++i)
      found.poses.push_back(whole.rows[i].pose);
    return found;
  }
  return std::nullopt;
}

struct Clouds {
  Eigen::Matrix3Xd arm, measured;
};

Clouds clouds_of(const Trial& whole) {
  const std::vector<std::size_t> chosen = spread_indices(whole.rows.size(), kCloudRows);
  // Of a shuffled file no subset of rows has the points of the same rows: the measured ones are taken whole.
  Clouds clouds{Eigen::Matrix3Xd(3, chosen.size()), Eigen::Matrix3Xd(3, whole.rows.size())};
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const TrialRow& row = whole.rows[chosen[i]];
    clouds.arm.col(static_cast<Eigen::Index>(i)) =
        forward(whole.chain, row.joints) * whole.tools_m[static_cast<std::size_t>(row.target)];
  }
  for (std::size_t i = 0; i < whole.rows.size(); ++i)
    clouds.measured.col(static_cast<Eigen::Index>(i)) = whole.rows[i].point_m;
  return clouds;
}

Eigen::Index nearest(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& to) {
  Eigen::Index index = 0;
  (points.colwise() - to).colwise().squaredNorm().minCoeff(&index);
  return index;
}

/// How near the nearest points of the other cloud are after both were brought together, at the median.
double brought_together(const Clouds& clouds, Eigen::Isometry3d& base) {
  Eigen::Matrix3Xd matched(3, clouds.arm.cols());
  std::vector<double> distances(static_cast<std::size_t>(clouds.arm.cols()));
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kClosestPointSteps; ++step) {
    for (Eigen::Index i = 0; i < clouds.arm.cols(); ++i) {
      const Eigen::Vector3d point = base * clouds.arm.col(i);
      matched.col(i) = clouds.measured.col(nearest(clouds.measured, point));
      distances[static_cast<std::size_t>(i)] = (matched.col(i) - point).norm();
    }
    const double now = median(distances);
    if (now > 0.999 * before) return now;
    before = now;
    base = rigid_motion(clouds.arm, matched);
  }
  return before;
}

/// The distance from a point of the cloud to the next, at the median.
double spacing(const Eigen::Matrix3Xd& points) {
  std::vector<double> distances;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::RowVectorXd squares = (points.colwise() - points.col(i)).colwise().squaredNorm();
    squares[i] = std::numeric_limits<double>::infinity();
    distances.push_back(std::sqrt(squares.minCoeff()));
  }
  return median(distances);
}

}  // namespace

std::string shift_clause(int shift) {
  const int by = std::abs(shift);
  return fmt::format("each measured point is taken from {} row{} {}", by, by == 1 ? "" : "s",
                     shift > 0 ? "further down" : "further up");
}

std::optional<RowReordering> shift_of_rest(const Trial& whole) {
  if (whole.rows.size() < kFewestShifted) return std::nullopt;
  std::optional<RowReordering> behind = shift_of_one_end(whole, true), before = shift_of_one_end(whole, false);
  return behind && (!before || behind->median_m <= before->median_m) ? behind : before;
}

std::optional<RowReordering> best_shift(const Trial& whole) {
  if (whole.rows.size() < kFewestShifted) return std::nullopt;
  std::optional<RowReordering> best = shift_of_all(whole), rest = shift_of_rest(whole);
  return rest && (!best || rest->median_m < 0.5 * best->median_m) ? rest : best;
}

std::optional<RowReordering> find_shuffled_rows(const Trial& whole, double near_m) {
  constexpr std::size_t kFewest = 12, kMost = 3000;
  if (whole.rows.size() < kFewest || whole.rows.size() > kMost) return std::nullopt;
  const Clouds clouds = clouds_of(whole);
  const Eigen::Vector3d arm_mean = clouds.arm.rowwise().mean(), measured_mean = clouds.measured.rowwise().mean();
  const double apart_m = spacing(clouds.measured);
  const double enough_m = std::min(near_m, 0.25 * apart_m);
  double least = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < kTurns && least > enough_m; ++turn) {
    Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
    base.linear() = spread_rotation(turn, kTurns);
    base.translation() = measured_mean - base.linear() * arm_mean;
    least = std::min(least, brought_together(clouds, base));
  }
  if (least > enough_m) return std::nullopt;
  return RowReordering{"the measured points are this arm's, but in another order: no shift of the rows fits", least};
}

}  // namespace demecal::inline trials
