// Rivals of an effect are other effects.
#include <gtest/gtest.h>

#include "simulated_arm.hpp"

namespace demecal {
namespace {

TEST(Rivals, NeverHoldTheEffectItselfInAnotherForm) {
  std::size_t rivals = 0;
  for (const std::uint64_t seed : {81, 82}) {
    Scenario scenario = perfect_scenario(parallel_arm(), seed);
    scenario.compliance = {{1, 2e-5}};
    scenario.couplings = {{.joint = 2, .from = 1, .per_rad = 4e-4}};
    const DataSet data = simulate(scenario);
    for (const Round& round : run_loop(data, kZeroed, quick()).outcome.rounds) {
      rivals += round.rivals.size();
      for (const Rival& rival : round.rivals) {
        const Effect &own = round.effect, &other = rival.effect;
        EXPECT_FALSE(own.kind == other.kind && own.joint == other.joint && own.settings == other.settings)
            << own.kind << " of joint " << own.joint + 1;
      }
    }
  }
  EXPECT_GT(rivals, 0u);
}

}  // namespace
}  // namespace demecal
