// Which islands feed which, and how the parameters of a joint's islands differ.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "evolution/archipelago.hpp"

namespace demecal {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Archipelago three_joints(Topology topology, std::uint32_t demes) {
  Archipelago archipelago;
  archipelago.joints = {0, 2, 5};
  archipelago.demes_per_joint = demes;
  archipelago.topology = topology;
  return archipelago;
}

TEST(Archipelago, ListsItsIslandsByJointThenDeme) {
  EXPECT_THAT(islands(three_joints(Topology::ring, 2)), ElementsAre(IslandKey{0, 0}, IslandKey{0, 1}, IslandKey{2, 0},
                                                                    IslandKey{2, 1}, IslandKey{5, 0}, IslandKey{5, 1}));
}

TEST(Archipelago, FeedsADemeOfARingFromTheOneBefore) {
  const Archipelago ring = three_joints(Topology::ring, 3);
  EXPECT_THAT(sources(ring, {2, 1}), ElementsAre(IslandKey{2, 0}));
  EXPECT_THAT(sources(ring, {2, 0}), ElementsAre(IslandKey{2, 2}));
}

TEST(Archipelago, FeedsADemeFromAllOthersWhereItIsFull) {
  EXPECT_THAT(sources(three_joints(Topology::full, 4), {5, 2}),
              ElementsAre(IslandKey{5, 0}, IslandKey{5, 1}, IslandKey{5, 3}));
}

TEST(Archipelago, FeedsNobodyWithoutATopology) {
  EXPECT_THAT(sources(three_joints(Topology::none, 4), {0, 1}), IsEmpty());
}

TEST(Archipelago, FeedsALoneDemeFromNobody) {
  EXPECT_THAT(sources(three_joints(Topology::ring, 1), {0, 0}), IsEmpty());
  EXPECT_THAT(sources(three_joints(Topology::full, 1), {0, 0}), IsEmpty());
}

TEST(Archipelago, FeedsFromTheJointListedBeforeWhereJointsAreLinked) {
  Archipelago linked = three_joints(Topology::ring, 2);
  linked.between_joints = true;
  EXPECT_THAT(sources(linked, {5, 1}), ElementsAre(IslandKey{5, 0}, IslandKey{2, 1}));
  EXPECT_THAT(sources(linked, {0, 1}), ElementsAre(IslandKey{0, 0}, IslandKey{5, 1}));
  linked.topology = Topology::none;
  EXPECT_THAT(sources(linked, {2, 0}), ElementsAre(IslandKey{0, 0}));
}

TEST(Archipelago, NeverFeedsAnIslandFromItself) {
  for (const Topology topology : {Topology::none, Topology::ring, Topology::full})
    for (std::uint32_t demes = 1; demes <= 4; ++demes)
      for (const bool one_joint : {true, false}) {
        Archipelago archipelago = three_joints(topology, demes);
        if (one_joint) archipelago.joints = {3};
        archipelago.between_joints = true;
        for (const IslandKey island : islands(archipelago))
          EXPECT_THAT(sources(archipelago, island), testing::Not(testing::Contains(island)));
      }
}

TEST(Archipelago, EveryIslandConsumesWhatItsSourcesSend) {
  for (const Topology topology : {Topology::none, Topology::ring, Topology::full}) {
    Archipelago archipelago = three_joints(topology, 3);
    archipelago.between_joints = topology != Topology::full;
    std::size_t ways = 0;
    for (const IslandKey island : islands(archipelago)) {
      ways += sources(archipelago, island).size();
      for (const IslandKey consumer : consumers(archipelago, island)) {
        const std::vector<IslandKey> of_consumer = sources(archipelago, consumer);
        EXPECT_EQ(std::count(of_consumer.begin(), of_consumer.end(), island), 1);
        --ways;
      }
    }
    EXPECT_EQ(ways, 0U);
  }
}

TEST(IslandParameters, AreTheSameWithoutASpreadOrNeighbours) {
  const GpParameters parameters;
  Archipelago archipelago;
  for (std::uint32_t deme = 0; deme < 2; ++deme)
    EXPECT_EQ(island_parameters(parameters, archipelago, deme), parameters);
  archipelago.spread = 1.0;
  archipelago.demes_per_joint = 1;
  EXPECT_EQ(island_parameters(parameters, archipelago, 0), parameters);
}

TEST(IslandParameters, GoFromExploringToExploitingWithinTheRules) {
  GpParameters parameters;
  for (const double spread : {0.1, 0.5, 1.0}) {
    for (const int tournament_size : {1, 5, 300}) {
      parameters.tournament_size = tournament_size;
      Archipelago archipelago;
      archipelago.spread = spread;
      archipelago.demes_per_joint = 5;
      EXPECT_EQ(island_parameters(parameters, archipelago, 2), parameters);
      for (std::uint32_t deme = 0; deme < 5; ++deme) {
        const GpParameters own = island_parameters(parameters, archipelago, deme);
        EXPECT_FALSE(find_fault(own));
        if (deme == 0) continue;
        const GpParameters before = island_parameters(parameters, archipelago, deme - 1);
        EXPECT_LT(own.mutation_rate, before.mutation_rate);
        EXPECT_GE(own.tournament_size, before.tournament_size);
        EXPECT_GT(own.shrink_mutation_rate, before.shrink_mutation_rate);
      }
    }
  }
}

}  // namespace
}  // namespace demecal
