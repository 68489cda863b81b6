// The model while it is being diagnosed: everything declared, smooth corrections and the effects added so far.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "data/data_set.hpp"
#include "fitting/fit.hpp"
#include "fitting/least_squares.hpp"
#include "fitting/station_scales.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "prediction/corrected_robot.hpp"
#include "products/tall_products.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"
#include "residuals/smooth_corrections.hpp"

namespace demecal::inline residuals {

/// One value of all the numbers of the model, and how measurements scatter about it.
struct DiagnosedModel {
  CorrectedRobot robot;  ///< with its effects; corrections are those of `smooth`
  SmoothCorrections smooth;
  RowScales scales{};
  NoiseModel noise{};            ///< beyond independent noise of these scales
  bool noise_estimated = false;  ///< together with the scales, which then stay; stations still settle among each other
  Eigen::VectorXd precision{};   ///< of the smooth terms, where they are to stay as they were chosen; else empty
  /// Per joint the limit of its correction for which `precision` was raised, or 0; empty: of none.
  std::vector<double> held_rad{};
};

/// The model's surroundings to first order: fields over the fitted and the validation poses, and the residual with all
/// of the model's numbers at their least-squares values.
struct Linearization {
  std::vector<ParameterId> ids;
  ResidualField fitted, validation;
  Projection projection;
  Eigen::VectorXd changes;     ///< least-squares steps of `ids`, then of the smooth terms
  Eigen::MatrixXd covariance;  ///< of the same numbers, in rows of unit variance
  Eigen::VectorXd precision;   ///< believed of the same numbers
  Eigen::VectorXd errors;      ///< of the fitted rows, after `changes`: what the projection leaves and what poses share
};

/// What stays the same from step to step.
struct DiagnosisProblem {
  const DataSet& data;
  DeclaredModel declared;
  std::vector<std::size_t> fitted, validation;  ///< poses
};

/// What a diagnosis begins with: the fitted model, its corrections the base of smooth terms where they are declared.
DiagnosedModel diagnosed_model(const DiagnosisProblem& problem, const Fit& start);

/// Rows of a field as they were before those of one pose were made independent.
RowMatrix unwhitened(const ResidualField& field, RowMatrix rows);

/// One over the standard deviation with which each coefficient of each effect is believed to be zero: that of a motion
/// of the arm by a few thousandths (rad, m) at the states, or a thousand of them. It keeps those apart from running
/// away that these poses hardly tell from one another, and vanishes beside what the poses do show. A coefficient that
/// does nothing at these states is believed to be no larger than a million times what its effect's others are.
std::vector<std::vector<double>> precisions_of(const std::vector<Effect>& effects, const Robot& described,
                                               const std::vector<ArmState>& states);

/// Linearizes at `model`. What poses share by its noise is fitted beside it and then forgotten: with that the rows left
/// are independent. Smooth terms are believed to be near zero by automatic relevance determination, links to be
/// near their maker's figures.
Linearization linearize(const DiagnosisProblem& problem, const DiagnosedModel& model);

/// The same without some of the model's effects (`left_out`: one flag each): they are no numbers of the model any more,
/// and what they explain is part of the residual.
Linearization linearize_without(const DiagnosisProblem& problem, const DiagnosedModel& model,
                                const std::vector<bool>& left_out);

/// The model at its least-squares values: Gauss and Newton's steps, far poses down-weighted and the scales of the kinds
/// of rows taken from what is left, until neither changes; at most `steps`. Effects get standard errors.
DiagnosedModel refined(const DiagnosisProblem& problem, DiagnosedModel model, int steps);

}  // namespace demecal::inline residuals
