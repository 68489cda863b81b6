// Functions that formulas share: what a call stands for, their definitions as text, and what is no function.
#include "expression/shared_function.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "errors/input_error.hpp"
#include "expression/evaluate.hpp"
#include "expression/text.hpp"
#include "random_function.hpp"

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

}  // namespace
}  // namespace demecal
