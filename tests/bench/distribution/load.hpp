// The runs that the benchmark distributes: of the thesis's size, and of islands that sleep instead of breeding.
#pragma once

#include "protocol/messages.hpp"

namespace demecal::bench {

/// Six joints with `demes` islands each, Table 6-1's parameters, 30 rows a joint: y = 3 sin t + 1.2 cos 2t - 0.8 t in
/// units of the table's scale, and noise.
CalibrationData thesis_run(std::uint32_t demes, std::uint64_t seed, int generations = 200);

/// `islands` islands, eight a joint, an epoch a generation, messages of the thesis's size. Each feeds one of the next
/// joint.
CalibrationData sleeping_run(std::uint32_t islands, std::uint32_t epochs, std::uint64_t seed);

}  // namespace demecal::bench
