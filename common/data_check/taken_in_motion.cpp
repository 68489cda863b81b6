#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "trials/finding.hpp"
#include "trials/projected_columns.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kMostShare = 0.3;  ///< of a way: what is farther off is another row's

/// Places of the poses in the order of measuring: of times where all have them, of the file otherwise.
std::vector<std::size_t> measured_order(const DataSet& data) {
  std::vector<std::size_t> order(data.poses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto time = [&](std::size_t pose) { return data.poses[pose].time_s.value_or(0.0); };
  if (std::ranges::all_of(data.poses, [](const MeasuredPose& pose) { return pose.time_s.has_value(); }))
    std::ranges::stable_sort(order, {}, time);
  return order;
}

/// What a share of the way from the stop before or to the one behind says.
struct WayMistake {
  int direction;  ///< -1: from the stop before; 1: to the one behind
  bool adds;      ///< joints of the row lack the share; otherwise they have it too much
  const char* what;
  const char* of_one_joint;
};
constexpr WayMistake kWayMistakes[] = {
    {-1, true,
     "Joints were read before the arm stood: {:.2g} % of every joint's way from the stop before was still to come {}. "
     "Read them once the arm rests, and measure again; ",
     "Joint {} was read before it stood: {:.2g} % of its way from the stop before was still to come {}. Read it once "
     "the arm rests, and measure again; "},
    {-1, false,
     "Points were measured before the arm stood: {:.2g} % of every joint's way from the stop before was still to come "
     "{}. Let it rest before the instrument reads, and measure again; ",
     "Points were measured before joint {} stood: {:.2g} % of its way from the stop before was still to come {}. Let "
     "it "
     "rest before the instrument reads, and measure again; "},
    {1, true,
     "Joints were read after the arm had left for the next stop, by {:.2g} % of every joint's way {}. Read them while "
     "it stands, and measure again; ",
     "Joint {} was read after it had left for the next stop, by {:.2g} % of its way {}. Read it while the arm stands, "
     "and measure again; "},
    {1, false,
     "Points were measured after the arm had left for the next stop, by {:.2g} % of every joint's way {}. Measure "
     "while it stands; ",
     "Points were measured after joint {} had left for the next stop, by {:.2g} % of its way {}. Measure while it "
     "stands; "},
};

constexpr int kAllJoints = -1;

/// Rows that are off by a share of their way from the stop before (`direction` -1) or to the one behind (1).
struct MotionStart {
  int direction = -1;
  double share = 0.0;
  int joint = kAllJoints;  ///< all alike, or that one alone
};

/// How points move by the way of a joint, or the sum over all of them.
Eigen::VectorXd way_column(const Trial& trial, const TrialFit& fit, const std::vector<std::optional<JointVector>>& ways,
                           int joint = kAllJoints) {
  const auto way = [&ways](std::size_t row, int of) { return ways[row] ? (*ways[row])[of] : 0.0; };
  const Eigen::MatrixXd columns = joint_columns(trial, fit, way);
  return joint == kAllJoints ? Eigen::VectorXd(columns.rowwise().sum()) : Eigen::VectorXd(columns.col(joint));
}

/// The rows with joints as the arm stood, where a share of their way was missing.
Trial stood(const DataSet& data, Trial trial, MotionStart off) {
  const auto ways = ways_of(data, trial, off.direction, off.share);
  for (std::size_t i = 0; i < trial.rows.size(); ++i) {
    if (!ways[i]) continue;
    if (off.joint == kAllJoints)
      trial.rows[i].joints += off.share * *ways[i];
    else
      trial.rows[i].joints[off.joint] += off.share * (*ways[i])[off.joint];
  }
  return trial;
}

std::string sentence_of(MotionStart off, double as_given_m, double if_changed_m) {
  const auto is_it = [&](const WayMistake& one) {
    return one.direction == off.direction && one.adds == (off.share > 0.0);
  };
  const WayMistake& mistake = *std::ranges::find_if(kWayMistakes, is_it);
  // Joints that were read on the way lack a share of the whole way, of which what was read shows less.
  const double of_way_percent = 100.0 * (off.share > 0.0 ? off.share / (1.0 + off.share) : -off.share);
  const std::string errors = before_and_after(as_given_m, if_changed_m);
  if (off.joint == kAllJoints)
    return fmt::format(fmt::runtime(mistake.what), of_way_percent, errors) +
           "lost motion would be found that the arm does not have.";
  return fmt::format(fmt::runtime(mistake.of_one_joint), off.joint + 1, of_way_percent, errors) +
         "a gear ratio or a tilting base would be found that the arm does not have.";
}

struct MotionFit {
  MotionStart off;
  Trial trial;  ///< as the arm stood
  TrialFit placed, fit;
};

/// The share from which no step leads away.
std::optional<MotionFit> fit_share(const DataSet& data, const Trial& trial, MotionStart off) {
  constexpr int kSteps = 12;
  constexpr double kDone = 1e-4;  // of the share
  for (int step = 0; step < kSteps && std::abs(off.share) < kMostShare; ++step) {
    MotionFit motion{off, stood(data, trial, off), {}, {}};
    motion.placed = fit_base_and_tools(motion.trial);
    motion.fit = fit_arm(motion.trial, motion.placed);
    if (!motion.fit.has_links()) return std::nullopt;
    const auto ways = ways_of(data, trial, off.direction, off.share);
    const Eigen::VectorXd column = way_column(motion.trial, motion.fit, ways, off.joint);
    const double by = ProjectedColumns(motion.trial, motion.fit).coefficients(column)[0];
    if (std::abs(by) < kDone * std::abs(off.share) || step + 1 == kSteps) return motion;
    off.share += by;
  }
  return std::nullopt;
}

Eigen::MatrixXd beside_each_other(const std::vector<Eigen::MatrixXd>& parts) {
  Eigen::Index columns = 0;
  for (const Eigen::MatrixXd& part : parts) columns += part.cols();
  Eigen::MatrixXd all(parts.front().rows(), columns);
  columns = 0;
  for (const Eigen::MatrixXd& part : parts) {
    all.middleCols(columns, part.cols()) = part;
    columns += part.cols();
  }
  return all;
}

/// The gains of lost motion of each joint, and of a wrong gain of each.
double gain_of_others(const DataSet& data, const Trial& trial, const TrialFit& fit, const ProjectedColumns& projected) {
  const auto before = ways_of(data, trial, -1);
  const auto sign = [&before](std::size_t row, int joint) { return side_of(before[row], joint); };
  const auto value = [&trial](std::size_t row, int joint) { return trial.rows[row].joints[joint]; };
  return std::max(projected.gain(joint_columns(trial, fit, sign)), projected.gain(joint_columns(trial, fit, value)));
}

/// What the errors of a fit to the rows as given show, where it is this rather than lost motion, gears, or the way on
/// the other side of the stop.
std::optional<MotionStart> shown_by_errors(const DataSet& data, const Trial& trial, const TrialFit& fit) {
  const ProjectedColumns projected(trial, fit);
  const Eigen::VectorXd from = way_column(trial, fit, ways_of(data, trial, -1)),
                        to = way_column(trial, fit, ways_of(data, trial, 1));
  const double gain_from = projected.gain(from), gain_to = projected.gain(to);
  const double gain = std::max(gain_from, gain_to), least = kNotableGain * fit.rows_per_pose;
  if (gain < least) return std::nullopt;
  const double others = std::max(gain_of_others(data, trial, fit, projected), std::min(gain_from, gain_to));
  if (gain < others + 0.5 * least) return std::nullopt;
  const bool is_from = gain_from >= gain_to;
  return MotionStart{is_from ? -1 : 1, projected.coefficients(is_from ? from : to)[0]};
}

/// What lost motion and gears of all joints could do: their sides of approach, as the ways and the file have them,
/// their positions, and waves of one and two a turn.
Eigen::MatrixXd columns_of_joints(const DataSet& data, const Trial& trial, const TrialFit& fit) {
  const auto before = ways_of(data, trial, -1);
  const auto position = [&trial](std::size_t row, int joint) { return trial.rows[row].joints[joint]; };
  std::vector<Eigen::MatrixXd> parts{
      condition_columns(trial, fit), joint_columns(trial, fit, position),
      joint_columns(trial, fit, [&before](std::size_t row, int joint) { return side_of(before[row], joint); })};
  for (const double order : {1.0, 2.0}) {
    parts.push_back(
        joint_columns(trial, fit, [&](std::size_t row, int joint) { return std::cos(order * position(row, joint)); }));
    parts.push_back(
        joint_columns(trial, fit, [&](std::size_t row, int joint) { return std::sin(order * position(row, joint)); }));
  }
  return beside_each_other(parts);
}

/// One joint that moves early or late while the others do not. Its way is told from lost motion and gears of all
/// joints, which a random way is half of by its position, and chosen among the ways of all joints on both sides of the
/// stop; what is left shows no other joint's.
std::optional<MotionStart> one_joint_shown_by_errors(const DataSet& data, const Trial& trial, const TrialFit& fit) {
  const ProjectedColumns projected(trial, fit);
  const Eigen::MatrixXd others = columns_of_joints(data, trial, fit);
  constexpr double kMostOfRows = 0.5;  // that the columns may be, lest they take what the way does
  if (static_cast<double>(others.cols()) > kMostOfRows * static_cast<double>(others.rows())) return std::nullopt;
  const double least = kNotableGain * fit.rows_per_pose + std::log(2.0 * trial.chain.size());
  double most = 0.0, most_of_other_side = 0.0;
  MotionStart shown;
  Eigen::MatrixXd of_side;
  for (const int direction : {-1, 1}) {
    const auto ways = ways_of(data, trial, direction);
    const Eigen::MatrixXd columns = joint_columns(
        trial, fit, [&ways](std::size_t row, int joint) { return ways[row] ? (*ways[row])[joint] : 0.0; });
    double gain = 0.0;
    int best = 0;
    for (int joint = 0; joint < trial.chain.size(); ++joint) {
      const double of_joint = projected.gain_beyond(columns.col(joint), others);
      if (of_joint <= gain) continue;
      gain = of_joint;
      best = joint;
    }
    most_of_other_side = std::min(std::max(most, most_of_other_side), gain);
    if (gain <= most) continue;
    most = gain;
    shown = {direction, projected.coefficients(columns.col(best))[0], best};
    of_side = columns;
  }
  if (most < least + most_of_other_side) return std::nullopt;
  const Eigen::MatrixXd with_it = beside_each_other({others, of_side.col(shown.joint)});
  if (projected.gain_beyond(of_side, with_it) > 0.5 * most) return std::nullopt;
  return shown;
}

/// The best of fits that begin with those shares of either way by which base and tools alone fit best: links that were
/// fitted to rows far off leave errors that no longer show it.
std::optional<MotionFit> best_of_shares(const DataSet& data, const Trial& trial) {
  constexpr std::size_t kTried = 3;
  std::vector<std::pair<double, MotionStart>> starts;
  for (const int direction : {-1, 1})
    for (const double share : {0.02, 0.05, 0.1, 0.15, 0.2, 0.25})
      for (const double off : {share, -share})
        starts.push_back(
            {fit_base_and_tools(stood(data, trial, {direction, off})).median_m, MotionStart{direction, off}});
  std::ranges::stable_sort(starts, {}, [](const auto& start) { return start.first; });
  std::optional<MotionFit> best;
  for (std::size_t i = 0; i < kTried; ++i) {
    auto motion = fit_share(data, trial, starts[i].second);
    if (motion && (!best || motion->fit.median_m < best->fit.median_m)) best = std::move(motion);
  }
  return best;
}

}  // namespace

