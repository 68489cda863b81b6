// What each cause costs, and how few causes would do: a model with some of them left out, judged on poses that it has
// not seen.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "explanations/causes.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal::inline explanations {

/// A model to first order about its least-squares values: with some of its effects left out, all other numbers are
/// where the fitted poses then want them.
class ReducedModels {
 public:
  ReducedModels(const DiagnosisProblem& problem, const DiagnosedModel& model);

  /// By how much the weighted sum of squares of the fitted poses rises without these of the robot's effects (Wald).
  double rise(std::span<const std::size_t> effects) const;
  /// The robot without them.
  CorrectedRobot without(std::span<const std::size_t> effects) const;

 private:
  std::vector<Eigen::Index> columns_of(std::span<const std::size_t> effects) const;
  struct WaldTerms {
    Eigen::VectorXd values;    ///< of those columns' coefficients, at least squares
    Eigen::VectorXd weighted;  ///< the inverse of their covariance times these
  };
  WaldTerms wald_terms(const std::vector<Eigen::Index>& columns) const;

  DiagnosedModel model_;
  Linearization linearization_;
};

/// One cause, and what its loss would cost.
struct CauseCost {
  ErrorCause cause;
  double without_mm = 0.0;  ///< rms tool error of the judging poses with its effects left out and all else fitted again
  double with_mm = 0.0;     ///< the same of the whole model
  /// What it alone takes from the mean square, over the mean square without any cause.
  double share = 0.0;
  /// 95 % of sqrt(without_mm^2 - with_mm^2) when the judging poses are drawn anew; 0 where that is negative.
  std::array<double, 2> interval_mm{};
};

/// The best model of a number of causes.
struct FrontPoint {
  std::vector<std::size_t> causes;  ///< places in the model's causes_of(), ascending
  double validation_rms_mm = 0.0;
  std::optional<double> accept_rms_mm{};  ///< of the same causes in the last fit; none without accept poses
  bool chosen = false;                    ///< what the model holds
};

struct ErrorBudget {
  std::vector<CauseCost> causes;  ///< the costliest first
  std::vector<FrontPoint> front;  ///< from no cause to all
};

/// `model` was fitted to problem.fitted; problem.validation judges (where there are none, the fitted poses do), all but
/// those in gross error. `last` is the same model fitted to `last_fitted`. Of every number of causes those
/// are kept without which the fitted poses' sum of squares rises most: by leaving out one after another, and then by
/// exchanges as long as these gain. Poses in gross error (see gross_error_limit) do not judge.
ErrorBudget error_budget(const DiagnosisProblem& problem, const DiagnosedModel& model,
                         std::span<const std::size_t> last_fitted, const DiagnosedModel& last, RandomStream random);

}  // namespace demecal::inline explanations
