// What each cause costs, and how few causes would do: a model with some of them left out, judged on poses that it has
// not seen.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "explanations/causes.hpp"
#include "explanations/explanation_search.hpp"
#include "explanations/set_models.hpp"
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

/// The best set of effects for every number of causes, and the one that is chosen.
struct ExplanationFront {
  std::vector<PricedEffect> effects;  ///< of any of the sets
  struct Point {
    std::vector<std::size_t> set;  ///< places among `effects`
    std::size_t causes = 0;
    double validation_rms_mm = 0.0;
  };
  std::vector<Point> points;  ///< by number of causes, from none
  std::size_t chosen = 0;     ///< among `points`: the fewest causes that do as well, see judged_front()
  std::size_t best = 0;       ///< the smallest error
};

/// Judges sets of the effects by the errors they leave at problem.validation (where there are no such poses at those
/// that were fitted, and the most causes are chosen), poses in gross error by `model` left out: a model of every set to
/// first order about `model`. `sets` are by number of causes, from none; of several of a number the one of the least
/// error stands for it (without poses that judge the last), unless what a set of one cause more is without one of its
/// causes errs far less (0.8 times). Of them the one of the fewest causes is chosen whose error is at most 1.02 times
/// the least and whose mean square is within one standard error of it (paired), or that of ten causes or more whose
/// error is at most 1.05 times the least. Not none where `model` has causes and the next set errs less: that there is a
/// cause the loop's tests have said, and what is left to choose is how many.
ExplanationFront judged_front(const DiagnosisProblem& problem, const DiagnosedModel& model, const SetModels& models,
                              std::vector<PricedEffect> effects, const std::vector<EffectSet>& sets);

/// Whether the model errs at problem.validation no more than the rule of judged_front() allows beside another one.
bool does_as_well(const DiagnosisProblem& problem, const DiagnosedModel& model, const DiagnosedModel& other);

/// Makes `model`, fitted to problem.fitted, the chosen point of the front, whatever was chosen before.
void choose(const DiagnosisProblem& problem, const DiagnosedModel& model, ExplanationFront& front);

/// The front of `model` and of what is left of it without the causes that are missed least, one after another; the
/// whole model is chosen.
ExplanationFront pruned_front(const DiagnosisProblem& problem, const DiagnosedModel& model);

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
