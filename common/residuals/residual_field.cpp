#include "residuals/residual_field.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "errors/check.hpp"
#include "fitting/least_squares.hpp"
#include "kinematics/chain.hpp"
#include "pieces/pieces.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline residuals {
namespace {

using Twists = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// The twist of the tool (measurements' frame) per unit motion at every place.
Twists place_twists(const std::vector<Eigen::Isometry3d>& places, const Eigen::Isometry3d& sensor_from_base,
                    const Eigen::Vector3d& tool) {
  Twists twists(6, 6 * (static_cast<Eigen::Index>(places.size()) + 1));
  const auto fill = [&](int place, const Eigen::Isometry3d& frame) {
    const Eigen::Vector3d lever = tool - frame.translation();
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d direction = frame.linear().col(axis);
      twists.col(motion_column(place, axis)) << direction, Eigen::Vector3d::Zero();
      twists.col(motion_column(place, 3 + axis)) << direction.cross(lever), direction;
    }
  };
  fill(kSensorPlace, Eigen::Isometry3d::Identity());
  for (std::size_t i = 0; i < places.size(); ++i) fill(static_cast<int>(i), sensor_from_base * places[i]);
  return twists;
}

/// The root of Huber's weight, tapered to nothing over the outer half of the way to rejection.
double root_weight_of(double norm, int rows) {
  const double huber = norm > huber_threshold(rows) ? std::sqrt(huber_threshold(rows) / norm) : 1.0;
  const double outer = std::max(0.0, 2.0 * norm / rejection_norm(rows) - 1.0);
  return outer < 1.0 ? huber * (1.0 - outer * outer) : 0.0;
}

/// The columns of motions about the axes of revolute joints.
std::vector<Eigen::Index> turns_of(const Chain& chain) {
  std::vector<Eigen::Index> columns;
  for (int joint = 0; joint < chain.size(); ++joint) {
    if (is_revolute(chain, joint)) columns.push_back(motion_column(joint, kTurnAboutZ));
  }
  return columns;
}

/// The root of the covariance that a pose's rows have by themselves.
Eigen::MatrixXd covariance_root(const ResidualField& field, Eigen::Index first, Eigen::Index count,
                                const NoiseModel& noise) {
  Eigen::MatrixXd covariance = (1.0 + noise.fast) * Eigen::MatrixXd::Identity(count, count);
  for (std::size_t joint = 0; joint < field.scattering.size(); ++joint) {
    const Eigen::VectorXd motion = field.motions.block(first, field.scattering[joint], count, 1);
    covariance += noise.joint_variance_rad2(joint) * motion * motion.transpose();
  }
  return covariance.llt().matrixL();
}

/// Makes the rows first .. first + count - 1 independent.
void whiten(ResidualField& field, Eigen::Index first, Eigen::Index count, const Eigen::MatrixXd& root) {
  const auto lower = root.triangularView<Eigen::Lower>();
  const auto apply = [&](auto&& rows) {
    if (rows.cols() > 0) rows = lower.solve(Eigen::MatrixXd(rows));
  };
  apply(field.residual.segment(first, count));
  apply(field.declared.middleRows(first, count));
  apply(field.motions.middleRows(first, count));
}

/// The first pose of each id and target.
void find_repeats(const DataSet& data, ResidualField& field) {
  std::map<std::pair<std::string, std::string>, std::size_t> first;
  for (std::size_t i = 0; i < field.poses.size(); ++i) {
    const MeasuredPose& pose = data.poses[field.poses[i]];
    field.group.push_back(pose.pose_id.empty() ? i : first.try_emplace({pose.pose_id, pose.target}, i).first->second);
  }
}

/// The rows of a pose in use, and the scale of each.
std::vector<std::pair<Eigen::Index, double>> rows_used(const MeasuredPose& pose, const RowScales& scales) {
  std::vector<std::pair<Eigen::Index, double>> used;
  const RowCounts count = count_rows(pose);
  Eigen::Index row = 0;
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    for (int i = 0; i < count[kind]; ++i, ++row) {
      if (scales[kind] > 0) used.emplace_back(row, scales[kind]);
    }
  }
  return used;
}

