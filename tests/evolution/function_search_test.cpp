// Structures that formulas of several joints share become functions; what is of one joint, or saves nothing, does not.
#include "evolution/building_blocks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../expression/random_formulas.hpp"
#include "expression/shared_function.hpp"
#include "expression/tree.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> texts_of(const std::vector<SharedFunction>& functions) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < functions.size(); ++i) texts.push_back(definition_text(functions[i], i));
  return texts;
}

/// A wave with coefficients of its own beside something else.
std::vector<Tree> waves(RandomStream& random, std::size_t count) {
  std::vector<Tree> formulas;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = [&random] { return constant_tree(random.real(0.5, 2.0)); };
    const Tree turned = apply(Primitive::add, apply(Primitive::multiply, number(), variable_tree(0)), number());
    Tree wave = apply(Primitive::multiply, number(), apply(Primitive::sine, turned));
    const Primitive others[]{Primitive::arc_tangent, Primitive::square, Primitive::hyperbolic_tangent};
    const Tree rest = apply(others[i % 3], random_tree(random, 1));
    wave = random.chance(0.5) ? apply(Primitive::add, wave, rest) : apply(Primitive::subtract, rest, wave);
    formulas.push_back(swapped(random, wave));
  }
  return formulas;
}

TEST(FunctionSearch, FindsTheStructureThatTwoJointsShareWithOtherCoefficients) {
  const std::vector<std::vector<Tree>> formulas{
      {parse("0.3 * SIN(2 * theta - 1.2)"), parse("0.3 * SIN(1.9 * theta) + ATAN(theta)")},
      {parse("SIN(0.4 + 3 * theta) * 0.7"), parse("TANH(0.2 * SIN(theta * 2 + 0.1))"),
       parse("theta % (SIN(3 * theta - 2) * 0.1)")},
      {parse("COS(theta)")}};
  const auto functions = find_shared_functions(formulas, 1);
  EXPECT_THAT(texts_of(functions), ElementsAre("F1(c1, c2, c3, a1) = c1 * SIN(c2 * a1 + c3)"));
}

TEST(FunctionSearch, TakesWhatDiffersBesideConstantsAsArguments) {
  std::vector<std::vector<Tree>> formulas;
  for (const char* const inner : {"TANH(theta)", "theta", "theta * theta", "ATAN(theta)", "EXPb(theta)"})
    formulas.push_back({parse(std::string("SIN(0.5 * (") + inner + ")) * COS(0.3 + " + inner + ")")});
  const auto functions = find_shared_functions(formulas, 4);
  ASSERT_FALSE(functions.empty());
  EXPECT_EQ(arity(functions[0]) - functions[0].coefficients, 1) << definition_text(functions[0], 0);
  for (const auto& of_joint : formulas) EXPECT_FALSE(folded(of_joint[0], functions).calls.empty());
}

TEST(FunctionSearch, FindsNothingWithOneJointOrWithoutAny) {
  RandomStream random{841};
  const std::vector<std::vector<Tree>> of_one{waves(random, 20)};
  EXPECT_THAT(find_shared_functions(of_one, 4), IsEmpty());
  EXPECT_THAT(find_shared_functions({}, 4), IsEmpty());
  const std::vector<std::vector<Tree>> empty(6);
  EXPECT_THAT(find_shared_functions(empty, 4), IsEmpty());
}

TEST(FunctionSearch, FindsNothingThatSavesNothing) {
  const std::vector<std::vector<Tree>> formulas{{parse("0.3 * SIN(theta)")}, {parse("0.7 * SIN(theta)")}};
  EXPECT_THAT(find_shared_functions(formulas, 4), IsEmpty());
}

/// Nodes and calls of formulas and definitions.
std::size_t length_of(const std::vector<std::vector<Tree>>& formulas, const std::vector<SharedFunction>& functions) {
  std::size_t length = 0;
  for (const SharedFunction& function : functions) length += function.body.size() + 1;
  for (const auto& of_joint : formulas)
    for (const Tree& tree : of_joint) length += folded_size(tree, functions);
  return length;
}

TEST(FunctionSearch, ShortensWithEveryFunctionAndAllOfThemAreShared) {
  RandomStream random{842};
  for (int i = 0; i < 10; ++i) {
    std::vector<std::vector<Tree>> formulas(2 + random.index(3));
    for (auto& of_joint : formulas) of_joint = waves(random, 4 + random.index(6));
    const auto functions = find_shared_functions(formulas, 3);
    ASSERT_FALSE(functions.empty());
    ASSERT_LE(functions.size(), 3U);
    EXPECT_LT(length_of(formulas, functions), length_of(formulas, {}));
    for (std::size_t k = 0; k < functions.size(); ++k) {
      EXPECT_FALSE(find_fault(functions[k])) << definition_text(functions[k], k);
      const auto first = std::vector<SharedFunction>(functions.begin(), functions.begin() + static_cast<long>(k));
      EXPECT_THAT(find_shared_functions(formulas, k), first);  // the best come first
    }
  }
}

TEST(FunctionSearch, DoesNotDependOnConstantsOrTheOrderOfArguments) {
  RandomStream random{843};
  for (int i = 0; i < 10; ++i) {
    std::vector<std::vector<Tree>> formulas(3);
    for (auto& of_joint : formulas) of_joint = waves(random, 3);
    std::vector<std::vector<Tree>> others = formulas;
    for (auto& of_joint : others) {
      for (Tree& tree : of_joint) {
        tree = swapped(random, tree);
        for (Node& node : tree)
          if (node.primitive == Primitive::constant) node.value *= random.real(1.1, 1.3);
      }
    }
    EXPECT_EQ(find_shared_functions(formulas, 3), find_shared_functions(others, 3));
  }
}

}  // namespace
}  // namespace demecal
