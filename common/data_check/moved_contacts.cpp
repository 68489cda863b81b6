#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "kinematics/units.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {
namespace {

constexpr std::size_t kFewestOfPlace = 3;   ///< poses that tell where a contact is
constexpr double kSlipOverScatter = 3.0;    ///< of the distance between both places over the rms distance from them
constexpr double kLeastSlip_m = 1e-4;       ///< what wear of a ball or socket may be
constexpr double kStepOverSlope = 0.5;      ///< squares that a step leaves over those that a steady motion does
constexpr double kStepOverCondition = 0.5;  ///< the same over those that lost motion or elasticity would

using Points = std::vector<Eigen::Vector3d>;

struct PointSums {
  std::size_t count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0.0;

  void add(const Eigen::Vector3d& point) {
    ++count;
    sum += point;
    squares += point.squaredNorm();
  }
  Eigen::Vector3d mean() const { return sum / static_cast<double>(count); }
  /// About their mean.
  double left() const { return std::max(0.0, squares - sum.squaredNorm() / static_cast<double>(count)); }
};

/// The points before a row and from it on, each about a mean of its own.
struct Step {
  std::size_t first = 0;  ///< of the later ones
  double shift_m = 0.0, left_m2 = 0.0;
};

/// The best one.
Step best_step(const Points& points) {
  Step best{.left_m2 = std::numeric_limits<double>::infinity()};
  for (std::size_t first = kFewestOfPlace; first + kFewestOfPlace <= points.size(); ++first) {
    PointSums before, after;
    for (std::size_t i = 0; i < points.size(); ++i) (i < first ? before : after).add(points[i]);
    const double left_m2 = before.left() + after.left();
    if (left_m2 < best.left_m2) best = {first, (after.mean() - before.mean()).norm(), left_m2};
  }
  return best;
}

/// What a steady motion from the first point to the last leaves of their squares about it.
double left_by_steady_motion_m2(const Points& points) {
  PointSums all;
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  const double middle = 0.5 * static_cast<double>(points.size() - 1);
  double squares = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double time = static_cast<double>(i) - middle;
    all.add(points[i]);
    along += time * points[i];
    squares += time * time;
  }
  return std::max(0.0, all.left() - along.squaredNorm() / squares);
}

/// What means of their own leave of the squares of the points that a condition divides.
double left_by_condition_m2(const Points& points, const std::vector<double>& condition) {
  std::map<double, PointSums> levels;
  for (std::size_t i = 0; i < points.size(); ++i) levels[condition[i]].add(points[i]);
  double left_m2 = 0.0;
  for (const auto& [level, sums] : levels) left_m2 += sums.left();
  return levels.size() == 2 ? left_m2 : std::numeric_limits<double>::infinity();
}

/// What the file states of the poses and what may move the arm between two of its states: each joint's side of
/// approach, and the payload.
std::vector<std::vector<double>> conditions_of(const DataSet& data, const std::vector<std::size_t>& poses) {
  std::vector<std::vector<double>> conditions;
  const auto take = [&](auto value) {
    std::vector<double>& values = conditions.emplace_back();
    for (const std::size_t pose : poses) values.push_back(value(data.poses[pose]));
  };
  for (int joint = 0; joint < data.robot.chain.size(); ++joint)
    take([joint](const MeasuredPose& pose) { return pose.approach ? (*pose.approach)[joint] : 0.0; });
  take([](const MeasuredPose& pose) { return pose.payload_kg.value_or(0.0); });
  return conditions;
}

std::optional<Step> slip_of(const Points& points, const std::vector<std::vector<double>>& conditions) {
  if (points.size() < 2 * kFewestOfPlace + 1) return std::nullopt;
  const Step step = best_step(points);
  const double scatter_m = std::sqrt(step.left_m2 / static_cast<double>(points.size() - 2));
  if (step.shift_m < std::max(kLeastSlip_m, kSlipOverScatter * scatter_m)) return std::nullopt;
  if (step.left_m2 > kStepOverSlope * left_by_steady_motion_m2(points)) return std::nullopt;
  const auto explains_it = [&](const std::vector<double>& condition) {
    return step.left_m2 > kStepOverCondition * left_by_condition_m2(points, condition);
  };
  if (std::ranges::any_of(conditions, explains_it)) return std::nullopt;
  return step;
}

}  // namespace

std::vector<MovedContact> find_moved_contacts(const DataSet& data, const CorrectedRobot& robot,
                                              const std::set<std::size_t>& elsewhere) {
  std::vector<MovedContact> found;
  for (const auto& [group, members] : contact_groups(data)) {
    if (data.contacts.form_of(group.contact).kind != ContactKind::point) continue;
    std::vector<std::size_t> there;
    for (const std::size_t pose : members)
      if (!elsewhere.contains(pose)) there.push_back(pose);
    Points points;
    for (const std::size_t pose : there) points.push_back(touch_of(robot, data.poses[pose]).point_m);
    const std::optional<Step> slip = slip_of(points, conditions_of(data, there));
    if (!slip) continue;
    const auto first = std::ranges::find(members, there[slip->first]);
    found.push_back({group, {first, members.end()}, slip->shift_m});
  }
  return found;
}

Finding of_moved_contact(const DataSet& data, const MovedContact& moved) {
  const MeasuredPose& there = data.poses[moved.from_there.front()];
  Finding finding{.kind = FindingKind::contact_moved, .as_given_mm = millimetres(moved.shift_m)};
  for (const std::size_t pose : moved.from_there) finding.poses.push_back(data.poses[pose].pose_id);
  finding.sentence = fmt::format(
      "Contact '{}' moved before line {}{}: from there on its {} poses lie {} elsewhere. The ball or the socket "
      "slipped, or something of the arm did: give the poses from there on another name of contact, or measure again.",
      moved.group.contact, there.line, name_beside_line(there), to_string(moved.group.set),
      distance_text(moved.shift_m));
  return finding;
}

}  // namespace demecal::inline data_check
