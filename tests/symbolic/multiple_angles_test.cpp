// Harmonics of one angle are computed from its own sine and cosine.
#include "symbolic/multiple_angles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "symbolic/calculus.hpp"
#include "symbolic/parse_expression.hpp"

namespace demecal {
namespace {

/// The values of the results at q1, step by step.
std::vector<double> stepped_values(const Steps& steps, double q1) {
  Algebra algebra;
  SymbolValues known{{"q1", q1}};
  for (const auto& [name, value] : steps.assignments) known[name] = value_of(parse_expression(algebra, value), known);
  std::vector<double> values;
  for (const std::string& result : steps.results) values.push_back(value_of(parse_expression(algebra, result), known));
  return values;
}

int calls_of_waves(const Steps& steps) {
  int calls = 0;
  const auto count = [&](const std::string& text) {
    for (const char* call : {"sin(", "cos("})
      for (std::size_t at = 0; (at = text.find(call, at)) != std::string::npos; ++at) ++calls;
  };
  for (const auto& step : steps.assignments) count(step.second);
  for (const std::string& result : steps.results) count(result);
  return calls;
}

TEST(MultipleAngles, AreAsTheirSinesAndCosines) {
  Algebra algebra;
  const Expression q1 = algebra.symbol("q1"), root = square_root(q1 * q1 + 1.0);
  std::vector<Expression> waves;
  for (const Expression angle : {q1, root})
    for (const double times : {1.0, 2.0, 3.0, 50.0, 101.0}) {
      waves.push_back(sine(algebra.sum({{angle, times}})));
      waves.push_back(2.0 * cosine(algebra.sum({{angle, times}})) + q1);
    }
  const Steps steps = plan_steps_with_multiples(waves, ExpressionPrinter(CodeLanguage::c));
  for (const double at : {-3.0, -0.1, 0.0, 0.7, 2.9}) {
    const std::vector<double> values = stepped_values(steps, at);
    const std::vector<double> expected = values_of(waves, {{"q1", at}});
    for (std::size_t i = 0; i < waves.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-13) << at << ' ' << i;
  }
}

TEST(MultipleAngles, TakeNoFurtherCalls) {
  Algebra algebra;
  const Expression q1 = algebra.symbol("q1"), twice = sine(2.0 * q1), fifty = cosine(50.0 * q1);
  const ExpressionPrinter printer(CodeLanguage::c);
  EXPECT_EQ(calls_of_waves(plan_steps_with_multiples({twice, fifty, twice * fifty}, printer)), 2);
  EXPECT_EQ(calls_of_waves(plan_steps_with_multiples({fifty}, printer)), 1) << "one call is cheaper than the steps";
  EXPECT_EQ(calls_of_waves(plan_steps_with_multiples({twice, sine(2.5 * q1)}, printer)), 2) << "of no whole multiple";
}

}  // namespace
}  // namespace demecal
