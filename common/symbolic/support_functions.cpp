#include "symbolic/support_functions.hpp"

#include <vector>

#include "symbolic/algebra.hpp"

namespace demecal::inline symbolic {

const std::vector<SupportFunction>& support_functions() {
  static const std::vector<SupportFunction> all{
      {Function::sign, "static double sign_of(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : x); }\n",
       "def sign_of(x):\n    return 1.0 if x > 0.0 else (-1.0 if x < 0.0 else x)\n", ""},
      {Function::round, "", "def round_away(x):\n    return math.floor(x + 0.5) if x >= 0.0 else math.ceil(x - 0.5)\n",
       ""},
      {Function::divide_or_one, "static double divide_or_one(double a, double b) { return b == 0.0 ? 1.0 : a / b; }\n",
       "def divide_or_one(a, b):\n    return 1.0 if b == 0.0 else a / b\n",
       "function x = divide_or_one(a, b)\n  if b == 0\n    x = 1;\n  else\n    x = a/b;\n  end\nend\n"},
      {Function::divide_or_zero,
       "static double divide_or_zero(double a, double b) { return b == 0.0 ? 0.0 : a / b; }\n",
       "def divide_or_zero(a, b):\n    return 0.0 if b == 0.0 else a / b\n",
       "function x = divide_or_zero(a, b)\n  if b == 0\n    x = 0;\n  else\n    x = a/b;\n  end\nend\n"},
      {Function::if_not_negative,
       "static double if_not_negative(double c, double a, double b) { return c >= 0.0 ? a : b; }\n",
       "def if_not_negative(c, a, b):\n    return a if c >= 0.0 else b\n",
       "function x = if_not_negative(c, a, b)\n  if c >= 0\n    x = a;\n  else\n    x = b;\n  end\nend\n"},
      {Function::logarithm_or_zero,
       "static double logarithm_or_zero(double x) { return x == 0.0 ? 0.0 : log(fabs(x)); }\n",
       "def logarithm_or_zero(x):\n    return 0.0 if x == 0.0 else math.log(abs(x))\n",
       "function x = logarithm_or_zero(a)\n  if a == 0\n    x = 0;\n  else\n    x = log(abs(a));\n  end\nend\n"},
      {Function::bounded_exponential,
       "static double bounded_exponential(double x) { return exp(x > 16.0 ? 16.0 : (x < -16.0 ? -16.0 : x)); }\n",
       "def bounded_exponential(x):\n    return math.exp(16.0 if x > 16.0 else (-16.0 if x < -16.0 else x))\n",
       "function x = bounded_exponential(a)\n  if a > 16\n    a = 16;\n  end\n  if a < -16\n    a = -16;\n  end\n"
       "  x = exp(a);\nend\n"},
      {Function::square, "static double square(double x) { return x*x; }\n", "def square(x):\n    return x*x\n",
       "function x = square(a)\n  x = a*a;\nend\n"},
      {Function::lesser, "static double lesser_of(double a, double b) { return a < b || a != a ? a : b; }\n",
       "def lesser_of(a, b):\n    return a if a < b or a != a else b\n",
       "function x = lesser_of(a, b)\n  if a < b || isnan(a)\n    x = a;\n  else\n    x = b;\n  end\nend\n"},
      {Function::greater, "static double greater_of(double a, double b) { return a > b || a != a ? a : b; }\n",
       "def greater_of(a, b):\n    return a if a > b or a != a else b\n",
       "function x = greater_of(a, b)\n  if a > b || isnan(a)\n    x = a;\n  else\n    x = b;\n  end\nend\n"}};
  return all;
}

}  // namespace demecal::inline symbolic
