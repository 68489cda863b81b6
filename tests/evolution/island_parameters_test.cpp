// Islands of a joint that differ in their parameters.
#include "evolution/island_parameters.hpp"

#include <gtest/gtest.h>

namespace demecal {
namespace {

TEST(IslandParameters, AreTheSameWithoutASpreadOrNeighbours) {
  const GpParameters parameters;
  Archipelago archipelago;
  for (std::uint32_t deme = 0; deme < 2; ++deme) EXPECT_EQ(parameters_of(parameters, archipelago, deme), parameters);
  archipelago.spread = 1.0;
  archipelago.demes_per_joint = 1;
  EXPECT_EQ(parameters_of(parameters, archipelago, 0), parameters);
}

TEST(IslandParameters, GoFromExploringToExploitingWithinTheRules) {
  GpParameters parameters;
  for (const double spread : {0.1, 0.5, 1.0}) {
    for (const int tournament_size : {1, 5, 300}) {
      parameters.tournament_size = tournament_size;
      Archipelago archipelago;
      archipelago.spread = spread;
      archipelago.demes_per_joint = 5;
      EXPECT_EQ(parameters_of(parameters, archipelago, 2), parameters);
      for (std::uint32_t deme = 0; deme < 5; ++deme) {
        const GpParameters own = parameters_of(parameters, archipelago, deme);
        EXPECT_FALSE(find_fault(own));
        if (deme == 0) continue;
        const GpParameters before = parameters_of(parameters, archipelago, deme - 1);
        EXPECT_LT(own.mutation_rate, before.mutation_rate);
        EXPECT_GE(own.tournament_size, before.tournament_size);
        EXPECT_GT(own.shrink_mutation_rate, before.shrink_mutation_rate);
      }
    }
  }
}

}  // namespace
}  // namespace demecal
