#include "parameters/observation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/stated_radius.hpp"
#include "effects/arm_state.hpp"
#include "parameters/declared_model.hpp"
#include "pieces/pieces.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline parameters {
namespace {

/// Visits the rows in use: visit(row among the used, row among all, its scale). Returns how many there are.
template <typename Visit>
int for_each_row_in_use(const MeasuredPose& pose, const RowScales& scales, Visit visit) {
  const RowCounts count = count_rows(pose);
  int used = 0, all = 0;
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    for (int i = 0; i < count[kind]; ++i, ++all) {
      if (scales[kind] > 0) visit(used++, all, scales.of(pose, kind));
    }
  }
  return used;
}

void scale_residual(const Eigen::VectorXd& all, const MeasuredPose& pose, const RowScales& scales, ScaledRows& rows) {
  rows.residual.resize(rows_in_use(pose, scales));
  for_each_row_in_use(pose, scales, [&](int to, int from, double scale) { rows.residual[to] = all[from] / scale; });
}

/// Whether that row of a pose is the distance from a contact by the arm's own lengths alone: a wire shows its length.
bool grows_with_the_arm(const MeasuredPose& pose, int row) {
  const MeasurementRows rows = rows_of(pose);
  return row >= rows.position && row < rows.points() && pose.contact_length_m == 0.0;
}

}  // namespace

double RowScales::factor(const MeasuredPose& pose, std::size_t kind) const {
  const auto own = std::ranges::find(stations, pose.station, &StationFactors::station);
  return own == stations.end() ? 1.0 : own->factors[kind];
}

std::vector<Observation> observe(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot) {
  std::vector<Observation> observations(poses.size());
  in_batches(poses.size(), [&](std::size_t i) {
    const MeasuredPose& measured = data.poses[poses[i]];
    observations[i] = {poses[i], robot.corrected_joints(measured.joints),
                       robot.motions(Stop(measured), measured.target)};
  });
  return observations;
}

RowCounts count_rows(const MeasuredPose& pose) {
  const MeasurementRows rows = rows_of(pose);
  return {rows.points(), rows.orientation, rows.distances};
}

RowCounts count_rows(const DataSet& data, const std::vector<Observation>& observations) {
  RowCounts count{};
  for (const Observation& observation : observations) {
    const RowCounts rows = count_rows(data.poses[observation.pose]);
    for (std::size_t kind = 0; kind < kRowKinds; ++kind) count[kind] += rows[kind];
  }
  return count;
}

int rows_in_use(const MeasuredPose& pose, const RowScales& scales) {
  return for_each_row_in_use(pose, scales, [](int, int, double) {});
}

int rows_in_use(const DataSet& data, const std::vector<Observation>& observations, const RowScales& scales) {
  int rows = 0;
  for (const Observation& observation : observations) rows += rows_in_use(data.poses[observation.pose], scales);
  return rows;
}

Eigen::VectorXd unscaled_residual(const DataSet& data, const CorrectedRobot& robot, const Observation& observation) {
  const MeasuredPose& pose = data.poses[observation.pose];
  return residual(robot, robot.predict(observation.corrected, observation.motions, pose.target), data, pose);
}

void scaled_residual(const DataSet& data, const CorrectedRobot& robot, const Observation& observation,
                     const RowScales& scales, ScaledRows& rows) {
  scale_residual(unscaled_residual(data, robot, observation), data.poses[observation.pose], scales, rows);
}

void scaled_rows(const DataSet& data, const ParameterSpace& space, const ModelPoint& point,
                 const Observation& observation, const RowScales& scales, ScaledRows& rows) {
  const MeasuredPose& pose = data.poses[observation.pose];
  space.move_tool(point, observation.corrected, observation.motions, pose.target, rows.motion);
  if (!pose.contact.empty()) space.move_contact(point, group_of(pose), rows.motion);
  if (!pose.station.empty()) space.move_station(point, pose.station, rows.motion);
  scale_residual(residual(point.robot, rows.motion.predicted, data, pose), pose, scales, rows);
  const auto measured = measurement_jacobian(point.robot, rows.motion.predicted, data, pose);
  rows.jacobian.resize(rows.residual.size(), space.size());
  for_each_row_in_use(pose, scales, [&](int to, int from, double scale) {
    rows.jacobian.row(to).noalias() = (-1.0 / scale) * measured.row(from) * rows.motion.twists;
    if (!grows_with_the_arm(pose, from)) return;
    rows.residual[to] /= point.size;
    rows.jacobian.row(to) = (rows.jacobian.row(to) - rows.residual[to] * space.size_slopes().transpose()) / point.size;
  });
}

RowScales root_mean_squares(const DataSet& data, const CorrectedRobot& robot,
                            const std::vector<Observation>& observations) {
  RowScales squares{};
  for (const Observation& observation : observations) {
    const Eigen::VectorXd all = unscaled_residual(data, robot, observation);
    const RowCounts count = count_rows(data.poses[observation.pose]);
    int row = 0;
    for (std::size_t kind = 0; kind < kRowKinds; row += count[kind++]) {
      squares[kind] += all.segment(row, count[kind]).squaredNorm();
    }
  }
  const RowCounts count = count_rows(data, observations);
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    if (count[kind] > 0) squares[kind] = std::sqrt(squares[kind] / count[kind]);
  }
  return squares;
}

bool mounted_otherwise(const DataSet& data, const CorrectedRobot& robot, const std::vector<Observation>& observations) {
  return root_mean_squares(data, robot, observations)[kOrientation] > kMountedOtherwise_rad;
}

