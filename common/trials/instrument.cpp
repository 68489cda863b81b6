#include <Eigen/Core>
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

#include "kinematics/forward.hpp"
#include "random/distributions.hpp"
#include "trials/drift.hpp"
#include "trials/explanations.hpp"
#include "trials/point_pairs.hpp"
#include "trials/projected_columns.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline trials {
namespace {

constexpr std::size_t kFewestBehind = 5;  ///< rows on either side of a move: fewer could be outliers
constexpr std::size_t kPlaces = 80;       ///< places that a move is first looked for at
constexpr int kMostMoves = 3;
constexpr double kCap = 6.0;               ///< deviations beyond which an error says no more
constexpr double kLeastGain = 50.0;        ///< log likelihood that another place of the instrument must gain
constexpr double kLeastGainBeyond = 25.0;  ///< the same beside drift and the conditions that files state
constexpr double kLeastApart = 10.0;       ///< nats by which points tell two changes apart
constexpr double kLeastShift = 5.0;        ///< deviations that points must jump by: drift within a run is smaller

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

/// What the fit to a change leaves and the change's numbers cost, in nats (half a logarithm of the coordinates each).
double cost_nats(const Jump& jump, double deviation_m) {
  double sum = 0.5 * jump.move.numbers * std::log(3.0 * static_cast<double>(jump.fit.error_m.size()));
  for (const double error_m : jump.fit.error_m) {
    const double off = std::min(error_m / deviation_m, kCap);
    sum += 0.5 * off * off;
  }
  return sum;
}

/// The cheapest of several changes of which each explains the rows, with those that cost hardly more as its rivals.
Jump cheapest(std::vector<Jump> jumps) {
  const double deviation_m =
      std::ranges::min(jumps, {}, [](const Jump& jump) { return jump.fit.deviation_m; }).fit.deviation_m;
  const auto cost = [deviation_m](const Jump& jump) { return cost_nats(jump, deviation_m); };
  std::ranges::stable_sort(jumps, {}, cost);
  Jump best = std::move(jumps.front());
  for (std::size_t i = 1; i < jumps.size(); ++i)
    if (cost(jumps[i]) < cost(best) + kLeastApart * best.fit.rows_per_pose) best.move.rivals.push_back(jumps[i].move);
  return best;
}

/// How points move with an instrument that stands elsewhere at the rows of a segment: six columns.
Eigen::MatrixXd step_columns(const Trial& trial, const Segment& there) {
  Eigen::MatrixXd columns = drift_columns(trial, {{[](double) { return 1.0; }}});
  columns.topRows(3 * static_cast<Eigen::Index>(there.begin)).setZero();
  columns.bottomRows(columns.rows() - 3 * static_cast<Eigen::Index>(there.end)).setZero();
  return columns;
}

/// Log likelihood, in deviations of the better fit, that the step gains at the least beside what an instrument does
/// that drifts, and beside what joints do by sides, payload and temperature where it is no larger than that may be.
double gain_beyond_others(const Trial& trial, const TrialFit& fit, const Segment& there, double shift_m,
                          double deviation_m) {
  if (!fit.has_links()) return std::numeric_limits<double>::infinity();
  const ProjectedColumns projected(trial, fit);
  const Eigen::MatrixXd step = step_columns(trial, there);
  double least = std::numeric_limits<double>::infinity();
  for (const DriftShape& shape : drift_shapes())
    least = std::min(least, projected.gain_beyond(step, drift_columns(trial, shape)));
  if (shift_m < most_by_conditions(trial) * trial.reach_m())
    least = std::min(least, projected.gain_beyond(step, condition_columns(trial, fit)));
  const double sharper = fit.deviation_m / deviation_m;
  return sharper * sharper * least;
}

bool is_earlier(const InstrumentMove& one, const InstrumentMove& other) {
  return one.first_row < other.first_row;
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
    const bool found =
        gained > kLeastGain * both.rows_per_pose &&
        move.shift_m > std::max(kLeastShift * deviation_m, kSmallestShift_m) &&
        move.if_changed_m < std::min(kLeastFall * move.as_given_m, kMostOverUsual * both.usual_m) &&
        gain_beyond_others(trial, fit, behind, move.shift_m, deviation_m) > kLeastGainBeyond * both.rows_per_pose;
    std::vector<Jump> jumps;
    if (auto zero = find_zero_jump(trial, fit)) jumps.push_back(std::move(*zero));
    if (auto tool = find_tool_jump(trial, fit)) jumps.push_back(std::move(*tool));
    if (found) jumps.push_back({move, std::move(moved), std::move(both)});
    if (jumps.empty()) break;
    Jump best = cheapest(std::move(jumps));
    moves.push_back(std::move(best.move));
    trial = std::move(best.trial);
    fit = std::move(best.fit);
  }
  std::ranges::sort(moves, is_earlier);
  return moves;
}

}  // namespace demecal::inline trials
