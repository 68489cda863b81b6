// The causes of errors by commonness: all of the catalogue, each with words and sizes.
#include "effects/catalogue.hpp"

#include <gtest/gtest.h>

#include "effects/effect.hpp"

namespace demecal {
namespace {

TEST(LikelyCauses, AreTheKindsOfTheCatalogueAndNoOthers) {
  for (const EffectLaw* const law : catalogue()) EXPECT_LT(rarity(law->kind()), causes().size()) << law->kind();
  EXPECT_EQ(causes().size(), catalogue().size());
  for (const Cause& cause : causes()) {
    EXPECT_NE(find_law(cause.kind), nullptr) << cause.kind;
    EXPECT_EQ(&cause_of(cause.kind), &cause) << cause.kind;
    EXPECT_FALSE(cause.words.empty()) << cause.kind;
    EXPECT_GT(cause.largest_turn_rad, 0.0) << cause.kind;
    EXPECT_GT(cause.largest_shift_m, 0.0) << cause.kind;
  }
}

TEST(LikelyCauses, BeginWithTheLinksAndEndWithTheInstrument) {
  EXPECT_EQ(rarity("geometry"), 0u);
  EXPECT_EQ(rarity("sensor_scale") + 1, causes().size());
  EXPECT_LT(rarity("backlash"), rarity("hysteresis"));
  EXPECT_EQ(rarity("no such kind"), causes().size());
}

}  // namespace
}  // namespace demecal
