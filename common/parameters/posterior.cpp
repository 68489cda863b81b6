#include "parameters/posterior.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <type_traits>
#include <vector>

#include "data/contacts.hpp"
#include "decompositions/decompositions.hpp"
#include "effects/arm_state.hpp"
#include "errors/check.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"

namespace demecal::inline parameters {
namespace {

/// Of each score: its part of its group's one vote.
std::vector<double> votes(std::span<const std::size_t> groups) {
  std::map<std::size_t, double> members;
  for (const std::size_t group : groups) members[group] += 1.0;
  std::vector<double> parts;
  for (const std::size_t group : groups) parts.push_back(1.0 / members[group]);
  return parts;
}

bool is_of_distances(const MeasuredPose& pose) {
  return !measures_point(pose) && !pose.distances_m.empty();
}

/// Of a pose that touches something: what is left of the posterior where the contact's place is taken from the poses of
/// its group, which are wrong together.
double touched_square_m2(const Posterior& posterior, const CorrectedRobot& robot, const DataSet& data,
                         const MeasuredPose& pose) {
  std::vector<const MeasuredPose*> group;
  std::vector<Touch> touches;
  for (const MeasuredPose& other : data.poses) {
    if (other.contact.empty() || group_of(other) != group_of(pose)) continue;
    group.push_back(&other);
    touches.push_back(touch_of(robot, other));
  }
  const ContactPlace place = contact_place(data.contacts.form_of(pose.contact), touches);
  const std::vector<int> motions = motions_of(place);
  const int count = rows_of(place.kind);
  Eigen::MatrixXd spread(count * std::ssize(group), posterior.factor.cols());
  Eigen::MatrixXd moved(spread.rows(), std::ssize(motions));
  Eigen::Index own = 0;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const Eigen::Index first = count * static_cast<Eigen::Index>(i);
    if (group[i] == &pose) own = first;
    const auto rows = contact_jacobian(place, touches[i].point_m);
    spread.middleRows(first, count) =
        rows * pose_spread(posterior, robot, Stop(*group[i]), group[i]->target).topRows<3>();
    for (std::size_t k = 0; k < motions.size(); ++k)
      moved.block(first, static_cast<Eigen::Index>(k), count, 1) =
          rows * equivalent_motion(place, motions[k], Eigen::Vector3d::Zero(), touches[i].point_m);
  }
  spread -= moved * least_norm_solutions(moved, spread);
  return spread.middleRows(own, count).squaredNorm();
}

}  // namespace

