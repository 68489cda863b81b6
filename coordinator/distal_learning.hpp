// Joint corrections from the error of the whole model, learnt with a calibration's evolutions or in this process.
#pragma once

#include <optional>

#include "calibration/distal_rounds.hpp"
#include "coordinator/evolutions.hpp"

namespace demecal {

/// Learns by distal supervision (thesis 4.3, 4.4) in the form that the job asks for, from where `preparation` stands,
/// over its targets' poses. `evolutions` says how the learning ended: what comes out is what was reached. `known` are
/// the functions that the joints share; without any list, those that it finds, where the job asks for any.
DistalOutcome learn_distally(const DataSet& data, const Job& job, const Preparation& preparation,
                             Evolutions& evolutions, const KnownFunctions& known = std::nullopt);

}  // namespace demecal
