#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {
namespace {

constexpr std::size_t kFewestTouching = 2;  ///< poses of either name on either side of the row

/// The names of two points, exchanged from a pose on (of the data set, in the order of its rows).
struct NameExchange {
  std::string first, second;
  std::size_t from = 0;
};

DataSet with_names_back(DataSet data, const NameExchange& exchange) {
  for (std::size_t i = exchange.from; i < data.poses.size(); ++i) {
    std::string& contact = data.poses[i].contact;
    if (contact == exchange.first) {
      contact = exchange.second;
    } else if (contact == exchange.second) {
      contact = exchange.first;
    }
  }
  return data;
}

/// The sum of squares of points about their mean.
struct ScatterSum {
  std::size_t count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares_m2 = 0.0;

  void add(const Eigen::Vector3d& point_m) {
    ++count;
    sum += point_m;
    squares_m2 += point_m.squaredNorm();
  }
  ScatterSum plus(const ScatterSum& other) const {
    return {count + other.count, sum + other.sum, squares_m2 + other.squares_m2};
  }
  ScatterSum minus(const ScatterSum& other) const {
    return {count - other.count, sum - other.sum, squares_m2 - other.squares_m2};
  }
  double left_m2() const { return count == 0 ? 0.0 : squares_m2 - sum.squaredNorm() / static_cast<double>(count); }
};

/// The exchange of those two that leaves the least squares of their calibration poses, by the points of `robot`.
std::optional<NameExchange> best_exchange(const DataSet& data, const CorrectedRobot& robot, const std::string& first,
                                          const std::string& second) {
  std::vector<std::size_t> poses;
  for (const std::size_t pose : poses_of(data, PoseSet::calibration))
    if (data.poses[pose].contact == first || data.poses[pose].contact == second) poses.push_back(pose);
  ScatterSum all_first, all_second;
  std::vector<Eigen::Vector3d> points_m;
  for (const std::size_t pose : poses) {
    points_m.push_back(touch_of(robot, data.poses[pose]).point_m);
    (data.poses[pose].contact == first ? all_first : all_second).add(points_m.back());
  }
  ScatterSum early_first, early_second;
  std::optional<NameExchange> best;
  double least_m2 = all_first.left_m2() + all_second.left_m2();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const ScatterSum late_first = all_first.minus(early_first), late_second = all_second.minus(early_second);
    const double left_m2 = early_first.plus(late_second).left_m2() + early_second.plus(late_first).left_m2();
    const std::size_t fewest = std::min({early_first.count, early_second.count, late_first.count, late_second.count});
    if (fewest >= kFewestTouching && left_m2 < least_m2) {
      least_m2 = left_m2;
      best = NameExchange{first, second, poses[i]};
    }
    (data.poses[poses[i]].contact == first ? early_first : early_second).add(points_m[i]);
  }
  return best;
}

/// How far from their own middle the calibration poses of either are, the farther of both medians.
double apart_by_m(const DataSet& data, const CorrectedRobot& robot, const NameExchange& exchange) {
  double most_m = 0.0;
  for (const auto& [group, poses] : contact_groups(data))
    if (group.set == PoseSet::calibration && (group.contact == exchange.first || group.contact == exchange.second))
      most_m = std::max(most_m, median(tool_errors_m(robot, data, poses)));
  return most_m;
}

/// The exchange once the arm has its tool where the poses have it with the names back, which moves the row in turn.
std::optional<NameExchange> settled_exchange(const DataSet& data, NameExchange exchange, CorrectedRobot& robot) {
  constexpr int kMostTurns = 5;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const std::optional<CorrectedRobot> stiff = stiff_arm(with_names_back(data, exchange));
    if (!stiff) return std::nullopt;
    robot = *stiff;
    const std::optional<NameExchange> next = best_exchange(data, robot, exchange.first, exchange.second);
    if (!next) return std::nullopt;
    if (next->from == exchange.from) break;
    exchange = *next;
  }
  return exchange;
}

Finding of_exchange(const DataSet& data, const NameExchange& exchange, double as_given_m, double if_changed_m) {
  const MeasuredPose& from = data.poses[exchange.from];
  Finding finding{.kind = FindingKind::targets_exchanged,
                  .as_given_mm = millimetres(as_given_m),
                  .if_changed_mm = millimetres(if_changed_m)};
  for (std::size_t i = exchange.from; i < data.poses.size(); ++i)
    if (data.poses[i].contact == exchange.first || data.poses[i].contact == exchange.second)
      finding.poses.push_back(data.poses[i].pose_id);
  finding.sentence = fmt::format(
      "From line {}{} on the contacts '{}' and '{}' are exchanged: with their names the other way round there the "
      "poses "
      "of both lie {} from where they have them on average (median), as given {}. Correct the names.",
      from.line, name_beside_line(from), exchange.first, exchange.second, distance_text(if_changed_m),
      distance_text(as_given_m));
  return finding;
}

}  // namespace

std::optional<Finding> find_exchanged_contacts(const DataSet& data) {
  constexpr double kExplains = 0.3;
  std::vector<std::string> points;
  for (const auto& [group, poses] : contact_groups(data))
    if (group.set == PoseSet::calibration && data.contacts.form_of(group.contact).kind == ContactKind::point)
      points.push_back(group.contact);
  const CorrectedRobot nominal = nominal_robot(data);
  const std::optional<CorrectedRobot> as_given = stiff_arm(data);
  if (!as_given) return std::nullopt;
  std::optional<Finding> best;
  double least_share = kExplains;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const std::optional<NameExchange> rough = best_exchange(data, nominal, points[i], points[j]);
      if (!rough) continue;
      CorrectedRobot robot;
      const std::optional<NameExchange> exchange = settled_exchange(data, *rough, robot);
      if (!exchange) continue;
      const double as_given_m = apart_by_m(data, *as_given, *exchange);
      const double changed_m = apart_by_m(with_names_back(data, *exchange), robot, *exchange);
      if (!(changed_m < least_share * as_given_m)) continue;
      least_share = changed_m / as_given_m;
      best = of_exchange(data, *exchange, as_given_m, changed_m);
    }
  }
  return best;
}

}  // namespace demecal::inline data_check
