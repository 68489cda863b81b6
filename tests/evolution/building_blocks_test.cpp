// Expressions that were planted in the fronts of several joints are found again, counted, and distinguished from what
// chance made.
#include "evolution/building_blocks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../expression/random_formulas.hpp"
#include "expression/simplify.hpp"

namespace demecal {
namespace {

using ::testing::IsEmpty;

std::string form_text(const std::string& formula) {
  return block_text(block_form(parse(formula)));
}

/// A random formula of + * and COS alone.
Tree random_filling(RandomStream& random, int depth) {
  if (depth == 0 || random.chance(0.2)) return random_terminal(random);
  const Tree first = random_filling(random, depth - 1);
  switch (random.index(3)) {
    case 0:
      return apply(Primitive::cosine, first);
    case 1:
      return apply(Primitive::add, first, random_filling(random, depth - 1));
    default:
      return apply(Primitive::multiply, first, random_filling(random, depth - 1));
  }
}

TEST(BlockForm, IsOneWhateverTheOrderOfArgumentsAndTheConstants) {
  RandomStream random({71});
  int tried = 0;
  for (int i = 0; i < 8000; ++i) {
    const Tree tree = random_tree(random, 5);
    Tree other = swapped(random, tree);
    for (Node& node : other) {
      if (node.primitive == Primitive::constant) node.value *= random.real(0.5, 2.0);
    }
    if (simplified(tree) != tree || simplified(other) != other) continue;  // what falls away depends on the constants
    EXPECT_EQ(block_form(tree), block_form(other)) << to_string(tree) << " and " << to_string(other);
    tried += tree.size() > 3 ? 1 : 0;
  }
  EXPECT_GT(tried, 200);
}

TEST(BlockForm, IsAValidFormulaNoLongerThanTheOneItIsOf) {
  RandomStream random({72});
  for (int i = 0; i < 2000; ++i) {
    const Tree tree = random_tree(random, 6, 3), form = block_form(tree);
    ASSERT_TRUE(is_valid(form, 4));
    EXPECT_LE(form.size(), tree.size());
    EXPECT_FALSE(contains(form, Primitive::constant));
  }
}

TEST(BlockForm, TakesConstantsTogether) {
  EXPECT_EQ(form_text("theta * 0.3"), "c * theta");
  EXPECT_EQ(form_text("theta % 4"), "c * theta");
  EXPECT_EQ(form_text("0.2 * (theta * 3)"), "c * theta");
  EXPECT_EQ(form_text("(SIN(theta) - 0.5) + 2"), "SIN(theta) + c");
  EXPECT_EQ(form_text("0.5 - theta"), "c - theta");
  EXPECT_EQ(form_text("COS(3.5 * 2)"), "c");
  EXPECT_EQ(form_text("theta - theta"), "c");
  EXPECT_NE(form_text("4 % theta"), form_text("theta % 4"));
}

/// Fronts of three joints, two islands each, whose longest individuals hold `planted` where `holds` says so.
template <class Holds>
std::vector<IslandFront> planted_fronts(const Tree& planted, const Holds& holds) {
  RandomStream random({73});
  std::vector<IslandFront> fronts;
  for (std::uint32_t island = 0; island < 6; ++island) {
    IslandFront front{island / 2, {}};
    for (int i = 0; i < 10; ++i) {
      Tree tree = random_filling(random, 4);
      if (holds(island, i)) tree = apply(Primitive::add, tree, planted);
      front.members.push_back({std::move(tree), 10.0 - i});
    }
    fronts.push_back(std::move(front));
  }
  return fronts;
}

const BuildingBlock* find(const std::vector<BuildingBlock>& blocks, const std::string& text) {
  const auto found =
      std::find_if(blocks.begin(), blocks.end(), [&](const auto& block) { return block_text(block.form) == text; });
  return found == blocks.end() ? nullptr : &*found;
}

constexpr BlockLimits kAnyBlock{.least_joints = 2, .least_functions = 1};

TEST(BuildingBlocks, AreNoSingleFunctionsUnlessAskedFor) {
  const auto fronts = planted_fronts(parse("SIN(theta)"), [](std::uint32_t, int i) { return i == 4; });
  EXPECT_EQ(find(building_blocks(fronts), "SIN(theta)"), nullptr);
  ASSERT_NE(find(building_blocks(fronts, kAnyBlock), "SIN(theta)"), nullptr);
  EXPECT_EQ(find(building_blocks(fronts, kAnyBlock), "SIN(theta)")->individuals, 6U);
}

TEST(BuildingBlocks, FindWhatWasPlantedWithItsCounts) {
  const auto holds = [](std::uint32_t island, int i) { return island != 3 && i >= 8; };  // the two fittest of five
  const auto blocks = building_blocks(planted_fronts(parse("SIN(2.5 * theta)"), holds));
  const BuildingBlock* found = find(blocks, "SIN(c * theta)");
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->joints, 3U);
  EXPECT_EQ(found->islands, 5U);
  EXPECT_EQ(found->individuals, 10U);
  EXPECT_DOUBLE_EQ(found->rank_share, 0.5 * (8.0 / 9.0 + 9.0 / 9.0));
}

TEST(BuildingBlocks, OfOneJointAreNotShared) {
  const auto holds = [](std::uint32_t island, int) { return island / 2 == 1; };
  const auto fronts = planted_fronts(parse("TANH(0.5 * theta)"), holds);
  EXPECT_EQ(find(building_blocks(fronts), "TANH(c * theta)"), nullptr);
  const auto of_one = building_blocks(fronts, {.least_joints = 1, .least_functions = 2});
  ASSERT_NE(find(of_one, "TANH(c * theta)"), nullptr);
  EXPECT_EQ(find(of_one, "TANH(c * theta)")->islands, 2U);
  EXPECT_EQ(find(of_one, "TANH(c * theta)")->individuals, 20U);
}

TEST(BuildingBlocks, LeaveOutWhatStandsOnlyWithinALargerOne) {
  const auto holds = [](std::uint32_t, int i) { return i % 2 == 0; };
  const auto blocks = building_blocks(planted_fronts(parse("TANH(ATAN(theta))"), holds), kAnyBlock);
  EXPECT_NE(find(blocks, "TANH(ATAN(theta))"), nullptr);
  EXPECT_EQ(find(blocks, "ATAN(theta)"), nullptr);
}

TEST(BuildingBlocks, KeepWhatStandsElsewhereToo) {
  auto fronts = planted_fronts(parse("TANH(ATAN(theta))"), [](std::uint32_t, int i) { return i == 0; });
  fronts[0].members.push_back({parse("ATAN(theta)"), 0.5});
  const auto blocks = building_blocks(fronts, kAnyBlock);
  ASSERT_NE(find(blocks, "ATAN(theta)"), nullptr);
  EXPECT_EQ(find(blocks, "ATAN(theta)")->individuals, 7U);
  EXPECT_EQ(find(blocks, "TANH(ATAN(theta))")->individuals, 6U);
}

TEST(BuildingBlocks, AreSortedByHowManyHoldThemAndHoldAVariable) {
  const auto blocks = building_blocks(planted_fronts(parse("theta"), [](std::uint32_t, int) { return false; }),
                                      {.least_joints = 1, .least_functions = 1});
  ASSERT_GT(blocks.size(), 10U);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    EXPECT_GT(blocks[i].form.size(), 1U);
    EXPECT_GE(blocks[i].individuals, blocks[i].islands);
    EXPECT_GE(blocks[i].islands, blocks[i].joints);
    EXPECT_TRUE(std::ranges::any_of(blocks[i].form, [](const Node& node) { return node.variable > 0; }));
    if (i > 0) {
      EXPECT_LE(blocks[i].joints, blocks[i - 1].joints);
    }
  }
}

TEST(BuildingBlocks, AreNoneOfFormulasWithoutVariables) {
  EXPECT_THAT(building_blocks(std::vector<IslandFront>{{0, {{neutral_tree(), 1.0}, {parse("SIN(0.3)"), 2.0}}}},
                              {.least_joints = 1, .least_functions = 0}),
              IsEmpty());
  EXPECT_THAT(building_blocks({}), IsEmpty());
}

}  // namespace
}  // namespace demecal
