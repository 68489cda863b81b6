// How small an effect these poses could still have shown.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "data/data_set.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/outcome.hpp"
#include "diagnosis/scan.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/residual_field.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline diagnosis {

/// A candidate, and how it shows beyond the model.
struct DetectableCandidate {
  const Candidate& candidate;
  Score score;
  /// Its square over the validation poses, in units of how these scatter, over that of the fitted poses; nothing where
  /// there are no validation poses.
  std::optional<double> validation_ratio{};
  /// Per coefficient: of the squared length of its column beyond the model, what single terms of the joints' smooth
  /// corrections could absorb, the one that absorbs most first; empty: there are none.
  std::vector<std::vector<double>> absorbed{};
};

/// What detecting any candidate depends on.
struct Detection {
  const std::vector<double>& null_maxima;  ///< of the scan, ascending
  double family_error = 0.05;
  double variance = 1.0;  ///< of the residual rows, in rows of unit variance
  std::size_t poses = 0;
};

/// Per kind and joint of the candidates that the model does not hold: the amplitude that is found, at the family-wise
/// level, and confirmed by the validation poses with power 0.9, on average over the settings and the coefficients of
/// one form; infinite where joint corrections could absorb too much. A gear's slow harmonics do not count: they are
/// joint corrections. Kinds of which nothing is visible beyond the model are left out.
std::vector<NotFound> smallest_detectable(const std::vector<DetectableCandidate>& candidates,
                                          const CorrectedRobot& model, const Robot& robot, const Detection& detection);

/// An effect that was found and taken back is not below a limit that it exceeds: by its coefficients of the limit's
/// unit.
void raise_to_what_was_found(const std::vector<Effect>& taken_back, const Robot& robot,
                             std::vector<NotFound>& not_found);

/// What a loop ended with.
struct FinishedLoop {
  const Robot& robot;
  const DiagnosedModel& model;
  const Linearization& linearization;  ///< the model
  const std::vector<Candidate>& candidates;
  const EffectColumns& columns;  ///< of the candidates
  const Scan& scan;              ///< of the same beyond the model
  const std::vector<Round>& rounds;
};
struct BoundOptions {
  double family_error = 0.05;
  int null_draws = 999;
  DoWork do_work = demecal::do_work;
};

/// smallest_detectable() of the candidates at a loop's end, beside what the joints' smooth corrections could absorb
/// of them: what is there to be seen may call for terms that the poses do not call for now. What was refused as
/// implausibly large is in the data all the same: it is set aside first, `null_maxima` then being permuted anew, and
/// has no bound. Effects that would have to be larger than is plausible of their kind are marked as not testable. Kinds
/// of which nothing is visible beyond the model, and none is in it, join the outcome's untestable ones.
void find_limits(const FinishedLoop& loop, const std::vector<double>& null_maxima, const BoundOptions& options,
                 RandomStream random, LoopOutcome& outcome);

}  // namespace demecal::inline diagnosis
