// Who sends elites to whom.
#include "evolution/archipelago.hpp"

#include <gmock/gmock.h>

#include <algorithm>

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

}  // namespace
}  // namespace demecal
