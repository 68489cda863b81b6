#include "symbolic/spelling.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "errors/check.hpp"
#include "expression/fold.hpp"
#include "symbolic/values.hpp"

namespace demecal {
namespace {

constexpr int kLongestPower = 3;  // written as repeated factors where a language has no operator for it

enum class Precedence { sum, product, whole };  // whole: a name, a number that is not negative, a call

struct Written {
  std::string text;
  Precedence precedence = Precedence::whole;
};

std::string within(const Written& written, Precedence least) {
  return written.precedence < least ? '(' + written.text + ')' : written.text;
}

std::string joined(const std::vector<std::string>& texts, const std::string& between) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : between) + text;
  return all;
}

Function function_of(Primitive primitive) {
  switch (primitive) {
    case Primitive::divide:
      return Function::divide_or_one;
    case Primitive::sine:
      return Function::sine;
    case Primitive::cosine:
      return Function::cosine;
    case Primitive::sign:
      return Function::sign;
    case Primitive::square_root:
      return Function::square_root;
    case Primitive::absolute:
      return Function::absolute;
    case Primitive::logarithm:
      return Function::logarithm_or_zero;
    case Primitive::exponential:
      return Function::bounded_exponential;
    case Primitive::hyperbolic_tangent:
      return Function::hyperbolic_tangent;
    case Primitive::arc_tangent:
      return Function::arc_tangent;
    case Primitive::square:
      return Function::square;
    case Primitive::minimum:
      return Function::lesser;
    case Primitive::maximum:
      return Function::greater;
    default:
      break;
  }
  DEMECAL_CHECK(false, traits(primitive).symbol << " is written with an operator");
}

/// What is written as a call, not as an operator between two arguments.
bool is_called(Primitive primitive) {
  switch (primitive) {
    case Primitive::add:
    case Primitive::subtract:
    case Primitive::multiply:
      return false;
    default:
      return arity(primitive) > 0;
  }
}

/// Writes one expression; calls itself for its parts.
class Writer {
 public:
  Writer(const Spelling& spelling, const NamedTerms& named) : spelling_(spelling), named_(named) {}

  Written part(Expression expression) const {
    const auto name = named_.find(expression->id);
    return name == named_.end() ? whole(expression) : Written{name->second};
  }

  Written whole(Expression expression) const {
    switch (expression->kind) {
      case Kind::constant:
        return {spelling_.number(expression->value), expression->value < 0.0 ? Precedence::sum : Precedence::whole};
      case Kind::symbol:
        return {expression->name};
      case Kind::sum:
        return sum(expression);
      case Kind::product:
        return product(expression->parts);
      case Kind::function:
        break;
    }
    const bool formula = expression->function == Function::formula;
    std::vector<std::string> arguments;
    for (const Part& argument : expression->parts) arguments.push_back(part(argument.first).text);
    return {(formula ? expression->name : spelling_.name(expression->function)) + '(' + joined(arguments, ", ") + ')'};
  }

 private:
  /// Terms that are added stand before those that are subtracted.
  Written sum(Expression expression) const {
    std::string text;
    int terms = 0;
    for (const bool negative : {false, true}) {
      for (const auto& [part, coefficient] : expression->parts) {
        if ((coefficient < 0.0) == negative) append(text, negative, scaled(part, std::abs(coefficient))), ++terms;
      }
      if (expression->value != 0.0 && (expression->value < 0.0) == negative) {
        append(text, negative, spelling_.number(std::abs(expression->value))), ++terms;
      }
    }
    return {text, terms == 1 && text[0] != '-' ? Precedence::product : Precedence::sum};
  }
  static void append(std::string& text, bool negative, const std::string& term) {
    text += text.empty() ? (negative ? "-" : "") : (negative ? " - " : " + ");
    text += term;
  }
  std::string scaled(Expression expression, double coefficient) const {
    const std::string text = within(part(expression), Precedence::product);
    return coefficient == 1.0 ? text : spelling_.number(coefficient) + '*' + text;
  }

  Written product(const std::vector<Part>& parts) const {
    std::vector<std::string> above, below;
    for (const auto& [base, exponent] : parts) {
      (exponent > 0.0 ? above : below).push_back(power(base, static_cast<int>(std::abs(exponent))));
    }
    std::string text = above.empty() ? spelling_.number(1.0) : joined(above, "*");
    if (!below.empty())
      text += '/' + (below.size() == 1 && !has_operator(below[0]) ? below[0] : '(' + joined(below, "*") + ')');
    return {text,
            above.size() == 1 && below.empty() && !has_operator(above[0]) ? Precedence::whole : Precedence::product};
  }
  static bool has_operator(const std::string& power) { return power.find_first_of("*^") != std::string::npos; }

