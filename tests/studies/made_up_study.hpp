// A study as it would stand on a six-joint arm, with figures made up from a literal seed.
#pragma once

#include "random/random_stream.hpp"
#include "studies/study.hpp"

namespace demecal {

/// Two cells with the first `seeds` seeds.
inline Study made_up_study(std::size_t seeds) {
  RandomStream random({81});
  Study study;
  study.job = "demo";
  study.robot = "PUMA 761";
  study.keys = {"gp.population_size", "gp.constants_range"};
  study.cells = {{"100", "[0, 1]"}, {"300", "[-1, 1]"}};
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    study.seeds.push_back(seed);
    for (std::size_t cell = 0; cell < 2; ++cell) {
      StudyRun run;
      run.cell = cell;
      run.seed = seed;
      run.calibration_mm = random.real(0.1, 0.2);
      run.validation_mm = random.real(0.2, 0.3);
      run.nodes = 20 + random.index(30);
      run.corrected = 5;
      run.evaluations = 40000 + random.index(1000);
      run.wall_s = random.real(1.0, 2.0);
      study.runs.push_back(run);
    }
  }
  return study;
}

}  // namespace demecal