Posterior with_turned_base(Posterior posterior, const Eigen::Matrix3d& turn) {
  for (const auto kind : {ParameterId::Kind::base_translation, ParameterId::Kind::base_rotation}) {
    Eigen::MatrixXd along = Eigen::MatrixXd::Zero(3, posterior.factor.cols());
    const auto each = [&](const auto& visit) {
      for (std::size_t i = 0; i < posterior.ids.size(); ++i)
        if (posterior.ids[i].kind == kind) visit(static_cast<Eigen::Index>(i), posterior.ids[i].index);
    };
    each([&](Eigen::Index row, int axis) { along.row(axis) = posterior.factor.row(row); });
    const Eigen::MatrixXd turned = turn * along;
    each([&](Eigen::Index row, int axis) { posterior.factor.row(row) = turned.row(axis); });
  }
  return posterior;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> pose_spread(const Posterior& posterior, const CorrectedRobot& robot,
                                                     const Stop& stop, const std::string& target) {
  const auto numbers = static_cast<Eigen::Index>(posterior.ids.size() + posterior.terms.size());
  DEMECAL_CHECK(posterior.factor.rows() == numbers, posterior.factor.rows() << " rows of " << numbers << " numbers");
  const ParameterSpace space(robot, posterior.ids);
  ToolMotion motion;
  space.move_tool(space.at(Eigen::VectorXd::Zero(space.size())), robot.corrected_joints(stop.joints),
                  robot.motions(stop, target), target, motion);
  Eigen::Matrix<double, 6, Eigen::Dynamic> spread =
      motion.twists * posterior.factor.topRows(static_cast<Eigen::Index>(posterior.ids.size()));
  if (posterior.terms.empty()) return spread;
  const Eigen::Vector3d& tool_m = robot.tool(target).translation();
  Jacobian joints = differential_kinematics(robot.chain, robot.actual_joints(stop), tool_m).drives;
  const Eigen::Matrix3d& base = robot.sensor_from_base.linear();
  joints.topRows<3>() = (base * joints.topRows<3>()).eval();
  joints.bottomRows<3>() = (base * joints.bottomRows<3>()).eval();
  auto row = static_cast<Eigen::Index>(posterior.ids.size());
  for (const CorrectionTerm& term : posterior.terms) {
    spread += term.shape(stop.joints[term.joint]) * joints.col(term.joint) * posterior.factor.row(row++);
  }
  return spread;
}

PoseCovariance pose_covariance(const Posterior& posterior, const CorrectedRobot& robot, const Stop& stop,
                               const std::string& target) {
  const Eigen::Matrix<double, 6, Eigen::Dynamic> spread = pose_spread(posterior, robot, stop, target);
  return spread * spread.transpose();
}

double conformal_quantile(std::span<const double> scores, std::span<const std::size_t> groups, double share) {
  constexpr double kRounding = 1e-9;
  DEMECAL_CHECK(scores.size() == groups.size(), scores.size() << " scores of " << groups.size() << " groups");
  const std::vector<double> parts = votes(groups);
  std::vector<std::size_t> ascending(scores.size());
  std::iota(ascending.begin(), ascending.end(), std::size_t{0});
  std::ranges::sort(ascending, {}, [&](std::size_t i) { return scores[i]; });
  const double wanted = share * (std::round(std::accumulate(parts.begin(), parts.end(), 0.0)) + 1.0) - kRounding;
  double reached = 0.0;
  for (const std::size_t i : ascending) {
    reached += parts[i];
    if (reached >= wanted) return scores[i];
  }
  return std::numeric_limits<double>::infinity();
}

double normal_quantile_of_scores(std::span<const double> scores, std::span<const std::size_t> groups, int rows,
                                 double share) {
  const std::vector<double> parts = votes(groups);
  double count = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    count += parts[i];
    squares += parts[i] * scores[i] * scores[i];
  }
  if (count <= 0.0) return std::numeric_limits<double>::infinity();
  return std::sqrt(fisher_quantile(share, rows, rows * count) * squares / count);
}

double posterior_square_m2(const Posterior& posterior, const CorrectedRobot& robot, const DataSet& data,
                           const MeasuredPose& pose) {
  if (!pose.contact.empty()) return touched_square_m2(posterior, robot, data, pose);
  const Stop stop(pose);
  const PoseCovariance covariance = pose_covariance(posterior, robot, stop, pose.target);
  if (!is_of_distances(pose)) return covariance.topLeftCorner<3, 3>().trace();
  const Eigen::MatrixXd rows = measurement_jacobian(robot, robot.predict(stop, pose.target), data, pose);
  const auto count = static_cast<Eigen::Index>(pose.distances_m.size());
  const Eigen::MatrixXd lines = rows.bottomRows(count);
  return (lines * covariance * lines.transpose()).trace() / static_cast<double>(count);
}

double noise_square_m2(const PredictionInterval& interval, const MeasuredPose& pose) {
  const double model_error_m2 = std::pow(interval.model_error_m, 2);
  if (is_of_distances(pose)) return std::pow(interval.distance_noise_m, 2) + model_error_m2;
  const double axes = pose.contact.empty() ? 3.0 : rows_of(pose.contact_kind);
  // The interval's noise is that of a row of usual uncertainty: others have theirs in proportion.
  const double larger = pose.position_whitening
                            ? (*pose.position_whitening * pose.position_whitening->transpose()).inverse().trace() / 3.0
                            : 1.0;
  const auto own = interval.station_noise_m.find(pose.station);
  const double noise_m = own == interval.station_noise_m.end() ? interval.noise_m : own->second;
  return axes * (larger * std::pow(noise_m, 2) + model_error_m2);
}

