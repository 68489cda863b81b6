// Two methods side by side, of which one has no figures.
#pragma once

#include "report/evaluation.hpp"

namespace demecal {

inline Comparison two_methods() {
  const SetErrors validation{5.25, 6.0, 7.0, 8.0};
  return {"job",
          "arm",
          "poses",
          "ab12",
          {30, 20, 0},
          {{"fourier_1",
            "Fourier series, order 1 (Everett, Vincze)",
            81,
            0.5,
            "ridge 1e-05",
            {{1.0, 2.0, 3.0, 4.0}, validation, {}}},
           {"radial_basis", "radial-basis network on the position", 0, 0.0, "no positions", {}}}};
}

}  // namespace demecal
