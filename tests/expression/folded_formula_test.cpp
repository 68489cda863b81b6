// Formulas written with calls: they are the formulas, as short as can be, and come back from their text.
#include "expression/folded_formula.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "expression/argument_order.hpp"
#include "random_function.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<SharedFunction> random_functions(RandomStream& random) {
  std::vector<SharedFunction> functions(1 + random.index(3));
  for (SharedFunction& function : functions) function = random_function(random);
  return functions;
}

TEST(Folded, WrittenOutIsTheFormulaButForTheOrderOfArguments) {
  RandomStream random{831};
  int calls = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::vector<SharedFunction> functions = random_functions(random);
    const Tree tree = swapped(random, random_calling_tree(random, functions, 3));
    const FoldedFormula formula = folded(tree, functions);
    ASSERT_EQ(in_order(expanded(formula, functions)), in_order(tree)) << to_text(formula);
    ASSERT_EQ(size(formula), folded_size(tree, functions)) << to_text(formula);
    EXPECT_LE(size(formula), tree.size());
    calls += formula.calls.empty() ? 0 : 1;
  }
  EXPECT_GT(calls, 1000);
}

TEST(Folded, ComesBackFromItsTextToTheBit) {
  RandomStream random{832};
  for (int i = 0; i < 2000; ++i) {
    const std::vector<SharedFunction> functions = random_functions(random);
    const FoldedFormula formula = folded(random_calling_tree(random, functions, 3), functions);
    const std::string text = to_text(formula);
    ASSERT_EQ(parse(text, theta_only(), functions), expanded(formula, functions)) << text;
  }
}

TEST(Folded, FindsACallWhateverTheOrderOfItsArguments) {
  RandomStream random{833};
  for (int i = 0; i < 2000; ++i) {
    const std::vector<SharedFunction> functions{random_function(random)};
    const std::vector<Tree> places = random_places(random, functions[0], 0);
    const Tree call = expanded(functions[0], places);
    const FoldedFormula formula = folded(swapped(random, call), functions);
    const std::size_t as_call = 1 + places.size();
    EXPECT_LE(size(formula), std::min(as_call, call.size())) << to_text(call);
    EXPECT_EQ(formula.calls.empty(), as_call >= call.size()) << to_text(call);
  }
}

TEST(Folded, WithoutFunctionsIsTheFormulaItself) {
  RandomStream random{834};
  for (int i = 0; i < 500; ++i) {
    const Tree tree = random_tree(random, 5);
    const FoldedFormula formula = folded(tree, {});
    EXPECT_EQ(expanded(formula, {}), tree);
    EXPECT_EQ(to_text(formula), to_text(tree));
    EXPECT_THAT(functions_called(formula), IsEmpty());
  }
}

TEST(Folded, CallsInsideCalls) {
  const std::vector<SharedFunction> functions{parse_definition("F1(c1, a1) = SIN(c1 * a1)", 0),
                                              parse_definition("F2(a1) = a1 * COS(a1)", 1)};
  const FoldedFormula formula = folded(parse("2 + SIN(COS(SIN(theta * 3)) * SIN(3 * theta) * 0.5)"), functions);
  EXPECT_EQ(to_text(formula), "2 + F1(0.5, F2(F1(3, theta)))");
  EXPECT_THAT(functions_called(formula), ElementsAre(0, 1));
  EXPECT_EQ(size(formula), 8U);
}

TEST(Folded, TakesTheNegativeOfAConstantThatIsSubtracted) {
  const std::vector<SharedFunction> functions{parse_definition("F1(c1, c2, a1) = c1 * SIN(a1 + c2)", 0)};
  EXPECT_EQ(to_text(folded(parse("0.0037 * SIN(2 * theta - 1.2)"), functions)), "F1(0.0037, -1.2, 2 * theta)");
}

}  // namespace
}  // namespace demecal
