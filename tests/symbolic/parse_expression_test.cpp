// What is no expression or matrix is refused, and it is said where and why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "errors/input_error.hpp"
#include "random/random_stream.hpp"
#include "symbolic/parse_expression.hpp"
#include "symbolic/printing.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

std::string fault_of(const std::string& text) {
  Algebra algebra;
  try {
    parse_expression(algebra, text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ParseExpression, SaysWhereTextIsNoExpression) {
  EXPECT_THAT(fault_of(""), HasSubstr("column 1: expected a number, a name or '('"));
  EXPECT_THAT(fault_of("cos(theta1"), HasSubstr("column 11: expected an operator (+ - * / ^) or ')'"));
  EXPECT_THAT(fault_of("2 * * x"), HasSubstr("column 5"));
  EXPECT_THAT(fault_of("x y"), HasSubstr("column 3: expected an operator"));
  EXPECT_THAT(fault_of("cos theta"), HasSubstr("'(' after cos"));
  EXPECT_THAT(fault_of("foo(x)"), HasSubstr("foo is no function here"));
  EXPECT_THAT(fault_of("x / (1 - 1)"), HasSubstr("column 4: expected a divisor that is not 0"));
  EXPECT_THAT(fault_of("x ^ 1.5"), HasSubstr("whole exponent"));
  EXPECT_THAT(fault_of("tan(PI/2)"), HasSubstr("tangent"));
  EXPECT_THAT(fault_of("x*1e300*1e300"), HasSubstr("numbers that a double can hold"));
  EXPECT_THAT(fault_of("1e300^9 - 1e300^9"), HasSubstr("numbers that a double can hold"));
  EXPECT_THAT(fault_of("sin(1e300^9 - 1e300^9)"), HasSubstr("numbers that a double can hold"));
  EXPECT_THAT(fault_of("((x^64)^64)^64"), HasSubstr("powers of at most 4096"));
  EXPECT_THAT(fault_of("1e999"), HasSubstr("a number that a double can hold"));
  EXPECT_THAT(fault_of(std::string(10000, '(')), HasSubstr("256"));
  EXPECT_THAT(fault_of(std::string(10000, '-') + "x"), HasSubstr("256"));
}

TEST(ParseExpression, NeverDoesWorseThanRefuseSpoiltText) {
  RandomStream stream{611};
  const std::string good = "-(cos(theta1 + PI/2))*(sin(alpha1)^2)/(1.5e-1*d_3) - sqrt(abs(a1))";
  int refused = 0;
  for (int i = 0; i < 5000; ++i) {
    std::string text = good;
    for (int k = 0; k < 3; ++k) text[stream.index(text.size())] = "()+-*/^.e1 x"[stream.index(12)];
    refused += fault_of(text).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 1000);
  EXPECT_LT(refused, 5000);
}

TEST(ParseExpression, ReadsSumsAndProductsOfThousandsOfParts) {
  Algebra algebra;
  std::string sum = "0", product = "1";
  for (int i = 0; i < 20000; ++i) {
    sum += "+sin(x" + std::to_string(i) + ")";
    product += "*x" + std::to_string(i % 100);
  }
  EXPECT_EQ(parse_expression(algebra, sum)->parts.size(), 20000u);
  EXPECT_EQ(parse_expression(algebra, product)->parts.size(), 100u);
}

TEST(ParseExpression, KnowsOnlyTheNamesItIsGiven) {
  Algebra algebra;
  const SymbolNames names{{"theta1", algebra.symbol("q1")}, {"a2", algebra.constant(0.5)}};
  EXPECT_EQ(ExpressionPrinter(CodeLanguage::text)(parse_expression(algebra, "a2*cos(theta1)", names)), "0.5*cos(q1)");
  EXPECT_THROW(parse_expression(algebra, "q1", names), InputError);
}

TEST(ParseMatrix, ReadsTheFirstLinkOfThesisTable54) {
  Algebra algebra;
  const SymbolicMatrix link =
      parse_matrix(algebra, {{{"cos(theta1)", "-cos(PI/2)*sin(theta1)", "sin(PI/2)*sin(theta1)", "0"},
                              {"sin(theta1)", "cos(PI/2)*cos(theta1)", "-sin(PI/2)*cos(theta1)", "0"},
                              {"0", "sin(PI/2)", "cos(PI/2)", "0"}}});
  const ExpressionPrinter text(CodeLanguage::text);
  EXPECT_EQ(text(link[0][2]), "sin(theta1)");
  EXPECT_EQ(text(link[1][2]), "-cos(theta1)");
  EXPECT_TRUE(link[0][1].is(0.0));
  EXPECT_TRUE(link[2][1].is(1.0));
}

TEST(ParseMatrix, SaysInWhichElementTheFaultIs) {
  Algebra algebra;
  MatrixText text{{{"1", "0", "0", "0"}, {"0", "1", "cos(", "0"}, {"0", "0", "1", "0"}}};
  try {
    parse_matrix(algebra, text);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("row 2, element 3, column 5"));
  }
}

}  // namespace
}  // namespace demecal
