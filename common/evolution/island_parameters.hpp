// Heterogeneous islands: what an island's parameters are where those of a joint are to differ.
#pragma once

#include "evolution/archipelago.hpp"
#include "evolution/parameters.hpp"

namespace demecal {

/// Without a spread the parameters as they are. With one, the first island of a joint explores and the last one
/// exploits: from 1 + spread times to 1 - spread times the mutation rate, and the other way round the tournament size
/// and the shrink mutation rate, in equal steps between; each as far as its rules allow. An island alone has the mean.
GpParameters parameters_of(const GpParameters& parameters, const Archipelago& archipelago, std::uint32_t deme);

}  // namespace demecal
