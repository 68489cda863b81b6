// What each cause costs: a model with some of them left out, judged on poses that it has not seen.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "explanations/causes.hpp"
#include "explanations/explanation_front.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal::inline explanations {

/// One cause, and what its loss would cost.
struct CauseCost {
  ErrorCause cause;
  double without_mm = 0.0;  ///< rms tool error of the judging poses with its effects left out, else fitted to 1st order
  double with_mm = 0.0;     ///< the same of the whole model
  /// What it alone takes from the mean square, over the mean square without any cause; 0 to 1.
  double share = 0.0;
  /// 95 % of sqrt(without_mm^2 - with_mm^2) when the judging poses are drawn anew; 0 where that is negative.
  std::array<double, 2> interval_mm{};
};

/// One model of the front.
struct FrontPoint {
  std::size_t causes = 0;
  double validation_rms_mm = 0.0;
  std::optional<double> accept_rms_mm{};  ///< of the same effects in the last fit; none without accept poses
  bool chosen = false;                    ///< what the model holds
};

struct ErrorBudget {
  std::vector<CauseCost> causes;  ///< the costliest first
  std::vector<FrontPoint> front;  ///< from no cause to the most
};

/// `model` was fitted to problem.fitted; problem.validation judges (where there are none, the fitted poses do), all but
/// those in gross error (see gross_error_limit), to first order about the model. `last` is the same model fitted to
/// `last_fitted`. `front` is that of the model's effects: its chosen point is the model.
ErrorBudget error_budget(const DiagnosisProblem& problem, const DiagnosedModel& model, const ExplanationFront& front,
                         std::span<const std::size_t> last_fitted, const DiagnosedModel& last, RandomStream random);

}  // namespace demecal::inline explanations
