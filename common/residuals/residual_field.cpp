#include "residuals/residual_field.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "decompositions/decompositions.hpp"
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
  return Cholesky(covariance).lower();
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
      if (scales[kind] > 0) used.emplace_back(row, scales.of(pose, kind));
    }
  }
  return used;
}

/// Makes room for the rows of every observation that measured something in use; these observations.
std::vector<const Observation*> reserve(ResidualField& field, const DataSet& data,
                                        const std::vector<Observation>& observations, const ParameterSpace& space,
                                        const RowScales& scales) {
  std::vector<const Observation*> in_use;
  field.first_row.push_back(0);
  for (const Observation& observation : observations) {
    const std::size_t count = rows_used(data.poses[observation.pose], scales).size();
    if (count == 0) continue;
    in_use.push_back(&observation);
    field.poses.push_back(observation.pose);
    field.first_row.push_back(field.first_row.back() + static_cast<Eigen::Index>(count));
  }
  const Eigen::Index rows = field.first_row.back();
  field.residual.resize(rows);
  field.declared.resize(rows, space.size());
  field.motions.resize(rows, 6 * (space.reference().chain.size() + 2));
  field.within.resize(in_use.size());
  field.root_weight.resize(in_use.size());
  field.states.assign(in_use.size(), ArmState{Stop(JointVector{}), {}, {}, {}, {}, {}, {}, {}});
  return in_use;
}

/// The real arm's places: the identified chain at the joints where it really stands.
std::vector<Eigen::Isometry3d> real_places(const CorrectedRobot& robot, const Observation& observation) {
  Robot real;
  real.chain = robot.chain;
  const JointVector moved = displacement(robot.chain, robot.effects, observation.motions).joints;
  return arm_state(real, Stop(observation.corrected + moved)).places;
}

/// Fills a field's rows, pose by pose.
class FieldRows {
 public:
  /// Keeps all but the noise by reference.
  FieldRows(const DataSet& data, const ParameterSpace& space, const ModelPoint& point, const RowScales& scales,
            const NoiseModel& noise, bool robust)
      : data_(data), space_(space), point_(point), scales_(scales), noise_(noise), robust_(robust) {}

  /// Those of the field's pose of this number, which `observation` is of.
  void fill(ResidualField& field, std::size_t number, const Observation& observation);

 private:
  double norm_in_deviations(const ResidualField& field, std::size_t number) const;

  const DataSet& data_;
  const ParameterSpace& space_;
  const ModelPoint& point_;
  const RowScales& scales_;
  const NoiseModel noise_;
  const bool robust_;
  ScaledRows rows_;
};

/// How far out the pose is: what poses share may be the larger part of it.
double FieldRows::norm_in_deviations(const ResidualField& field, std::size_t number) const {
  const Eigen::Index first = field.first_row[number], count = field.rows_of_pose(number);
  const double shared = noise_.repeats * noise_.repeats + noise_.order * noise_.order - noise_.fast;
  if (shared <= 0.0) return field.residual.segment(first, count).norm();
  const Eigen::MatrixXd& within = field.within[number];
  const Eigen::MatrixXd root = within.size() > 0 ? within : Eigen::MatrixXd::Identity(count, count);
  const Eigen::MatrixXd whole = root * root.transpose() + shared * Eigen::MatrixXd::Identity(count, count);
  return Cholesky(whole).whitened(rows_.residual).norm();
}

void FieldRows::fill(ResidualField& field, std::size_t number, const Observation& observation) {
  const MeasuredPose& pose = data_.poses[observation.pose];
  const CorrectedRobot& robot = space_.reference();
  scaled_rows(data_, space_, point_, observation, scales_, rows_);
  const Eigen::Index first = field.first_row[number], count = field.rows_of_pose(number);
  field.residual.segment(first, count) = rows_.residual;
  field.declared.middleRows(first, count) = -rows_.jacobian;
  const Stop stop(pose);
  const Eigen::Vector3d tool = rows_.motion.predicted.translation();
  const Twists twists = place_twists(real_places(robot, observation), robot.sensor_from_base, tool);
  const auto measured = measurement_jacobian(robot, rows_.motion.predicted, data_, pose);
  Eigen::Index at = first;
  for (const auto& [row, scale] : rows_used(pose, scales_))
    field.motions.row(at++).noalias() = (1.0 / scale) * measured.row(row) * twists;
  if (noise_.joint_rad > 0.0 || noise_.fast > 0.0) {
    field.within[number] = covariance_root(field, first, count, noise_);
    whiten(field, first, count, field.within[number]);
  }
  const double weight = robust_ ? root_weight_of(norm_in_deviations(field, number), static_cast<int>(count)) : 1.0;
  field.residual.segment(first, count) *= weight;
  field.declared.middleRows(first, count) *= weight;
  field.motions.middleRows(first, count) *= weight;
  field.root_weight[number] = weight;
  field.states[number] = arm_state(data_.robot, stop);
  field.states[number].tool_in_sensor_m = tool;
}

}  // namespace

RowMatrix beside(RowMatrix left, const RowMatrix& right) {
  if (right.cols() == 0) return left;
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
  constexpr std::size_t kPosesOfPiece = 100;
  const std::vector<Observation> observations = observe(data, poses, space.reference());
  ResidualField field;
  const std::vector<const Observation*> in_use = reserve(field, data, observations, space, scales);
  field.scattering = turns_of(data.robot.chain);
  const ModelPoint point = space.at(Eigen::VectorXd::Zero(space.size()));
  in_pieces((in_use.size() + kPosesOfPiece - 1) / kPosesOfPiece, [&](std::size_t piece) {
    FieldRows rows(data, space, point, scales, noise, robust);
    const std::size_t end = std::min((piece + 1) * kPosesOfPiece, in_use.size());
    for (std::size_t pose = piece * kPosesOfPiece; pose < end; ++pose) rows.fill(field, pose, *in_use[pose]);
  });
  find_repeats(data, field);
  return field;
}

}  // namespace demecal::inline residuals