void reserve(ResidualField& field, const DataSet& data, const std::vector<Observation>& observations,
             const ParameterSpace& space, const RowScales& scales) {
  const auto rows = static_cast<Eigen::Index>(rows_in_use(data, observations, scales));
  field.residual.resize(rows);
  field.declared.resize(rows, space.size());
  field.motions.resize(rows, 6 * (space.reference().chain.size() + 2));
  field.first_row.push_back(0);
}

/// The real arm's places: the identified chain at the joints where it really stands.
std::vector<Eigen::Isometry3d> real_places(const CorrectedRobot& robot, const Stop& stop) {
  Robot real;
  real.chain = robot.chain;
  return arm_state(real, Stop(robot.actual_joints(stop))).places;
}

/// Every pose's rows along one motion: poses x columns of `rows`.
template <typename Rows>
Rows along_motion(const ResidualField& field, Eigen::Index motion, const Rows& rows) {
  using Scalar = typename Rows::Scalar;
  Rows along(static_cast<Eigen::Index>(field.poses.size()), rows.cols());
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    const Eigen::Index first = field.first_row[pose], count = field.rows_of_pose(pose);
    auto target = along.row(static_cast<Eigen::Index>(pose));
    target.setZero();
    for (Eigen::Index row = first; row < first + count; ++row) {
      target += static_cast<Scalar>(field.motions(row, motion)) * rows.row(row);
    }
  }
  return along;
}

}  // namespace

RowMatrix beside(const RowMatrix& left, const RowMatrix& right) {
  RowMatrix both(left.rows(), left.cols() + right.cols());
  both << left, right;
  return both;
}

double rejection_norm(int rows) {
  constexpr double kHuberThresholds = 4.0;
  return kHuberThresholds * huber_threshold(rows);
}

std::size_t distinct_poses(const ResidualField& field) {
  return std::set<std::size_t>(field.group.begin(), field.group.end()).size();
}

ResidualField residual_field(const DataSet& data, std::span<const std::size_t> poses, const ParameterSpace& space,
                             const RowScales& scales, bool robust, const NoiseModel& noise) {
  const CorrectedRobot& robot = space.reference();
  const std::vector<Observation> observations = observe(data, poses, robot);
  const ModelPoint point = space.at(Eigen::VectorXd::Zero(space.size()));
  ResidualField field;
  reserve(field, data, observations, space, scales);
  field.scattering = turns_of(data.robot.chain);
  ScaledRows rows;
  for (const Observation& observation : observations) {
    const MeasuredPose& pose = data.poses[observation.pose];
    const auto used = rows_used(pose, scales);
    if (used.empty()) continue;
    scaled_rows(data, space, point, observation, scales, rows);
    const auto count = static_cast<Eigen::Index>(used.size());
    const Eigen::Index first = field.first_row.back();
    field.residual.segment(first, count) = rows.residual;
    field.declared.middleRows(first, count) = -rows.jacobian;
    const Stop stop(pose);
    const Eigen::Vector3d tool = rows.motion.predicted.translation();
    const Twists twists = place_twists(real_places(robot, stop), robot.sensor_from_base, tool);
    const auto measured = measurement_jacobian(robot, rows.motion.predicted, data, pose);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto& [row, scale] = used[static_cast<std::size_t>(i)];
      field.motions.row(first + i).noalias() = (1.0 / scale) * measured.row(row) * twists;
    }
    field.within.emplace_back();
    Eigen::VectorXd in_deviations = rows.residual;
    if (noise.joint_rad > 0.0 || noise.fast > 0.0) {
      field.within.back() = covariance_root(field, first, count, noise);
      whiten(field, first, count, field.within.back());
      in_deviations = field.residual.segment(first, count);
    }
    // What poses share may be the larger part of how far one is out.
    const double shared = noise.repeats * noise.repeats + noise.order * noise.order - noise.fast;
    if (shared > 0.0) {
      const Eigen::MatrixXd root =
          field.within.back().size() > 0 ? field.within.back() : Eigen::MatrixXd::Identity(count, count);
      const Eigen::MatrixXd whole = root * root.transpose() + shared * Eigen::MatrixXd::Identity(count, count);
      in_deviations = whole.llt().matrixL().solve(rows.residual);
    }
    const double norm = in_deviations.norm();
    const double weight = robust ? root_weight_of(norm, static_cast<int>(count)) : 1.0;
    field.residual.segment(first, count) *= weight;
    field.declared.middleRows(first, count) *= weight;
    field.motions.middleRows(first, count) *= weight;
    field.poses.push_back(observation.pose);
    field.root_weight.push_back(weight);
    field.first_row.push_back(first + count);
    field.states.push_back(arm_state(data.robot, stop));
    field.states.back().tool_in_sensor_m = tool;
  }
  find_repeats(data, field);
  return field;
}