  std::string power(Expression base, int exponent) const {
    const std::string text = within(part(base), Precedence::whole);
    if (exponent == 1) return text;
    const std::string digits = std::to_string(exponent);
    switch (spelling_.language()) {
      case CodeLanguage::python:
        return text + "**" + digits;
      case CodeLanguage::c:
        if (exponent > kLongestPower) return "pow(" + part(base).text + ", " + digits + ')';
        return joined(std::vector<std::string>(static_cast<std::size_t>(exponent), text), "*");
      default:
        return text + '^' + digits;
    }
  }

  const Spelling& spelling_;
  const NamedTerms& named_;
};

}  // namespace

std::string Spelling::operator()(Expression expression, const NamedTerms& named) const {
  return Writer(*this, named).whole(expression).text;
}

std::string Spelling::number(double value) const {
  std::array<char, 32> digits;
  std::string text(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
  const bool code = language_ == CodeLanguage::c || language_ == CodeLanguage::python;
  if (code && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string Spelling::name(Function function) const {
  const auto of = [&](const char* c, const char* python, const char* other) -> std::string {
    return language_ == CodeLanguage::c ? c : language_ == CodeLanguage::python ? python : other;
  };
  switch (function) {
    case Function::sine:
      return of("sin", "math.sin", "sin");
    case Function::cosine:
      return of("cos", "math.cos", "cos");
    case Function::hyperbolic_tangent:
      return of("tanh", "math.tanh", "tanh");
    case Function::sign:
      return of("sign_of", "sign_of", "sign");
    case Function::absolute:
      return of("fabs", "abs", "abs");
    case Function::square_root:
      return of("sqrt", "math.sqrt", "sqrt");
    case Function::round:
      return of("round", "round_away", "round");
    case Function::minimum:
      return of("fmin", "min", "min");
    case Function::maximum:
      return of("fmax", "max", "max");
    case Function::divide_or_one:
      return "divide_or_one";
    case Function::divide_or_zero:
      return "divide_or_zero";
    case Function::if_not_negative:
      return "if_not_negative";
    case Function::logarithm_or_zero:
      return "logarithm_or_zero";
    case Function::bounded_exponential:
      return "bounded_exponential";
    case Function::arc_tangent:
      return of("atan", "math.atan", "atan");
    case Function::square:
      return "square";
    case Function::lesser:
      return "lesser_of";
    case Function::greater:
      return "greater_of";
    case Function::formula:
      break;
  }
  DEMECAL_CHECK(false, "an evolved formula has its own name");
}

std::string Spelling::formula(const Tree& tree, const std::vector<std::string>& variables) const {
  const auto binary = [&](Primitive primitive, const Written& left, const Written& right) -> Written {
    if (is_called(primitive)) return {name(function_of(primitive)) + '(' + left.text + ", " + right.text + ')'};
    const Precedence own = primitive == Primitive::multiply ? Precedence::product : Precedence::sum;
    // The order of steps counts: what stands to the right is done first.
    const std::string last = right.precedence <= own ? '(' + right.text + ')' : right.text;
    return {within(left, own) + ' ' + std::string(traits(primitive).symbol) + ' ' + last, own};
  };
  const auto unary = [&](Primitive primitive, const Written& argument) -> Written {
    const bool root = primitive == Primitive::square_root;
    const std::string inside = root ? name(Function::absolute) + '(' + argument.text + ')' : argument.text;
    return {name(function_of(primitive)) + '(' + inside + ')'};
  };
  const auto leaf = [&](const Node& node) -> Written {
    if (node.primitive == Primitive::variable) return {variables[node.variable]};
    return {number(node.value), std::signbit(node.value) ? Precedence::sum : Precedence::whole};
  };
  return fold<Written>(tree, leaf, unary, binary).text;
}

std::set<Function> functions_in(const std::vector<Expression>& expressions) {
  std::set<Function> found;
  for (const Expression term : terms_of(expressions)) {
    if (term->kind != Kind::function) continue;
    if (term->function != Function::formula) {
      found.insert(term->function);
      continue;
    }
    for (const Node& node : term.algebra().tree_of(term->name)) {
      if (is_called(node.primitive)) found.insert(function_of(node.primitive));
    }
  }
  return found;
}

}  // namespace demecal
