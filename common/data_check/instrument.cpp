#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "data_check/explanations.hpp"
#include "data_check/trial_fit.hpp"
#include "kinematics/forward.hpp"
#include "random/distributions.hpp"

namespace demecal::inline data_check {
namespace {

constexpr std::size_t kFewestBehind = 5;  ///< rows on either side of a move: fewer could be outliers
constexpr std::size_t kPlaces = 80;       ///< places that a move is first looked for at
constexpr int kMostMoves = 3;
constexpr double kCap = 6.0;               ///< deviations beyond which an error says no more
constexpr double kLeastGain = 50.0;        ///< log likelihood that another place of the instrument must gain
constexpr double kLeastShift = 5.0;        ///< deviations that points must jump by: drift within a run is smaller
constexpr double kLeastFall = 0.4;         ///< ratio of median errors that is far better
constexpr double kFarDeviationsOff = 6.0;  ///< deviations at a set's median that ask for a reason; 1.5 are expected
constexpr double kOtherFrameFall = 0.25;   ///< the same where a fitted model must hold in another frame
constexpr double kSmallestShift_m = 1e-4;

/// Points of the arm in its base, and as they were measured.
struct PointPairs {
  std::vector<Eigen::Vector3d> arm, measured;
};

/// The motion that brings the arm's points [begin, end) to the measured ones, large errors counting less (L1).
Eigen::Isometry3d registration(const PointPairs& pairs, std::size_t begin, std::size_t end) {
  const auto n = static_cast<Eigen::Index>(end - begin);
  Eigen::Matrix3Xd from(3, n), to(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    from.col(i) = pairs.arm[begin + static_cast<std::size_t>(i)];
    to.col(i) = pairs.measured[begin + static_cast<std::size_t>(i)];
  }
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
  for (int repetition = 0; repetition < 6; ++repetition) {
    base = weighted_registration(from, to, weights);
    weights =
        ((base.linear() * from).colwise() + base.translation() - to).colwise().norm().cwiseMax(1e-5).cwiseInverse();
  }
  return base;
}

double capped_cost(const PointPairs& pairs, std::size_t begin, std::size_t end, const Eigen::Isometry3d& base,
                   double cap_m) {
  double cost = 0.0;
  for (std::size_t i = begin; i < end; ++i)
    cost += std::min((pairs.measured[i] - base * pairs.arm[i]).squaredNorm(), cap_m * cap_m);
  return cost;
}

PointPairs pairs_of(const Trial& trial, const TrialFit& fit) {
  PointPairs pairs;
  for (const TrialRow& row : trial.rows) {
    pairs.arm.push_back(forward(fit.chain, row.joints) * fit.tools_m[static_cast<std::size_t>(row.target)]);
    pairs.measured.push_back(row.point_m);
  }
  return pairs;
}

/// Rows [begin, end) of one station.
struct Segment {
  std::size_t begin = 0, end = 0;
};

std::vector<Segment> segments_of(const Trial& trial) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < trial.rows.size(); ++i) {
    if (i == 0 || trial.rows[i].station != trial.rows[i - 1].station) segments.push_back({i, i});
    segments.back().end = i + 1;
  }
  return segments;
}

struct StationSplit {
  std::size_t row = 0;
  double cost = std::numeric_limits<double>::infinity();
};

/// The best of the rows first, first + step ... at which a segment may be split.
StationSplit best_split(const PointPairs& pairs, const Segment& segment, std::size_t first, std::size_t last,
                        std::size_t step, double cap_m) {
  StationSplit best;
  for (std::size_t row = std::max(first, segment.begin + kFewestBehind);
       row <= last && row + kFewestBehind <= segment.end; row += step) {
    const double cost = capped_cost(pairs, segment.begin, row, registration(pairs, segment.begin, row), cap_m) +
                        capped_cost(pairs, row, segment.end, registration(pairs, row, segment.end), cap_m);
    if (cost < best.cost) best = {row, cost};
  }
  return best;
}

StationSplit best_split(const PointPairs& pairs, const Segment& segment, double cap_m) {
  const std::size_t step = std::max<std::size_t>(1, (segment.end - segment.begin) / kPlaces);
  const StationSplit rough = best_split(pairs, segment, segment.begin, segment.end, step, cap_m);
  if (step == 1 || !std::isfinite(rough.cost)) return rough;
  const std::size_t first = rough.row > step ? rough.row - step : 0;
  return best_split(pairs, segment, first, rough.row + step, 1, cap_m);
}

