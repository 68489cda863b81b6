// What the mean and spread of five robots of a type are worth to the sixth, in poses.
#pragma once

namespace demecal::bench {

/// Prints the error of the sixth with the fleet as its prior over that of twice as many poses by themselves.
void bench_fleets(int seeds, bool json);

}  // namespace demecal::bench
