// An elbow arm with a wrist, as controllers of most makers have it.
#pragma once

#include <numbers>

#include "kinematics/chain.hpp"

namespace demecal {

/// A 6-joint elbow arm with offsets everywhere.
inline Chain elbow() {
  constexpr double kQuarterTurn = std::numbers::pi / 2;
  const auto link = [](double alpha_rad, double a_m, double d_m) {
    Joint joint;
    joint.alpha_rad = alpha_rad;
    joint.a_m = a_m;
    joint.d_m = d_m;
    joint.lower = -2.6;
    joint.upper = 2.6;
    return joint;
  };
  return {Convention::standard_dh,
          {link(-kQuarterTurn, 0.15, 0.48), link(0, 0.6, 0), link(-kQuarterTurn, 0.12, 0), link(kQuarterTurn, 0, 0.64),
           link(-kQuarterTurn, 0, 0), link(0, 0, 0.2)},
          {0.04, 0.01, 0.12}};
}

}  // namespace demecal