void EffectColumns::append(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states) {
  const auto poses = static_cast<Eigen::Index>(states.size());
  const auto count = static_cast<Eigen::Index>(law_of(effect).coefficients(effect, robot).size());
  std::vector<UnitMotion> motions;
  for (Eigen::Index pose = 0; pose < poses; ++pose) {
    motions.clear();
    append_unit_motions(effect, robot, states[static_cast<std::size_t>(pose)], motions);
    for (const UnitMotion& motion : motions) {
      auto [features, fresh] =
          loose_[motion_column(motion.place, motion.axis)].try_emplace(columns_ + motion.coefficient);
      if (fresh) features->second.setZero(poses);
      features->second[pose] += motion.size;
    }
  }
  spans_.push_back({columns_, count});
  columns_ += count;
}

void EffectColumns::pack() {
  DEMECAL_CHECK(blocks_.empty(), "columns are packed once");
  for (auto& [motion, features] : loose_) {
    Block block{motion, {}, {}};
    block.features.resize(features.begin()->second.size(), static_cast<Eigen::Index>(features.size()));
    for (auto& [column, values] : features) {
      block.features.col(static_cast<Eigen::Index>(block.columns.size())) = values;
      block.columns.push_back(column);
      values.resize(0);
    }
    blocks_.push_back(std::move(block));
  }
  loose_.clear();
}

namespace {

/// The sum of what each block gives for its columns, of `columns` in all.
template <typename Blocks, typename Matrix>
Matrix summed(const Blocks& blocks, const std::vector<Matrix>& parts, Eigen::Index columns, Eigen::Index count) {
  Matrix sum = Matrix::Zero(columns, count);
  for (std::size_t block = 0; block < parts.size(); ++block) {
    for (std::size_t i = 0; i < blocks[block].columns.size(); ++i) {
      sum.row(blocks[block].columns[i]) += parts[block].row(static_cast<Eigen::Index>(i));
    }
  }
  return sum;
}

}  // namespace

Eigen::MatrixXd EffectColumns::transposed_times(const ResidualField& field, const RowMatrix& rows) const {
  DEMECAL_CHECK(rows.rows() == field.rows(), rows.rows() << " rows for " << field.rows());
  std::vector<Eigen::MatrixXd> parts(blocks_.size());
  in_pieces(parts.size(), [&](std::size_t i) {
    parts[i] = blocks_[i].features.transpose() * along_motion(field, blocks_[i].motion, rows);
  });
  return summed(blocks_, parts, columns_, rows.cols());
}

Eigen::MatrixXf EffectColumns::transposed_times(const ResidualField& field, const RowMatrixF& rows) const {
  DEMECAL_CHECK(rows.rows() == field.rows(), rows.rows() << " rows for " << field.rows());
  std::vector<Eigen::MatrixXf> parts(blocks_.size());
  in_pieces(parts.size(), [&](std::size_t i) {
    parts[i] = blocks_[i].features.cast<float>().transpose() * along_motion(field, blocks_[i].motion, rows);
  });
  return summed(blocks_, parts, columns_, rows.cols());
}

RowMatrix EffectColumns::dense(const ResidualField& field, std::size_t effect) const {
  const ColumnSpan span = spans_[effect];
  RowMatrix matrix = RowMatrix::Zero(field.rows(), span.count);
  for (const Block& block : blocks_) {
    auto at = std::lower_bound(block.columns.begin(), block.columns.end(), span.first);
    for (; at != block.columns.end() && *at < span.first + span.count; ++at) {
      const auto feature = block.features.col(at - block.columns.begin());
      for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
        const Eigen::Index first = field.first_row[pose], count = field.rows_of_pose(pose);
        matrix.block(first, *at - span.first, count, 1) +=
            feature[static_cast<Eigen::Index>(pose)] * field.motions.block(first, block.motion, count, 1);
      }
    }
  }
  leave_out_places(field, matrix);
  return matrix;
}

}  // namespace demecal::inline residuals
