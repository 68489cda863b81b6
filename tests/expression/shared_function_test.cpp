// Shared functions: what is one, their texts, and formulas written with calls of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "errors/input_error.hpp"
#include "expression/evaluate.hpp"
#include "expression/shared_function.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "random_formulas.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

TEST(SharedFunction, CallsComeToTheBodyOfTheirPlaces) {
  const SharedFunction function = parse_definition("F1(c1, c2, a1) = c1 * SIN(c2 + a1)", 0);
  EXPECT_EQ(arity(function), 3);
  EXPECT_EQ(function.coefficients, 2);
  const std::vector<Tree> places{constant_tree(0.5), constant_tree(2.0), parse("theta % 3")};
  EXPECT_EQ(expanded(function, places), parse("0.5 * SIN(2 + (theta % 3))"));
}

TEST(SharedFunction, CallsHaveTheValueOfTheBodyAtTheValuesOfTheirPlaces) {
  RandomStream random{821};
  for (int i = 0; i < 2000; ++i) {
    const SharedFunction function = random_function(random);
    const std::vector<Tree> places = random_places(random, function);
    const double theta[] = {random.real(-3.0, 3.0)};
    std::vector<double> values;
    for (const Tree& place : places) values.push_back(evaluate(place, theta));
    const Tree call = expanded(function, places);
    EXPECT_EQ(call.size(), expanded_size(function, places));
    ASSERT_TRUE(is_valid(call, 1));
    const double whole = evaluate(call, theta), in_parts = evaluate(function.body, values);
    ASSERT_TRUE(whole == in_parts || (whole != whole && in_parts != in_parts)) << definition_text(function, 0);
  }
}

TEST(SharedFunction, DefinitionsComeBackFromTheirText) {
  RandomStream random{822};
  for (std::size_t i = 0; i < 2000; ++i) {
    const SharedFunction function = random_function(random, 4);
    const std::string text = definition_text(function, i % kMostSharedFunctions);
    ASSERT_EQ(parse_definition(text, i % kMostSharedFunctions), function) << text;
    EXPECT_THROW(parse_definition(text, (i + 1) % kMostSharedFunctions), InputError) << text;
  }
}

TEST(SharedFunction, TextsThatDefineNoneAreRefused) {
  for (const char* const text :
       {"", "F1", "F1(a1)", "F1(a1) =", "F1(a1) = SIN(theta)", "F1(a1) = 2 * a1", "F1(a1) = a1", "F1() = SIN(2)",
        "F1(c1) = SIN(c1)", "F1(c1, a1) = SIN(a1)", "F1(a1, c1) = a1 * c1", "F1(a2) = SIN(a2)", "F1(a1, a1) = a1 * a1",
        "F2(a1) = SIN(a1)", "G1(a1) = SIN(a1)", "F1(a1) = SIN(a1) = a1", "F1(a1 = SIN(a1)", "F1(a1,) = SIN(a1)",
        "F1(a1) = F1(a1)"}) {
    EXPECT_THROW(parse_definition(text, 0), InputError) << text;
  }
  EXPECT_NO_THROW(parse_definition("F1(a1)=SIN(a1)", 0));
}

TEST(SharedFunction, BodiesThatBreakARuleAreNamedWithIt) {
  const Tree sine = parse("SIN(theta)");
  Tree long_one = variable_tree(0);
  while (long_one.size() <= kLongestBody) long_one = apply(Primitive::sine, long_one);
  EXPECT_FALSE(find_fault(SharedFunction{sine, 0}));
  EXPECT_THAT(*find_fault(SharedFunction{{}, 0}), HasSubstr("must be one complete formula"));
  EXPECT_THAT(*find_fault(SharedFunction{{{Primitive::sine, 0, 0.0}}, 0}), HasSubstr("must be one complete formula"));
  EXPECT_THAT(*find_fault(SharedFunction{long_one, 0}), HasSubstr("must have at most 64 nodes"));
  EXPECT_THAT(*find_fault(SharedFunction{parse("2 * theta"), 0}), HasSubstr("must have no constants"));
  EXPECT_THAT(*find_fault(SharedFunction{variable_tree(0), 0}), HasSubstr("must hold a function"));
  EXPECT_THAT(*find_fault(SharedFunction{apply(Primitive::sine, variable_tree(1)), 1}), HasSubstr("must have each"));
  EXPECT_THAT(*find_fault(SharedFunction{sine, 1}), HasSubstr("must take an argument"));
  EXPECT_THAT(*find_fault(SharedFunction{sine, -1}), HasSubstr("must not have less"));
}