double radius95_m(const PredictionInterval& interval, const Posterior& posterior, const CorrectedRobot& robot,
                  const DataSet& data, const MeasuredPose& pose, const Widening& there_by) {
  PredictionInterval there = interval;
  if (data.stations.empty()) there.station_noise_m.clear();  // whoever measured it is none of them
  PredictionInterval model_alone = there;
  model_alone.noise_m = model_alone.distance_noise_m = 0.0;
  model_alone.station_noise_m.clear();
  const double model_m2 = posterior_square_m2(posterior, robot, data, pose) + noise_square_m2(model_alone, pose);
  const double noise_m2 = noise_square_m2(there, pose) - noise_square_m2(model_alone, pose);
  const double radius_m = interval.quantile * std::sqrt(there_by.factor * there_by.factor * model_m2 + noise_m2);
  return std::hypot(radius_m, there_by.held_radius_m()) + there_by.unstated_m;
}

double real_radius95_m(const PredictionInterval& interval, const Posterior& posterior, const CorrectedRobot& robot,
                       const Stop& stop, const Widening& there_by) {
  const double real_m2 =
      pose_covariance(posterior, robot, stop).topLeftCorner<3, 3>().trace() + 3.0 * std::pow(interval.model_error_m, 2);
  return std::hypot(there_by.factor * real_quantile() * std::sqrt(real_m2), there_by.held_radius_m()) +
         there_by.unstated_m;
}

double real_quantile() {
  return normal_length_quantile(3, kIntervalShare) / std::sqrt(3.0);
}

void leave_out_motion_as_a_whole(const std::vector<Eigen::Vector3d>& points_m, std::vector<Eigen::MatrixXd>& rows) {
  using Motion = Eigen::Matrix<double, 3, 6>;
  std::vector<Motion> motions;
  Eigen::Matrix<double, 6, 6> square = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(6, rows.front().cols());
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    Motion motion = Motion::Zero();
    motion.leftCols<3>().setIdentity();
    for (int axis = 0; axis < 3; ++axis) motion.col(3 + axis) = Eigen::Vector3d::Unit(axis).cross(points_m[i]);
    square += motion.transpose() * motion;
    product += motion.transpose() * rows[i];
    motions.push_back(motion);
  }
  const Eigen::MatrixXd best = PivotedCholesky(square).solve(product);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] -= motions[i] * best;
}

WorkspaceError workspace_error(const Posterior& posterior, const PredictionInterval& interval,
                               const CorrectedRobot& robot, std::span<const Interval> measured, bool placed,
                               RandomStream random) {
  constexpr int kPlaces = 200, kDraws = 500;
  constexpr double kShare = 0.95;
  std::vector<Eigen::Vector3d> points_m;
  std::vector<Eigen::MatrixXd> rows;
  for (int place = 0; place < kPlaces; ++place) {
    Stop stop(JointVector(std::ssize(measured)));
    stop.approach = ApproachSigns(std::ssize(measured));
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const auto joint = static_cast<Eigen::Index>(i);
      stop.joints[joint] = random.real(measured[i].lower, measured[i].upper);
      stop.approach[joint] = random.chance(0.5) ? 1.0 : -1.0;
    }
    points_m.push_back(robot.predict(stop, "").translation());
    rows.push_back(pose_spread(posterior, robot, stop).topRows<3>());
  }
  if (!placed) leave_out_motion_as_a_whole(points_m, rows);
  double squares_m2 = 0.0;
  for (const Eigen::MatrixXd& own : rows) squares_m2 += own.squaredNorm() / kPlaces;
  const auto normal = [&](Eigen::Index size) {
    return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(size, [&] { return random.normal(); }));
  };
  std::vector<double> errors_m;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Eigen::VectorXd numbers = normal(rows.front().cols());
    for (const Eigen::MatrixXd& own : rows)
      errors_m.push_back((own * numbers + interval.model_error_m * normal(3)).norm());
  }
  const auto at = errors_m.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<double>(errors_m.size()));
  std::nth_element(errors_m.begin(), at, errors_m.end());
  return {std::sqrt(squares_m2 + 3.0 * interval.model_error_m * interval.model_error_m), *at};
}

}  // namespace demecal::inline parameters