/// The split of any segment that lowers the cost most.
StationSplit best_split(const Trial& trial, const TrialFit& fit) {
  const PointPairs pairs = pairs_of(trial, fit);
  const double cap_m = kCap * fit.deviation_m;
  StationSplit best;
  double most = 0.0;
  for (const Segment& segment : segments_of(trial)) {
    const StationSplit split = best_split(pairs, segment, cap_m);
    const double one =
        capped_cost(pairs, segment.begin, segment.end, registration(pairs, segment.begin, segment.end), cap_m);
    if (one - split.cost <= most) continue;
    most = one - split.cost;
    best = split;
  }
  return best;
}

Trial split_at(const Trial& trial, std::size_t row) {
  Trial split = trial;
  for (std::size_t i = 0; i < split.rows.size(); ++i) split.rows[i].station += i >= row ? 1 : 0;
  ++split.stations;
  return split;
}

double median_of(const std::vector<double>& errors, const Segment& segment) {
  return median({errors.begin() + static_cast<std::ptrdiff_t>(segment.begin),
                 errors.begin() + static_cast<std::ptrdiff_t>(segment.end)});
}

/// Log likelihood that errors `after` gain over `before`, in deviations of the better fit and up to a cap each.
double gain(const std::vector<double>& before, const std::vector<double>& after, double deviation_m) {
  double sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double one = std::min(before[i] / deviation_m, kCap), other = std::min(after[i] / deviation_m, kCap);
    sum += 0.5 * (one * one - other * other);
  }
  return sum;
}

double root_mean_square_shift(const TrialFit& fit, std::span<const TrialRow> rows) {
  double squares = 0.0;
  for (TrialRow row : rows) {
    const Eigen::Vector3d predicted = predicted_point(fit, row);
    --row.station;
    squares += (predicted - predicted_point(fit, row)).squaredNorm();
  }
  return std::sqrt(squares / static_cast<double>(rows.size()));
}

bool is_earlier(const InstrumentMove& one, const InstrumentMove& other) {
  return one.first_row < other.first_row;
}

/// The tool points that bring the rows' predictions nearest to what was measured, large errors counting less.
std::vector<Eigen::Vector3d> own_tools(const TrialFit& fit, std::span<const TrialRow> rows) {
  std::vector<Eigen::Vector3d> tools = fit.tools_m;
  for (std::size_t target = 0; target < tools.size(); ++target) {
    for (int repetition = 0; repetition < 8; ++repetition) {
      Eigen::Matrix3d information = 1e-9 * Eigen::Matrix3d::Identity();
      Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
      for (const TrialRow& row : rows) {
        if (static_cast<std::size_t>(row.target) != target) continue;
        const Eigen::Isometry3d flange =
            fit.sensor_from_base[static_cast<std::size_t>(row.station)] * forward(fit.chain, row.joints);
        const Eigen::Vector3d error = row.point_m - flange * tools[target];
        const double weight = 1.0 / std::max(error.norm(), 1e-5);
        information += weight * Eigen::Matrix3d::Identity();
        gradient += weight * flange.linear().transpose() * error;
      }
      tools[target] += information.llt().solve(gradient);
    }
  }
  return tools;
}

std::vector<Eigen::Vector3d> predictions(const TrialFit& fit, std::span<const TrialRow> rows) {
  std::vector<Eigen::Vector3d> points;
  for (const TrialRow& row : rows) points.push_back(predicted_point(fit, row));
  return points;
}

double median_error(const std::vector<Eigen::Vector3d>& predicted, std::span<const TrialRow> rows) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < rows.size(); ++i) errors.push_back((rows[i].point_m - predicted[i]).norm());
  return median(std::move(errors));
}

double root_mean_square(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to) {
  double squares = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) squares += (from[i] - to[i]).squaredNorm();
  return std::sqrt(squares / static_cast<double>(from.size()));
}

}  // namespace

