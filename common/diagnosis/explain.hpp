// From effects added one after another to an explanation: evolution looks for better sets of them, and the fewest
// causes are chosen that do as well on the validation poses.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "diagnosis/candidates.hpp"
#include "diagnosis/group.hpp"
#include "diagnosis/outcome.hpp"
#include "effect_sets/set_island.hpp"
#include "explanations/explanation_front.hpp"
#include "explanations/explanation_search.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline diagnosis {

/// What the loop knows when nothing more can be added.
struct LoopEnd {
  const DiagnosisProblem& problem;
  const DiagnosedModel& model;
  const Linearization& linearization;
  const std::vector<Candidate>& candidates;
  const EffectColumns& columns;  ///< the candidates'
  const std::vector<Round>& rounds;
  std::vector<double>& null_maxima;  ///< the latest null distribution
  GroupRules rules;                  ///< by which effects that the model lacks are judged
  const SearchExplanations& search_explanations;
};

struct Explained {
  ExplanationFront front;
  DiagnosedModel model;                ///< the chosen one, at its least-squares values
  std::optional<DiagnosedModel> best;  ///< that of the least error, where it is another one
  std::vector<Round> rounds;           ///< in which effects that the loop had not added were judged
  bool stopped = false;                ///< by the watcher
};

/// One round for each effect of `model` (at its least-squares values) that end.model lacks, each judged beside all
/// others, since together they may explain what one after another cannot: it must gain more than noise alone gives
/// the best candidate, keep its sign when poses are drawn anew, and be no larger than a real arm's. What the validation
/// poses say of it is noted: it is the whole model that they judge. Rounds have no rivals yet.
std::vector<Round> judged_together(const LoopEnd& end, const DiagnosedModel& model);

/// The front of sets of effects about the model, and the model that is chosen from it. `search`: without variations
/// only what is left of the model without some of its causes. A set that evolution found stands in the place of one of
/// these where it is shorter by as much as tells rivals apart and errs less on the validation poses; sets that fewer
/// causes describe as well are no part of the front. Effects that are new are judged together; where the model is
/// behind the present one on the validation poses without those that fail, evolution's sets are not used.
Explained explained(const LoopEnd& end, const ExplanationSearch& search, const RandomStream& random,
                    const std::function<bool(const Round&)>& watch);

}  // namespace demecal::inline diagnosis