std::vector<std::optional<JointVector>> ways_of(const DataSet& data, const Trial& trial, int direction, double share) {
  constexpr double kSameStop = 2e-4;  // rad or m
  const std::vector<std::size_t> order = measured_order(data);
  const auto n = std::ssize(order);
  const auto joints = [&](std::ptrdiff_t at) -> const JointVector& {
    return data.poses[order[static_cast<std::size_t>(at)]].joints;
  };
  std::vector<std::optional<JointVector>> all(order.size());
  std::vector<JointVector> rested(order.size());  // by place in the order
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const std::ptrdiff_t place = direction < 0 ? i : n - 1 - i;
    std::optional<JointVector>& way = all[order[static_cast<std::size_t>(place)]];
    for (std::ptrdiff_t at = place + direction; !way && at >= 0 && at < n; at += direction)
      if ((joints(place) - joints(at)).cwiseAbs().maxCoeff() > kSameStop)
        way = joints(place) - rested[static_cast<std::size_t>(at)];
    rested[static_cast<std::size_t>(place)] = joints(place);
    if (way && share > 0.0) rested[static_cast<std::size_t>(place)] += share * *way;
  }
  std::vector<std::optional<JointVector>> ways;
  for (const TrialRow& row : trial.rows) ways.push_back(all[row.pose]);
  return ways;
}

