// How few causes do: the best set of effects for every number of causes, judged on poses that it has not seen.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "data/data_set.hpp"
#include "explanations/explanation_search.hpp"
#include "explanations/set_models.hpp"
#include "prediction/corrected_robot.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal::inline explanations {

/// The most causes that a person reads through.
inline constexpr std::size_t kReadableCauses = 12;

using SquaredErrors_mm2 = std::vector<double>;  ///< of the tool, one per pose
SquaredErrors_mm2 squared_errors(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot);

/// The poses on which models are judged: those with a tool error that is not gross by `robot`.
std::vector<std::size_t> judging_poses(const DiagnosisProblem& problem, const CorrectedRobot& robot);

/// All effects of a model, at no price.
std::vector<PricedEffect> effects_of(const DiagnosedModel& model);

/// The best set of effects for every number of causes, and the one that is chosen.
struct ExplanationFront {
  std::vector<PricedEffect> effects;  ///< of any of the sets
  struct Point {
    std::vector<std::size_t> set;  ///< places among `effects`
    std::size_t causes = 0;
    double validation_rms_mm = 0.0;
    std::optional<DiagnosedModel> refined{};  ///< the set's model at its least-squares values, where it was needed
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
/// error is at most 1.05 times the least; models that are but a quarter behind are refined before. Not none where
/// `model` has causes and the next set errs less: that there is a cause the loop's tests have said, and what is left to
/// choose is how many.
ExplanationFront judged_front(const DiagnosisProblem& problem, const DiagnosedModel& model, const SetModels& models,
                              std::vector<PricedEffect> effects, const std::vector<EffectSet>& sets);

/// Whether the model errs at problem.validation no more than the rule of judged_front() allows beside another one.
bool does_as_well(const DiagnosisProblem& problem, const DiagnosedModel& model, const DiagnosedModel& other);

/// The model of one of the front's sets at its least-squares values.
DiagnosedModel model_of(const DiagnosisProblem& problem, const SetModels& models, const ExplanationFront::Point& point);

/// Chooses a set that does better than the chosen one. It takes the place of a set of as many causes; one of fewer or
/// more stays beside it.
void choose_set(const DiagnosisProblem& problem, const DiagnosedModel& model, const SetModels& models,
                std::vector<std::size_t> set, ExplanationFront& front);

/// Makes `model`, fitted to problem.fitted, the chosen point of the front, whatever was chosen before.
void choose(const DiagnosisProblem& problem, const DiagnosedModel& model, ExplanationFront& front);

/// The front of `model` and of what is left of it without the causes that are missed least, one after another; the
/// whole model is chosen.
ExplanationFront pruned_front(const DiagnosisProblem& problem, const DiagnosedModel& model);

}  // namespace demecal::inline explanations
