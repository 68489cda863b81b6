// Waves over a joint's turn: what gears and encoders do beside effects with names, as sums of cosines and sines.
#pragma once

namespace demecal::inline updating {

/// Cycles a turn: gears' errors are slower than 1 in 10 deg.
inline constexpr int kHighestWave = 32;

/// Shares of a joint's variance that its waves of n cycles have, cosine and sine alike; they add up to one over n.
double wave_share(int n);

}  // namespace demecal::inline updating
