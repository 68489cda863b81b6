// A stop of given joints at any circumstances but the time, which exported formulas do not know.
#pragma once

#include "prediction/random_effects.hpp"

namespace demecal {

inline Stop stop_at(RandomStream& stream, const Chain& chain, const JointVector& joints) {
  Stop stop = random_stop(stream, chain).with_joints(joints);
  stop.time_s.reset();
  return stop;
}

}  // namespace demecal
