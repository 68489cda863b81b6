// How badly a formula fits, its amplitude free, and how many words it takes.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "expression/evaluate.hpp"
#include "expression/tree.hpp"
#include "fitness/fitness.hpp"
#include "products/tall_products.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline formula_search {

/// Formulas of one joint's error against one residual.
class FormulaMisfit {
 public:
  /// Against a table: the residual is target - amplitude * value, each row times the root of its weight.
  explicit FormulaMisfit(const TrainingTable& table);
  /// Against what a model leaves at the fitted poses: `variables` has one column each, one row a pose; a formula turns
  /// joint `joint` (from 0), and the model's own numbers give way to it. `residual` (rows of the field): what is left
  /// with the model's share taken off.
  FormulaMisfit(const std::vector<std::vector<double>>& variables, const Linearization& linearization, int joint,
                Eigen::VectorXd residual);

  /// The residual with the formula at its least-squares amplitude; empty where a value is not finite. What is believed
  /// of the model's numbers has no rows in it.
  Eigen::VectorXd residual(const Tree& tree);
  /// Negative log of the likelihood but for a constant, the scatter free too; infinite where a value is not finite.
  double nats(const Tree& tree);
  /// Rise of the likelihood by the formula, nats.
  double gain_nats(const Tree& tree);
  /// Of the table or of the fitted poses.
  std::size_t poses() const { return poses_; }
  int variables() const { return variables_; }

 private:
  void sum_by_pose();
  double nats_of(double squares) const;

  ColumnEvaluator evaluate_;
  int variables_;
  std::size_t poses_;
  std::vector<std::size_t> pose_of_row_;
  Eigen::VectorXd lever_;  ///< of a row: its change by a unit of the formula's value at its pose
  Eigen::VectorXd residual_;
  RowMatrix basis_;  ///< of the model's columns; none against a table
  // Sums over the rows of every pose: of squared levers, of levers times what is left, and times the basis.
  Eigen::VectorXd squares_, moments_;
  Eigen::MatrixXd along_;  ///< poses x rank
};

/// The length of a formula's description, nats: every node names one of the primitives and variables, every constant
/// that is not a whole or half number costs half the log of the number of poses.
double description_nats(const Tree& tree, int variables, std::size_t poses);

}  // namespace demecal::inline formula_search
