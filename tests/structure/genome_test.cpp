// Genomes stay what they must be, whatever is done to them.
#include <gtest/gtest.h>

#include <algorithm>

#include "structure/structured_arm.hpp"

namespace demecal {
namespace {

constexpr int kLinks = 6;

bool has(const GeneSection& section, const Gene& gene) {
  return std::ranges::find(section, gene) != section.end();
}

TEST(Genome, BeginsWithUpToFiveGenesInASection) {
  RandomStream random{1201};
  std::size_t longest = 0;
  for (int i = 0; i < 200; ++i) {
    const Genome genome = random_genome(kLinks, random);
    ASSERT_EQ(genome.size(), 6U);
    for (const GeneSection& section : genome) longest = std::max(longest, section.size());
  }
  EXPECT_EQ(longest, kLongestSection);
}

TEST(Genome, IsCrossedWithinItsSectionsOnly) {
  RandomStream random{1202};
  bool of_both = false;
  for (int i = 0; i < 500; ++i) {
    const Genome a = random_genome(kLinks, random), b = random_genome(kLinks, random);
    const Genome child = crossed(a, b, random);
    ASSERT_EQ(child.size(), a.size());
    for (std::size_t section = 0; section < child.size(); ++section) {
      EXPECT_LE(child[section].size(), kLongestSection);
      for (const Gene& gene : child[section]) EXPECT_TRUE(has(a[section], gene) || has(b[section], gene));
    }
    of_both = of_both || (child != a && child != b);
  }
  EXPECT_TRUE(of_both);
}

TEST(Genome, IsMutatedInOneGeneOfOneSection) {
  RandomStream random{1203};
  for (int i = 0; i < 500; ++i) {
    const Genome before = random_genome(kLinks, random), after = mutated(before, random);
    ASSERT_EQ(after.size(), before.size());
    int different = 0;
    for (std::size_t section = 0; section < after.size(); ++section) {
      if (after[section] == before[section]) continue;
      ++different;
      EXPECT_LE(after[section].size(), kLongestSection);
      const auto longer = std::max(after[section].size(), before[section].size());
      EXPECT_LE(longer - std::min(after[section].size(), before[section].size()), 1U);
    }
    EXPECT_LE(different, 1);
  }
}

TEST(Genome, ExpressesConsecutiveEqualGenesOnceAndKeepsThemOtherwise) {
  const Gene x{false, 0}, turn{true, 0}, y{false, 1};
  EXPECT_EQ(expressed({{x, x, turn, turn, x}, {}, {y, y, y}}), (Genome{{x, turn, x}, {}, {y}}));
  RandomStream random{1204};
  for (int i = 0; i < 200; ++i) {
    const Genome once = expressed(random_genome(kLinks, random));
    EXPECT_EQ(expressed(once), once);
    for (const GeneSection& section : once) EXPECT_EQ(std::ranges::adjacent_find(section), section.end());
  }
}

}  // namespace
}  // namespace demecal
