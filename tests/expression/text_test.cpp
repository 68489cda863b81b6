// Formulas as text: the notation of the thesis, round trips, and sentences about what cannot be read.
#include "expression/text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "errors/input_error.hpp"
#include "expression/evaluate.hpp"
#include "random_formulas.hpp"

namespace demecal {
namespace {

Tree with_constants_of_any_bits(RandomStream& random, Tree tree) {
  for (Node& node : tree) {
    if (node.primitive != Primitive::constant) continue;
    do {
      const std::uint64_t high = random.index(std::uint64_t{1} << 32);
      node.value = std::bit_cast<double>((high << 32) | random.index(std::uint64_t{1} << 32));
    } while (!std::isfinite(node.value));
  }
  return tree;
}

std::string rule_of(std::string_view text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.rule();
  }
  return "no error";
}

TEST(Text, RoundTripsTreesToTheBit) {
  RandomStream random{4, 1};
  const VariableNames names{"theta", "payload", "t_2"};
  for (int trial = 0; trial < 2000; ++trial) {
    const Tree tree = random_tree(random, 7, 3);
    EXPECT_EQ(parse(to_string(tree, names), names), tree) << to_string(tree, names);
  }
}

TEST(Text, RoundTripsEveryFiniteConstant) {
  RandomStream random{4, 2};
  for (int trial = 0; trial < 1000; ++trial) {
    const Tree tree = with_constants_of_any_bits(random, random_tree(random, 4));
    EXPECT_EQ(parse(to_string(tree)), tree) << to_string(tree);
  }
  for (const double value : {0.0, -0.0, 5e-324, -5e-324, 1.7976931348623157e308, 0.1}) {
    EXPECT_EQ(parse(to_string(constant_tree(value))), constant_tree(value)) << value;
  }
}

TEST(Text, IsWrittenInTheNotationOfTheThesis) {
  for (const std::string formula :
       {"theta + SQRTp(0.3988464003418073) * 0.0002441480758079775", "theta - theta", "SIN(COS(theta) * SIGN(theta))",
        "(theta + 1) * theta", "theta * (theta % 0.5)", "theta * theta % 0.5", "theta - (theta - 0.5)",
        "theta - theta - 0.5", "-0.5 * theta + (-0.25)", "theta - (-0.5 * theta)"}) {
    EXPECT_EQ(to_string(parse(formula)), formula);
  }
}

TEST(Text, KeepsTheOrderOfProtectedQuotients) {
  const double theta = 0.0;
  EXPECT_EQ(evaluate(parse("3 * (2 % theta)"), {&theta, 1}), 3.0);
  EXPECT_EQ(evaluate(parse("3 * 2 % theta"), {&theta, 1}), 1.0);
  EXPECT_NE(parse("3 * (2 % theta)"), parse("3 * 2 % theta"));
  EXPECT_EQ(parse("3 % 2 * theta"), parse("(3 % 2) * theta"));
}

TEST(Text, OverlooksSpacesAndNeedlessParentheses) {
  EXPECT_EQ(parse(" ( ( theta\t) )-  SIN ( ((theta)) )\n"), parse("theta-SIN(theta)"));
  EXPECT_EQ(parse("theta - -0.5"), parse("theta-(-.5)"));
  EXPECT_EQ(parse("theta-0.5"), parse("theta - 5e-1"));
}

TEST(Text, ReadsAModelPrintedInTheThesis) {
  const Tree tree = parse(
      "0.02016710409863582 * (SQRTp(theta * (theta - theta) - theta * theta * theta) * 0.8962777184362316 * "
      "SIGN(theta) * "
      "0.3594566179387799 - SQRTp(SQRTp(0.9496652729880674 * theta - COS(theta)))) * 0.08997350993377484");
  EXPECT_TRUE(is_valid(tree, 1));
  const double theta = 1.0;
  const double root = std::sqrt(std::sqrt(std::abs(0.9496652729880674 - std::cos(1.0))));
  EXPECT_NEAR(evaluate(tree, {&theta, 1}),
              0.02016710409863582 * (0.8962777184362316 * 0.3594566179387799 - root) * 0.08997350993377484, 1e-18);
}

TEST(Text, NamesTheColumnAndWhatWasExpectedThere) {
  EXPECT_EQ(rule_of(""),
            "column 1: expected a number, theta SIN COS SIGN SQRTp ABS LOGp EXPb TANH ATAN SQUARE MIN MAX or '('");
  EXPECT_EQ(rule_of("theta + "),
            "column 9: expected a number, theta SIN COS SIGN SQRTp ABS LOGp EXPb TANH ATAN SQUARE MIN MAX or '('");
  EXPECT_EQ(rule_of("theta theta"), "column 7: expected an operator (+ - * %) or the end");
  EXPECT_EQ(rule_of("theta / 2"), "column 7: expected an operator (+ - * %) or the end");
  EXPECT_EQ(rule_of("(theta"), "column 7: expected an operator (+ - * %) or ')'");
  EXPECT_EQ(rule_of("theta)"), "column 6: expected an operator (+ - * %) or the end");
  EXPECT_EQ(rule_of("SIN theta"), "column 5: expected '(' after SIN");
  EXPECT_EQ(rule_of("-theta"), "column 2: expected a number after '-'");
  EXPECT_EQ(rule_of("1 + Theta"),
            "column 5: expected theta SIN COS SIGN SQRTp ABS LOGp EXPb TANH ATAN SQUARE MIN MAX, not Theta");
  EXPECT_EQ(rule_of("sin(theta)"),
            "column 1: expected theta SIN COS SIGN SQRTp ABS LOGp EXPb TANH ATAN SQUARE MIN MAX, not sin");
  EXPECT_EQ(rule_of("1e999"), "column 1: expected a number that a double can hold");
  EXPECT_EQ(rule_of("inf"),
            "column 1: expected theta SIN COS SIGN SQRTp ABS LOGp EXPb TANH ATAN SQUARE MIN MAX, not inf");
  EXPECT_EQ(rule_of("."), "column 1: expected a number");
}

TEST(Text, RefusesDeepNestingButNotLongSums) {
  const std::string deep = std::string(1000, '(') + "theta" + std::string(1000, ')');
  EXPECT_EQ(rule_of(deep), "column 257: expected no more than 256 nested parentheses");
  EXPECT_EQ(rule_of(std::string(200, '(') + "theta" + std::string(200, ')')), "no error");
  std::string calls;
  for (int i = 0; i < 100000; ++i) calls += "SIN(";
  EXPECT_NE(rule_of(calls), "no error");

  std::string sum = "theta";
  for (int i = 0; i < 20000; ++i) sum += " + theta";
  EXPECT_EQ(to_string(parse(sum)), sum);
}

TEST(Text, IsNeverReadAsMoreThanAnErrorOrAValidTree) {
  RandomStream random{4, 3};
  const std::string_view alphabet = "theta()+-*%SINCOSGQRTp0123456789.e ";
  int valid = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::string text = to_string(random_tree(random, 3));
    for (int change = 0; change < 2; ++change) {
      text[random.index(text.size())] = alphabet[random.index(alphabet.size())];
    }
    try {
      EXPECT_TRUE(is_valid(parse(text), 1)) << text;
      ++valid;
    } catch (const InputError& error) {
      EXPECT_FALSE(error.rule().empty());
    }
  }
  EXPECT_GT(valid, 100);
}

}  // namespace
}  // namespace demecal
