// Arms measured in every circumstance, and the linear surroundings of their models.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "effects/laden_arm.hpp"
#include "fitting/known_arm.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"

namespace demecal {

inline constexpr RowScales kScales{5e-5, 1e-4, 5e-5};
inline constexpr DeclaredModel kPlacedAndZeroed{.registration = true, .tool = true, .joint_offset = true};

/// An arm with weight, without poses, whose truth stands anywhere.
inline KnownArm arm_of(RandomStream& stream, const Robot& robot) {
  KnownArm arm = perfect_arm(robot.chain, Frame::sensor);
  arm.data.robot = robot;
  arm.truth = nominal_robot(arm.data);
  arm.truth.sensor_from_base = far_pose(stream);
  return arm;
}

inline void measure_anyhow(KnownArm& arm, RandomStream& stream, const Instrument& instrument, int poses) {
  for (int i = 0; i < poses; ++i) measure(arm, stream, instrument, random_stop(stream, arm.data.robot));
}

inline RowMatrix random_matrix(RandomStream& stream, Eigen::Index rows, Eigen::Index columns) {
  RowMatrix matrix(rows, columns);
  for (double& value : matrix.reshaped()) value = stream.normal();
  return matrix;
}

inline ParameterSpace space_of(const KnownArm& arm, const CorrectedRobot& robot, const DeclaredModel& declared) {
  std::vector<ParameterId> ids = free_parameters(arm.data, declared);
  for (ParameterId& id : effect_parameters(robot)) ids.push_back(std::move(id));
  return {robot, ids};
}

/// The true robot's field over all poses.
inline ResidualField field_of(const KnownArm& arm, const DeclaredModel& declared, const RowScales& scales = kScales) {
  return residual_field(arm.data, all_poses(arm.data), space_of(arm, arm.truth, declared), scales, false);
}

/// The projection off the field's declared columns, nothing believed of them, validated by the same rows.
inline Projection projection_of(const ResidualField& field) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(field.declared.cols());
  return {{field.declared, field.declared, none, none}, field.residual, field.residual};
}

inline EffectColumns columns_of(const std::vector<Effect>& effects, const Robot& robot, const ResidualField& field) {
  EffectColumns columns;
  columns.append(effects, robot, field.states);
  columns.pack();
  return columns;
}

/// Fresh noise of unit variance in place of the residual.
inline void renew_noise(ResidualField& field, RandomStream& stream) {
  for (double& value : field.residual) value = stream.normal();
}

}  // namespace demecal
