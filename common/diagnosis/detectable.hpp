// How small an effect these poses could still have shown.
#pragma once

#include <vector>

#include "diagnosis/candidates.hpp"
#include "diagnosis/diagnosed_model.hpp"
#include "diagnosis/effect_columns.hpp"
#include "diagnosis/outcome.hpp"
#include "diagnosis/scan.hpp"

namespace demecal {

/// What detecting depends on.
struct Detection {
  const std::vector<double>& null_maxima;  ///< of the scan, ascending
  double family_error = 0.05;
  double variance = 1.0;  ///< of the residual rows, in rows of unit variance
  std::size_t poses = 0;
};

/// Per kind and joint of the candidates that the model does not hold: the amplitude of its least visible form that is
/// found with power 0.9 at the family-wise level. Kinds of which nothing is visible beyond the model are left out.
std::vector<NotFound> smallest_detectable(const std::vector<Candidate>& candidates, const std::vector<Score>& scores,
                                          const CorrectedRobot& model, const Robot& robot, const Detection& detection);

/// What a loop ended with.
struct EndedLoop {
  const Robot& robot;
  const CorrectedRobot& model;
  const Linearised& at;  ///< the model
  const std::vector<Candidate>& candidates;
  const EffectColumns& columns;  ///< of the candidates
  const std::vector<Round>& rounds;
};
struct BoundOptions {
  double family_error = 0.05;
  int permutations = 999;
};

/// smallest_detectable() of the candidates at a loop's end. What was refused as implausibly large is in the data all
/// the same: it is set aside first, `null_maxima` then being permuted anew, and has no bound. Effects that would have
/// to be larger than is plausible of their kind are marked as not testable.
std::vector<NotFound> not_found_beyond(const EndedLoop& loop, const std::vector<double>& null_maxima,
                                       const BoundOptions& options, RandomStream random);

}  // namespace demecal