namespace {

class RelationCollector {
 public:
  RelationCollector(const ParameterSpace& space, const ModelPoint& point) : space_(space), point_(point) {
    for (int i = 0; i < space.size(); ++i) {
      const ParameterId& id = space.ids()[static_cast<std::size_t>(i)];
      if (id.kind == ParameterId::Kind::contact) columns_[{id.target, id.set}][id.index] = i;
    }
  }

  void add(const KnownDistance& known) {
    if (is_radius(known)) return add_radius(known);
    const std::vector<PoseSet> sets = sets_with(known.first, known.second);
    for (const PoseSet set : sets) {
      const double sigma = known.sigma_m * std::sqrt(static_cast<double>(sets.size()));
      const ContactPlace &first = place(known.first, set), &second = place(known.second, set);
      const auto [length_m, along] = place_distance(first, second);
      Eigen::VectorXd row = Eigen::VectorXd::Zero(space_.size());
      add_shift(row, {known.first, set}, -along / sigma);
      add_shift(row, {known.second, set}, along / sigma);
      if (first.kind == ContactKind::plane || second.kind == ContactKind::plane)
        add_turn(row, {first.kind == ContactKind::plane ? known.first : known.second, set}, along,
                 first.frame.translation() - second.frame.translation(), -1.0 / sigma);
      push((known.length_m - length_m) / sigma, row);
    }
  }

  void add(const KnownAngle& known) {
    const std::vector<PoseSet> sets = sets_with(known.first, known.second);
    for (const PoseSet set : sets) {
      const double sigma = known.sigma_rad * std::sqrt(static_cast<double>(sets.size()));
      const Eigen::Matrix3d first = place(known.first, set).frame.linear();
      const Eigen::Vector3d other = place(known.second, set).frame.linear().col(2);
      // Square: the normals' product is zero. Parallel: the other lies along neither axis across the first.
      for (const int axis : known.square ? std::vector<int>{2} : std::vector<int>{0, 1}) {
        const Eigen::Vector3d own = first.col(axis);
        Eigen::VectorXd row = Eigen::VectorXd::Zero(space_.size());
        add_turn(row, {known.first, set}, own, other, -1.0 / sigma);
        add_turn(row, {known.second, set}, other, own, -1.0 / sigma);
        push(-own.dot(other) / sigma, row);
      }
    }
  }

  RelationRows rows() const {
    RelationRows all{Eigen::VectorXd(std::ssize(residuals_)), Eigen::MatrixXd(std::ssize(residuals_), space_.size())};
    for (std::size_t i = 0; i < residuals_.size(); ++i) {
      all.residual[static_cast<Eigen::Index>(i)] = residuals_[i];
      all.jacobian.row(static_cast<Eigen::Index>(i)) = jacobian_[i].transpose();
    }
    return all;
  }

 private:
  void add_radius(const KnownDistance& known) {
    std::vector<PoseSet> sets;
    for (const auto& [group, columns] : columns_)
      if (group.contact == known.first && columns.contains(kRadiusMotion)) sets.push_back(group.set);
    for (const PoseSet set : sets) {
      const double sigma = known.sigma_m * std::sqrt(static_cast<double>(sets.size()));
      push((known.length_m - place(known.first, set).radius_m) / sigma,
           -Eigen::VectorXd::Unit(space_.size(), columns_.at({known.first, set}).at(kRadiusMotion)) / sigma);
    }
  }

  std::vector<PoseSet> sets_with(const std::string& first, const std::string& second) const {
    std::vector<PoseSet> sets;
    for (const PoseSet set : {PoseSet::calibration, PoseSet::validation, PoseSet::accept})
      if (columns_.contains({first, set}) && columns_.contains({second, set})) sets.push_back(set);
    return sets;
  }

  const ContactPlace& place(const std::string& contact, PoseSet set) const {
    return point_.robot.contacts.at({contact, set});
  }

  void add_shift(Eigen::VectorXd& row, const ContactGroup& group, const Eigen::Vector3d& slope) const {
    for (const auto& [motion, column] : columns_.at(group))
      if (motion < 3) row[column] += slope.dot(shift_axis(point_.robot.contacts.at(group), motion, turn_of(group)));
  }

  /// The product of a direction of the place and a vector that stays.
  void add_turn(Eigen::VectorXd& row, const ContactGroup& group, const Eigen::Vector3d& direction,
                const Eigen::Vector3d& fixed, double factor) const {
    for (const auto& [motion, column] : columns_.at(group)) {
      if (motion < 3 || motion == kRadiusMotion) continue;
      const Eigen::Vector3d axis = turn_axis(point_.robot.contacts.at(group), motion, turn_of(group));
      row[column] += factor * axis.cross(direction).dot(fixed);
    }
  }

  Eigen::Vector3d turn_of(const ContactGroup& group) const {
    const auto turned = point_.contact_turns.find(group);
    return turned == point_.contact_turns.end() ? Eigen::Vector3d::Zero() : turned->second;
  }

  void push(double residual, Eigen::VectorXd row) {
    residuals_.push_back(residual);
    jacobian_.push_back(std::move(row));
  }

  const ParameterSpace& space_;
  const ModelPoint& point_;
  std::map<ContactGroup, std::map<int, int>> columns_;  ///< by motion
  std::vector<double> residuals_;
  std::vector<Eigen::VectorXd> jacobian_;
};

}  // namespace

RelationRows relation_rows(const DataSet& data, const ParameterSpace& space, const ModelPoint& point) {
  if (data.contacts.distances.empty() && data.contacts.angles.empty())
    return {Eigen::VectorXd(0), Eigen::MatrixXd(0, space.size())};
  RelationCollector collector(space, point);
  for (const KnownDistance& known : data.contacts.distances) collector.add(known);
  for (const KnownAngle& known : data.contacts.angles) collector.add(known);
  return collector.rows();
}

}  // namespace demecal::inline parameters
