// Models with any of some effects, to first order about one that was fitted: what sets of them explain is a matter of
// small matrices, whatever the number of poses.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "effect_sets/fitted_set.hpp"
#include "effects/effect.hpp"
#include "products/tall_products.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline explanations {

/// An effect that a model may have.
struct PricedEffect {
  Effect effect;
  double naming_cost_nats = 0.0;  ///< the price of naming it: log of the number of its like
};

class SetModels {
 public:
  /// About `model` at its least-squares values over problem.fitted. Of its effects those among `effects` may be left
  /// out; others stay.
  SetModels(const DiagnosisProblem& problem, const DiagnosedModel& model, const std::vector<PricedEffect>& effects);

  /// What sets of the effects explain, in their order.
  const ExplanationProblem& problem() const { return problem_; }
  /// The places of those that the model holds.
  const std::vector<std::size_t>& held() const { return held_; }
  /// The model with those at `set` and none of the others: all numbers where the fitted poses then want them.
  DiagnosedModel with(const std::vector<std::size_t>& set) const;

 private:
  void project(const RowMatrix& columns, const std::vector<ColumnSpan>& spans, const Eigen::VectorXd& precision);

  DiagnosedModel bare_;         ///< without any of the effects, its numbers those of the whole model
  std::vector<bool> left_out_;  ///< of the effects that `bare_` still lists
  std::vector<Effect> effects_;
  std::vector<std::size_t> held_;
  Linearization linearization_;
  ExplanationProblem problem_;
  std::vector<Eigen::MatrixXd> to_coefficients_;  ///< per effect: coefficients x columns of the problem
  Eigen::MatrixXd along_;                         ///< X^T basis of the problem's columns X
};

}  // namespace demecal::inline explanations
