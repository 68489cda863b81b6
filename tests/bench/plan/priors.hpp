// What an old model of a robot is worth to few new poses of it, measured on the shared UR10.
#pragma once

#include <string>

namespace demecal::bench {

struct PriorOptions {
  std::string model;  ///< file of the old model; empty: series A is diagnosed first, without evolution
  int draws = 5;      ///< of poses, for each number of them
  int first_draw = 1;
  bool drift = false;  ///< instead, series C after a model of B alone and with that of A, which tells the robot's drift
  bool stations = false;  ///< instead, series C after a model of A and B as stations of one calibration
  bool json = false;
};

/// Prints the rms error on accept poses of series B and C after an update by poses drawn from them, and with base and
/// tool alone fitted to these. False, with a sentence on standard error, where the measurements are not there.
bool bench_priors(const PriorOptions& options);

}  // namespace demecal::bench