double side_of(const std::optional<JointVector>& way, int joint) {
  const double moved = way ? (*way)[joint] : 0.0;
  return moved > 0.0 ? 1.0 : moved < 0.0 ? -1.0 : 0.0;
}

std::optional<Finding> find_taken_in_motion(const DataSet& data, double most_m, CheckedRows& rows, TrialFit& placed,
                                            TrialFit& fit) {
  if (rows.trial.rows.size() < kFewestRecorded) return std::nullopt;
  std::optional<MotionFit> motion;
  if (fit.median_m > kImplausibleShare * rows.trial.reach_m()) {
    motion = best_of_shares(data, rows.trial);
  } else if (fit.has_links()) {
    auto off = shown_by_errors(data, rows.trial, fit);
    if (!off) off = one_joint_shown_by_errors(data, rows.trial, fit);
    if (off) motion = fit_share(data, rows.trial, *off);
  }
  if (!motion || motion->fit.median_m > most_m) return std::nullopt;
  Finding finding{.kind = FindingKind::taken_in_motion,
                  .joint = motion->off.joint,
                  .as_given_mm = millimetres(fit.median_m),
                  .if_changed_mm = millimetres(motion->fit.median_m),
                  .sentence = sentence_of(motion->off, fit.median_m, motion->fit.median_m)};
  rows = {stood(data, std::move(rows.whole), motion->off), std::move(motion->trial)};
  placed = std::move(motion->placed);
  fit = std::move(motion->fit);
  return finding;
}

}  // namespace demecal::inline data_check
