#include "symbolic/parse_expression.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <system_error>
#include <utility>

#include "errors/input_error.hpp"
#include "expression/text.hpp"
#include "symbolic/calculus.hpp"

namespace demecal::inline symbolic {
namespace {

constexpr double kLargestWrittenExponent = 64.0;  // as written
constexpr double kLargestPower = 4096.0;          // of powers of powers

bool begins_name(char character) {
  return character == '_' || std::isalpha(static_cast<unsigned char>(character));
}

class ExpressionParser {
 public:
  ExpressionParser(Algebra& algebra, std::string_view text, const SymbolNames& names)
      : algebra_(algebra), text_(text), names_(names) {}

  Expression whole() {
    const Expression expression = sum();
    if (at_ < text_.size() || next() != '\0') fail("an operator (+ - * / ^) or the end");
    refuse_excess(expression);
    return expression;
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const { throw_syntax_error(text_, at_, expected); }

  /// Numbers that no double holds, and powers of powers that no code can be written for.
  void refuse_excess(Expression expression) const {
    for (const Expression term : terms_of({&expression, 1})) {
      bool fits = std::isfinite(term->value);
      for (const Part& part : term->parts) {
        fits = fits && std::isfinite(part.second);
        fits = fits && (term->kind != ExpressionKind::product || std::abs(part.second) <= kLargestPower);
      }
      if (!fits) fail("numbers that a double can hold, and powers of at most 4096, before this");
    }
  }

  char next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char character) {
    if (next() != character || at_ == text_.size()) return false;
    ++at_;
    return true;
  }

  // Terms and factors are gathered before they are joined, so that long text takes no longer than it must.
  Expression sum() {
    std::vector<Part> terms{{product(), 1.0}};
    while (true) {
      if (take('+')) {
        terms.emplace_back(product(), 1.0);
      } else if (take('-')) {
        terms.emplace_back(product(), -1.0);
      } else {
        return terms.size() == 1 ? terms[0].first : algebra_.sum(terms);
      }
    }
  }

  Expression product() {
    std::vector<Part> factors{{signed_power(), 1.0}};
    while (true) {
      if (take('*')) {
        factors.emplace_back(signed_power(), 1.0);
      } else if (take('/')) {
        const std::size_t begin = at_;
        factors.emplace_back(signed_power(), -1.0);
        if (!factors.back().first.is(0.0)) continue;
        at_ = begin;
        fail("a divisor that is not 0");
      } else {
        return factors.size() == 1 ? factors[0].first : algebra_.product(factors);
      }
    }
  }

  Expression signed_power() {
    deeper();
    const bool minus = take('-');
    const bool sign = minus || take('+');
    const Expression value = sign ? signed_power() : power();
    --nesting_;
    return minus ? -value : value;
  }

  Expression power() {
    const Expression base = operand();
    if (!take('^')) return base;
    const bool negative = take('-');
    next();
    const std::size_t begin = at_;
    const double exponent = number();
    if (exponent != std::round(exponent) || exponent > kLargestWrittenExponent || (negative && base.is(0.0))) {
      at_ = begin;
      fail("a whole exponent of at most 64, and none below 0 of 0");
    }
    return exponent == 0.0 ? algebra_.constant(1.0) : algebra_.product({{base, negative ? -exponent : exponent}});
  }

  Expression operand() {
    const char first = next();
    if (first == '(') return parenthesis();
    if (first == '.' || std::isdigit(static_cast<unsigned char>(first))) return algebra_.constant(number());
    if (begins_name(first)) return named();
    fail("a number, a name or '('");
  }

  Expression parenthesis() {
    deeper();
    take('(');
    const Expression inside = sum();
    if (!take(')')) fail("an operator (+ - * / ^) or ')'");
    --nesting_;
    return inside;
  }

  void deeper() {
    if (++nesting_ > kDeepestNesting) fail("no more than " + std::to_string(kDeepestNesting) + " nested parentheses");
  }

  double number() {
    double value = 0.0;
    const char* const begin = text_.data() + at_;
    const std::from_chars_result end = std::from_chars(begin, text_.data() + text_.size(), value);
    if (end.ec == std::errc::result_out_of_range) fail("a number that a double can hold");
    if (end.ec != std::errc{} || !std::isfinite(value)) fail("a number");
    at_ += static_cast<std::size_t>(end.ptr - begin);
    return value;
  }

