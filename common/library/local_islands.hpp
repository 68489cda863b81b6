// Evolution of joint corrections on islands in this process, epoch by epoch, with the bits that workers would reach.
#pragma once

#include <vector>

#include "calibration/job.hpp"
#include "calibration/round_terms.hpp"
#include "calibration/selection.hpp"

namespace demecal {

/// The candidates that the islands of every training end with. A function of the first three: `threads` changes the
/// time alone.
std::vector<JointCandidates> evolve_locally(const Job& job, const std::vector<JointTraining>& trainings,
                                            const RoundTerms& terms, unsigned threads);

}  // namespace demecal
