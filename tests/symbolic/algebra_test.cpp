// Expressions keep their values however they are shortened, and are shortened where theorems say so.
#include <gtest/gtest.h>

#include <cmath>

#include "expression/text.hpp"
#include "random/random_stream.hpp"
#include "symbolic/calculus.hpp"
#include "symbolic/parse_expression.hpp"
#include "symbolic/printing.hpp"

namespace demecal {
namespace {

/// An expression and, computed beside it by plain arithmetic, its value.
struct Twin {
  Expression expression;
  double value;
};

const std::vector<std::string> kNames{"a", "b", "c"};

Twin random_twin(Algebra& algebra, RandomStream& stream, const SymbolValues& at, int depth) {
  if (depth == 0) {
    if (stream.chance(0.3)) {
      const double value = std::round(stream.real(-3, 3)) / 2;
      return {algebra.constant(value), value};
    }
    const std::string& name = kNames[stream.index(kNames.size())];
    return {algebra.symbol(name), at.at(name)};
  }
  const Twin x = random_twin(algebra, stream, at, depth - 1), y = random_twin(algebra, stream, at, depth - 1);
  switch (stream.index(8)) {
    case 0:
      return {x.expression + y.expression, x.value + y.value};
    case 1:
      return {x.expression - y.expression, x.value - y.value};
    case 2:
      return {x.expression * y.expression, x.value * y.value};
    case 3:
      return {x.expression / (2.0 * y.expression * y.expression + 1.0), x.value / (2.0 * y.value * y.value + 1.0)};
    case 4:
      return {sine(x.expression + y.expression), std::sin(x.value + y.value)};
    case 5:
      return {cosine(x.expression) * cosine(y.expression) - sine(x.expression) * sine(y.expression),
              std::cos(x.value + y.value)};
    case 6:
      return {sine(x.expression) * sine(x.expression) * y.expression +
                  cosine(x.expression) * cosine(x.expression) * y.expression,
              y.value};
    default:
      return {larger(x.expression, cosine(y.expression)), std::max(x.value, std::cos(y.value))};
  }
}

SymbolValues random_values(RandomStream& stream) {
  SymbolValues at;
  for (const std::string& name : kNames) at[name] = stream.real(-2, 2);
  return at;
}

TEST(Algebra, KeepsTheValuesOfRandomExpressions) {
  RandomStream stream{601};
  for (int i = 0; i < 2000; ++i) {
    Algebra algebra;
    const SymbolValues at = random_values(stream);
    const Twin twin = random_twin(algebra, stream, at, 3);
    EXPECT_NEAR(value_of(twin.expression, at), twin.value, 1e-11 * std::max(1.0, std::abs(twin.value)))
        << ExpressionPrinter(CodeLanguage::text)(twin.expression);
  }
}

TEST(Algebra, WritesTextThatReadsBackAsTheSameExpression) {
  RandomStream stream{602};
  for (int i = 0; i < 1000; ++i) {
    Algebra algebra;
    const SymbolValues at = random_values(stream);
    Expression expression = random_twin(algebra, stream, at, 3).expression;
    const std::string text = ExpressionPrinter(CodeLanguage::text)(expression);
    if (text.find("max(") != std::string::npos) continue;  // not a word of matrices
    EXPECT_NEAR(value_of(parse_expression(algebra, text), at), value_of(expression, at),
                1e-12 * std::max(1.0, std::abs(value_of(expression, at))))
        << text;
  }
}

TEST(Algebra, DifferentiatesAsDifferencesDo) {
  RandomStream stream{603};
  for (int i = 0; i < 500; ++i) {
    Algebra algebra;
    const SymbolValues at = random_values(stream);
    const Expression expression = random_twin(algebra, stream, at, 3).expression;
    constexpr double kStep = 1e-5;
    SymbolValues before = at, after = at;
    before["a"] -= kStep;
    after["a"] += kStep;
    const double middle = value_of(expression, at), left = value_of(expression, before),
                 right = value_of(expression, after);
    const double forward = (right - middle) / kStep, backward = (middle - left) / kStep;
    const double slope = value_of(derivative(expression, "a"), at);
    // At a kink of max the slope is that of either side; elsewhere the sides agree.
    const double scale = std::max(1.0, std::abs(slope) + std::abs(forward - backward) / kStep);
    EXPECT_NEAR(slope, (right - left) / (2 * kStep), 1e-5 * scale) << ExpressionPrinter(CodeLanguage::text)(expression);
  }
}

TEST(Algebra, DifferentiatesTheFunctionsOfEvolvedFormulas) {
  RandomStream stream{604};
  for (const Function function : {Function::logarithm_or_zero, Function::bounded_exponential, Function::arc_tangent,
                                  Function::square, Function::lesser, Function::greater}) {
    for (int i = 0; i < 100; ++i) {
      Algebra algebra;
      const Expression a = algebra.symbol("a"), other = sine(2.0 * a);
      const Expression expression = algebra.function(function, {a, other});
      const double at = stream.real(-20, 20), step = 1e-6 * std::max(1.0, std::abs(at));
      // Beside a kink, and beside the singularity of the logarithm, differences tell nothing.
      if (std::abs(at) < 0.1 || std::abs(std::abs(at) - 16) < 0.1 || std::abs(at - std::sin(2 * at)) < 0.1) continue;
      const double by_differences =
          (value_of(expression, {{"a", at + step}}) - value_of(expression, {{"a", at - step}})) / (2 * step);
      EXPECT_NEAR(value_of(derivative(expression, "a"), {{"a", at}}), by_differences,
                  1e-6 * std::max(1.0, std::abs(by_differences)))
          << ExpressionPrinter(CodeLanguage::text)(expression) << " at " << at;
    }
  }
}

std::string simplified_text(const std::string& text) {
  Algebra algebra;
  return ExpressionPrinter(CodeLanguage::text)(parse_expression(algebra, text));
}

TEST(Algebra, ShortensByTheTheoremsOfSinesAndCosines) {
  EXPECT_EQ(simplified_text("sin(x)^2 + cos(x)^2"), "1");
  EXPECT_EQ(simplified_text("3*y*sin(x)^2 + 3*y*cos(x)^2"), "3*y");
  EXPECT_EQ(simplified_text("cos(x)^2 - sin(x)^2"), "cos(2*x)");
  EXPECT_EQ(simplified_text("1 - cos(x)^2"), "sin(x)^2");
  EXPECT_EQ(simplified_text("z*sin(x)*cos(y) + z*cos(x)*sin(y)"), "z*sin(x + y)");
  EXPECT_EQ(simplified_text("sin(x)*cos(y) - cos(x)*sin(y)"), "sin(x - y)");
  EXPECT_EQ(simplified_text("cos(x)*cos(y) - sin(x)*sin(y)"), "cos(x + y)");
  EXPECT_EQ(simplified_text("cos(x)*cos(y) + sin(x)*sin(y)"), "cos(x - y)");
  EXPECT_EQ(simplified_text("cos(PI/2)*x + sin(-PI/2)*y + cos(PI)"), "-y - 1");
  EXPECT_EQ(simplified_text("sin(x + PI/2)"), "cos(x)");
  EXPECT_EQ(simplified_text("sin(-x) + cos(-y)"), "cos(y) - sin(x)");
  EXPECT_EQ(simplified_text("x*0 + 1*y + 0 - y + x/x"), "1");
  EXPECT_EQ(simplified_text("x + x - 2*(x - y)"), "2*x - 2*(x - y)");
  EXPECT_EQ(simplified_text("(x - y) - (x + y)"), "-2*y");
}

TEST(Algebra, MakesEqualExpressionsOnce) {
  Algebra algebra;
  const Expression one = parse_expression(algebra, "y*sin(x + 2) + 3"),
                   other = parse_expression(algebra, "3+sin(2+x)*y");
  EXPECT_EQ(one, other);
  EXPECT_NE(one, parse_expression(algebra, "3 + sin(2 + x)*z"));
}

TEST(Algebra, HoldsEvolvedFormulasAsTheyAre) {
  Algebra algebra;
  const Tree tree = parse("theta % (theta - theta) + SQRTp(theta)");
  const Expression expression = algebra.formula("g1", tree, {algebra.symbol("a") + 1.0});
  EXPECT_EQ(value_of(expression, {{"a", 3.0}}), 3.0);
  const double slope = value_of(derivative(expression, "a"), {{"a", 3.0}});
  EXPECT_NEAR(slope, 0.25, 1e-12);
}

}  // namespace
}  // namespace demecal
