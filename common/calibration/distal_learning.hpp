// Joint corrections from the error of the whole model, learnt by an evolver's islands or in this process.
#pragma once

#include "calibration/calibration.hpp"
#include "calibration/distal_steps.hpp"
#include "calibration/evolver.hpp"

namespace demecal {

/// Learns by distal supervision (thesis 4.3, 4.4) in the form that the job asks for, from where `preparation` stands,
/// over its targets' poses. What comes out is what was reached. `known` are the functions that the joints share;
/// without any list, those that it finds, where the job asks for any.
DistalOutcome learn_distally(const DataSet& data, const Job& job, const Preparation& preparation, Evolver& evolver,
                             const KnownFunctions& known = std::nullopt);

}  // namespace demecal