TEST(Parse, RefusesCallsThatAreNone) {
  const std::vector<SharedFunction> functions{parse_definition("F1(c1, a1) = SIN(c1 * a1)", 0)};
  EXPECT_EQ(parse("1 + F1(2, theta)", theta_only(), functions), parse("1 + SIN(2 * theta)"));
  for (const char* const text : {"F1", "F1()", "F1(2)", "F1(2, theta, theta)", "F1(theta, theta)", "F1(SIN(2), theta)",
                                 "F2(2, theta)", "F1(2, theta", "F1 2, theta"}) {
    EXPECT_THROW(parse(text, theta_only(), functions), InputError) << text;
  }
  EXPECT_THROW(parse("F1(2, theta)"), InputError);
}

TEST(Parse, RefusesCallsThatComeToTooMuch) {
  const std::vector<SharedFunction> functions{parse_definition("F1(a1) = (a1 + a1) * (a1 + a1)", 0)};
  std::string text = "theta";
  for (int i = 0; i < 6; ++i) text = "F1(" + text + ")";
  EXPECT_LE(parse(text, theta_only(), functions).size(), kLongestExpansion);
  for (int i = 0; i < 100; ++i) text = "F1(" + text + ")";
  EXPECT_THROW(parse(text, theta_only(), functions), InputError);
}

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
    ASSERT_EQ(in_order(expanded(formula, functions)), in_order(tree)) << to_string(formula);
    ASSERT_EQ(size(formula), folded_size(tree, functions)) << to_string(formula);
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
    const std::string text = to_string(formula);
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
    EXPECT_LE(size(formula), std::min(as_call, call.size())) << to_string(call);
    EXPECT_EQ(formula.calls.empty(), as_call >= call.size()) << to_string(call);
  }
}

TEST(Folded, WithoutFunctionsIsTheFormulaItself) {
  RandomStream random{834};
  for (int i = 0; i < 500; ++i) {
    const Tree tree = random_tree(random, 5);
    const FoldedFormula formula = folded(tree, {});
    EXPECT_EQ(expanded(formula, {}), tree);
    EXPECT_EQ(to_string(formula), to_string(tree));
    EXPECT_THAT(functions_called(formula), IsEmpty());
  }
}

TEST(Folded, CallsInsideCalls) {
  const std::vector<SharedFunction> functions{parse_definition("F1(c1, a1) = SIN(c1 * a1)", 0),
                                              parse_definition("F2(a1) = a1 * COS(a1)", 1)};
  const FoldedFormula formula = folded(parse("2 + SIN(COS(SIN(theta * 3)) * SIN(3 * theta) * 0.5)"), functions);
  EXPECT_EQ(to_string(formula), "2 + F1(0.5, F2(F1(3, theta)))");
  EXPECT_THAT(functions_called(formula), ElementsAre(0, 1));
  EXPECT_EQ(size(formula), 8U);
}

TEST(Folded, TakesTheNegativeOfAConstantThatIsSubtracted) {
  const std::vector<SharedFunction> functions{parse_definition("F1(c1, c2, a1) = c1 * SIN(a1 + c2)", 0)};
  EXPECT_EQ(to_string(folded(parse("0.0037 * SIN(2 * theta - 1.2)"), functions)), "F1(0.0037, -1.2, 2 * theta)");
}

}  // namespace
}  // namespace demecal
