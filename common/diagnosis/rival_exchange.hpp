// Rivals that the fitted poses hardly tell apart, told by all poses that may have a part in the choice.
#pragma once

#include <cstddef>
#include <vector>

#include "effect_sets/fitted_set.hpp"
#include "explanations/set_models.hpp"
#include "next_measurement/next_measurement.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal::inline diagnosis {

/// As rivals_of() says of the effect at that place of the set, among the effects that were searched.
std::vector<Rival> rivals_beside(const FittedSet& set, std::size_t place, const std::vector<PricedEffect>& effects);

/// The set with effects exchanged for their rivals, one after another, and without what is then not worth its price,
/// for as long as that describes the fitted and the validation poses together more shortly: to first order about the
/// model of the set that is refined over them. `models` are of problem.fitted, `effects` theirs; the set as it is where
/// there are no validation poses.
std::vector<std::size_t> with_better_rivals(const DiagnosisProblem& problem, const SetModels& models,
                                            const std::vector<PricedEffect>& effects, std::vector<std::size_t> set);

}  // namespace demecal::inline diagnosis
