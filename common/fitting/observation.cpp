#include "fitting/observation.hpp"

#include <cmath>

#include "effects/arm_state.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline fitting {
namespace {

/// Visits the rows in use: visit(row among the used, row among all, its scale). Returns how many there are.
template <typename Visit>
int for_each_row_in_use(const MeasuredPose& pose, const RowScales& scales, Visit visit) {
  const RowCounts count = count_rows(pose);
  int used = 0, all = 0;
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    for (int i = 0; i < count[kind]; ++i, ++all) {
      if (scales[kind] > 0) visit(used++, all, scales[kind]);
    }
  }
  return used;
}

void scale_residual(const Eigen::VectorXd& all, const MeasuredPose& pose, const RowScales& scales, ScaledRows& rows) {
  rows.residual.resize(rows_in_use(pose, scales));
  for_each_row_in_use(pose, scales, [&](int to, int from, double scale) { rows.residual[to] = all[from] / scale; });
}

}  // namespace

std::vector<Observation> observe(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot) {
  std::vector<Observation> observations;
  observations.reserve(poses.size());
  for (const std::size_t pose : poses) {
    const MeasuredPose& measured = data.poses[pose];
    observations.push_back(
        {pose, robot.corrected_joints(measured.joints), robot.motions(Stop(measured), measured.target)});
  }
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

}  // namespace demecal::inline fitting