std::vector<InstrumentMove> find_moves(Trial& trial, TrialFit& fit) {
  std::vector<InstrumentMove> moves;
  while (std::ssize(moves) < kMostMoves && trial.rows.size() > 2 * kFewestBehind) {
    const StationSplit split = best_split(trial, fit);
    if (!std::isfinite(split.cost)) break;
    Trial moved = split_at(trial, split.row);
    TrialFit both = fit_arm(moved, fit_base_and_tools(moved));
    // Where the arm was fitted to a mixture of two places the split is found better with the arm of two.
    if (const StationSplit again = best_split(trial, both); std::isfinite(again.cost) && again.row != split.row) {
      moved = split_at(trial, again.row);
      both = fit_arm(moved, both);
    }
    const auto at = std::ranges::find_if(moved.rows, [&](const TrialRow& row) {
      return row.station != trial.rows[static_cast<std::size_t>(&row - moved.rows.data())].station;
    });
    const auto row = static_cast<std::size_t>(at - moved.rows.begin());
    const int station = moved.rows[row].station;
    Segment before{row, row}, behind{row, row};
    while (before.begin > 0 && moved.rows[before.begin - 1].station == station - 1) --before.begin;
    while (behind.end < moved.rows.size() && moved.rows[behind.end].station == station) ++behind.end;
    const Segment& shorter = before.end - before.begin < behind.end - behind.begin ? before : behind;
    const InstrumentMove move{row, root_mean_square_shift(both, std::span(moved.rows).subspan(row, behind.end - row)),
                              std::max(median_of(fit.error_m, before), median_of(fit.error_m, behind)),
                              median_of(both.error_m, shorter)};
    const double deviation_m = both.deviation_m;
    // A robust fit may leave out all rows of a region where the arm errs otherwise: one that leaves out none must fail
    // too.
    const double gained = std::min(gain(fit.error_m, both.error_m, deviation_m),
                                   gain(fit_arm_to_all(trial, fit).error_m, both.error_m, deviation_m));
    const bool found = gained > kLeastGain * both.rows_per_pose &&
                       move.shift_m > std::max(kLeastShift * deviation_m, kSmallestShift_m) &&
                       move.if_changed_m < kLeastFall * move.as_given_m;
    if (!found) break;
    moves.push_back(move);
    trial = std::move(moved);
    fit = std::move(both);
  }
  std::ranges::sort(moves, is_earlier);
  return moves;
}

std::optional<OtherSet> find_other_set(const TrialFit& fit, std::vector<TrialRow>& rows) {
  constexpr std::size_t kFewest = 4;
  if (rows.size() < kFewest) return std::nullopt;
  const std::vector<Eigen::Vector3d> given = predictions(fit, rows);
  const double as_given_m = median_error(given, rows);
  std::vector<double> off;
  for (const TrialRow& row : rows) off.push_back(fit.deviations_off(row));
  if (median(off) < kFarDeviationsOff || as_given_m < kSmallestShift_m) return std::nullopt;

  TrialFit with_tools = fit;
  with_tools.tools_m = own_tools(fit, rows);
  const std::vector<Eigen::Vector3d> by_tool = predictions(with_tools, rows);

  PointPairs pairs;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    pairs.arm.push_back(given[i]);
    pairs.measured.push_back(rows[i].point_m);
  }
  const Eigen::Isometry3d motion = registration(pairs, 0, rows.size());
  std::vector<Eigen::Vector3d> by_frame;
  for (const Eigen::Vector3d& point : given) by_frame.push_back(motion * point);

  const double tool_m = median_error(by_tool, rows), frame_m = median_error(by_frame, rows);
  // Three numbers that do as well as six are the likelier reason.
  const bool is_tool = tool_m < 1.15 * frame_m;
  const std::vector<Eigen::Vector3d>& better = is_tool ? by_tool : by_frame;
  const OtherSet other{is_tool, root_mean_square(given, better), as_given_m, is_tool ? tool_m : frame_m};
  if (other.if_changed_m > kLeastFall * as_given_m) return std::nullopt;
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].point_m += given[i] - better[i];
  return other;
}

std::optional<OtherSet> find_other_frame(const std::vector<Eigen::Vector3d>& predicted,
                                         const std::vector<Eigen::Vector3d>& measured) {
  constexpr std::size_t kFewest = 6;
  if (predicted.size() < kFewest) return std::nullopt;
  const PointPairs pairs{predicted, measured};
  const Eigen::Isometry3d motion = registration(pairs, 0, predicted.size());
  std::vector<double> given, moved, shift;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    given.push_back((measured[i] - predicted[i]).norm());
    moved.push_back((measured[i] - motion * predicted[i]).norm());
    shift.push_back((motion * predicted[i] - predicted[i]).norm());
  }
  const OtherSet other{false, median(shift), median(given), median(moved)};
  if (other.as_given_m < kSmallestShift_m || other.if_changed_m > kOtherFrameFall * other.as_given_m)
    return std::nullopt;
  return other;
}

}  // namespace demecal::inline data_check
