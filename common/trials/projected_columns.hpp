// What more could explain the errors of a trial than base, tools and links: columns of coordinates, less what these can
// take of them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "kinematics/chain.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline trials {

/// Columns have three coordinates for each row of the trial, m. Rows that are far off a fit with links count less.
class ProjectedColumns {
 public:
  ProjectedColumns(const Trial& trial, const TrialFit& fit);

  /// b' W e of the parts that base, tools and links leave, for each column b and the errors e.
  Eigen::VectorXd with_error(const Eigen::MatrixXd& columns) const;
  /// b' W c of the same, for all pairs of columns.
  Eigen::MatrixXd with_itself(const Eigen::MatrixXd& columns) const;
  /// Both of a single column that is zero in all rows before `first`, without those rows.
  struct Products {
    double with_error = 0.0, with_itself = 0.0;
  };
  Products of_column(const Eigen::VectorXd& column, std::size_t first) const;
  /// Log likelihood, in nats, that the columns gain together.
  double gain(const Eigen::MatrixXd& columns) const;
  /// What `columns` gain beside `others`, from which they may hardly differ.
  double gain_beyond(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& others) const;
  /// The columns' least-squares coefficients.
  Eigen::VectorXd coefficients(const Eigen::MatrixXd& columns) const;

 private:
  LinearizedTrial linear_;
  Eigen::VectorXd weights_, weighted_error_;
  Eigen::VectorXd taken_;  ///< by base, tools and links of the errors, weighted
  Eigen::MatrixXd weighted_;
  PivotedCholesky factor_;
};

/// How points move with one joint, three coordinates a row, m per rad or m.
Eigen::VectorXd joint_column(const Trial& trial, const TrialFit& fit, int joint);

/// Those of all joints, each row's times `factor` of the row and joint.
template <typename Factor>
Eigen::MatrixXd joint_columns(const Trial& trial, const TrialFit& fit, const Factor& factor) {
  Eigen::MatrixXd columns(3 * static_cast<Eigen::Index>(trial.rows.size()), trial.chain.size());
  for (int joint = 0; joint < trial.chain.size(); ++joint) {
    columns.col(joint) = joint_column(trial, fit, joint);
    for (Eigen::Index i = 0; i < columns.rows(); ++i)
      columns(i, joint) *= factor(static_cast<std::size_t>(i / 3), joint);
  }
  return columns;
}

/// How points move with errors of joints that differ by what the file states of a row: each joint's column times its
/// side of approach, the payload and the temperature, as far as rows differ in them. Sides that change in the course of
/// a measurement show lost motion as the zero of a joint, and payloads show elasticity so.
Eigen::MatrixXd condition_columns(const Trial& trial, const TrialFit& fit);

/// How far a joint may be turned by such conditions, rad, as far as rows differ in them: 3 mrad by lost motion, 40
/// microrad per Nm of the heaviest payload at full reach, 0.1 mrad per kelvin.
double most_by_conditions(const Trial& trial);

/// Nats that something systematic must gain, for each row of a pose.
inline constexpr double kNotableGain = 20.0;

}  // namespace demecal::inline trials