  Expression named() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (begins_name(text_[at_]) || std::isdigit(static_cast<unsigned char>(text_[at_])))) {
      ++at_;
    }
    const std::string name(text_.substr(begin, at_ - begin));
    std::string small = name;
    std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (small == "pi") return algebra_.constant(std::numbers::pi);
    const bool known = small == "sin" || small == "cos" || small == "tan" || small == "sqrt" || small == "abs";
    if (!known) {
      if (next() == '(') fail("an operator, for " + name + " is no function here (sin cos tan sqrt abs)");
      return symbol(name, begin);
    }
    if (next() != '(') fail("'(' after " + name);
    const Expression argument = parenthesis();
    if (small == "sin") return sine(argument);
    if (small == "cos") return cosine(argument);
    if (small == "tan") return sine(argument) / nonzero(cosine(argument));
    if (small == "abs") return algebra_.function(Function::absolute, {argument});
    if (argument.is_constant() && argument->value < 0.0) fail("a root of what is not negative before this");
    return square_root(argument);
  }

  Expression symbol(const std::string& name, std::size_t begin) {
    if (names_.empty()) return algebra_.symbol(name);
    const auto known = names_.find(name);
    if (known != names_.end()) return known->second;
    std::string list;
    for (const auto& entry : names_) list += (list.empty() ? "" : " ") + entry.first;
    at_ = begin;
    fail("one of the names known here (" + list + "), not " + name);
  }

  Expression nonzero(Expression divisor) const {
    if (divisor.is(0.0)) fail("a tangent that is finite before this");
    return divisor;
  }

  Algebra& algebra_;
  std::string_view text_;
  const SymbolNames& names_;
  std::size_t at_ = 0;
  int nesting_ = 0;
};

}  // namespace

Expression parse_expression(Algebra& algebra, std::string_view text, const SymbolNames& names) {
  return ExpressionParser(algebra, text, names).whole();
}

namespace {

SymbolicMatrix identity_matrix(Algebra& algebra) {
  SymbolicMatrix matrix(4, std::vector<Expression>(4, algebra.constant(0.0)));
  for (std::size_t i = 0; i < 4; ++i) matrix[i][i] = algebra.constant(1.0);
  return matrix;
}

}  // namespace

SymbolicMatrix parse_matrix(Algebra& algebra, const MatrixText& text, const SymbolNames& names) {
  SymbolicMatrix matrix = identity_matrix(algebra);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      try {
        matrix[row][column] = parse_expression(algebra, text[row][column], names);
      } catch (const InputError& error) {
        throw InputError(
            error.where(), error.value(),
            "row " + std::to_string(row + 1) + ", element " + std::to_string(column + 1) + ", " + error.rule());
      }
    }
  }
  return matrix;
}

SymbolicMatrix product(const SymbolicMatrix& a, const SymbolicMatrix& b) {
  Algebra& algebra = a[0][0].algebra();
  SymbolicMatrix result = identity_matrix(algebra);
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      std::vector<Part> sum;
      for (std::size_t k = 0; k < 4; ++k) sum.emplace_back(a[row][k] * b[k][column], 1.0);
      result[row][column] = algebra.sum(sum);
    }
  }
  return result;
}

SymbolicMatrix parse_product(Algebra& algebra, const std::vector<MatrixText>& texts) {
  SymbolicMatrix result = identity_matrix(algebra);
  for (const MatrixText& text : texts) result = product(result, parse_matrix(algebra, text));
  return result;
}

SymbolicMatrix derivative(const SymbolicMatrix& matrix, const std::string& symbol) {
  SymbolicMatrix result = matrix;
  for (auto& row : result) {
    for (Expression& element : row) element = derivative(element, symbol);
  }
  return result;
}

std::vector<Expression> elements(const SymbolicMatrix& matrix) {
  std::vector<Expression> all;
  for (const auto& row : matrix) all.insert(all.end(), row.begin(), row.end());
  return all;
}

}  // namespace demecal::inline symbolic
