// The benchmark of evolution: what evolution leaves is never behind what is left without it.
#include <gtest/gtest.h>

#include <optional>

#include "data_files/robot_file.hpp"
#include "evolution/evolution_case.hpp"

namespace demecal::bench {
namespace {

TEST(BenchOfEvolution, EndsBehindItsAbsenceOnNoArm) {
  // On this one the backward step takes back what evolution chose in place of another effect.
  const auto arm =
      run_simulated(20, varied_mixture(20), load_robot(DEMECAL_SOURCE_DIR "/configs/robots/elbow-offset.yaml"));
  ASSERT_TRUE(arm);
  EXPECT_LE(arm->with.validation_mm, 1.02 * arm->without.validation_mm);
  EXPECT_LE(arm->with.missed.size(), arm->without.missed.size());
}

}  // namespace
}  // namespace demecal::bench
