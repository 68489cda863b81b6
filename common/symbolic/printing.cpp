#include "symbolic/printing.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "errors/check.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "primitives/primitive.hpp"
#include "symbolic/calculus.hpp"

namespace demecal::inline symbolic {
namespace {

constexpr int kLongestPower = 3;  // written as repeated factors where a language has no operator for it

std::string in_parentheses_below(Precedence least, const InfixText& part) {
  return part.precedence < least ? '(' + part.text + ')' : part.text;
}

std::string with_separator(const std::vector<std::string>& texts, const std::string& between) {
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
class ExpressionWriter {
 public:
  ExpressionWriter(const ExpressionPrinter& printer, const NamedTerms& named) : printer_(printer), named_(named) {}

  InfixText part(Expression expression) const {
    const auto name = named_.find(expression->id);
    return name == named_.end() ? whole(expression) : InfixText{name->second};
  }

  InfixText whole(Expression expression) const {
    switch (expression->kind) {
      case ExpressionKind::constant:
        return {printer_.number(expression->value), expression->value < 0.0 ? Precedence::sum : Precedence::whole};
      case ExpressionKind::symbol:
        return {expression->name};
      case ExpressionKind::sum:
        return sum(expression);
      case ExpressionKind::product:
        return product(expression->parts);
      case ExpressionKind::function:
        break;
    }
    const bool formula = expression->function == Function::formula;
    std::vector<std::string> arguments;
    for (const Part& argument : expression->parts) arguments.push_back(part(argument.first).text);
    return {(formula ? expression->name : printer_.name(expression->function)) + '(' + with_separator(arguments, ", ") +
            ')'};
  }

 private:
  /// Terms that are added stand before those that are subtracted.
  InfixText sum(Expression expression) const {
    std::string text;
    int terms = 0;
    for (const bool negative : {false, true}) {
      for (const auto& [part, coefficient] : expression->parts) {
        if ((coefficient < 0.0) == negative) append(text, negative, scaled(part, std::abs(coefficient))), ++terms;
      }
      if (expression->value != 0.0 && (expression->value < 0.0) == negative) {
        append(text, negative, printer_.number(std::abs(expression->value))), ++terms;
      }
    }
    return {text, terms == 1 && text[0] != '-' ? Precedence::product : Precedence::sum};
  }
  static void append(std::string& text, bool negative, const std::string& term) {
    text += text.empty() ? (negative ? "-" : "") : (negative ? " - " : " + ");
    text += term;
  }
  std::string scaled(Expression expression, double coefficient) const {
    const std::string text = in_parentheses_below(Precedence::product, part(expression));
    return coefficient == 1.0 ? text : printer_.number(coefficient) + '*' + text;
  }

  InfixText product(const std::vector<Part>& parts) const {
    std::vector<std::string> above, below;
    for (const auto& [base, exponent] : parts) {
      (exponent > 0.0 ? above : below).push_back(power(base, static_cast<int>(std::abs(exponent))));
    }
    std::string text = above.empty() ? printer_.number(1.0) : with_separator(above, "*");
    if (!below.empty())
      text += '/' + (below.size() == 1 && !has_operator(below[0]) ? below[0] : '(' + with_separator(below, "*") + ')');
    return {text,
            above.size() == 1 && below.empty() && !has_operator(above[0]) ? Precedence::whole : Precedence::product};
  }
  static bool has_operator(const std::string& power) { return power.find_first_of("*^") != std::string::npos; }

  std::string power(Expression base, int exponent) const {
    const std::string text = in_parentheses_below(Precedence::whole, part(base));
    if (exponent == 1) return text;
    const std::string digits = std::to_string(exponent);
    switch (printer_.language()) {
      case CodeLanguage::python:
        return text + "**" + digits;
      case CodeLanguage::c:
        if (exponent > kLongestPower) return "pow(" + part(base).text + ", " + digits + ')';
        return with_separator(std::vector<std::string>(static_cast<std::size_t>(exponent), text), "*");
      default:
        return text + '^' + digits;
    }
  }

  const ExpressionPrinter& printer_;
  const NamedTerms& named_;
};

}  // namespace

std::string ExpressionPrinter::operator()(Expression expression, const NamedTerms& named) const {
  return ExpressionWriter(*this, named).whole(expression).text;
}

std::string ExpressionPrinter::number(double value) const {
  std::array<char, 32> digits;
  std::string text(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
  const bool code = language_ == CodeLanguage::c || language_ == CodeLanguage::python;
  if (code && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string ExpressionPrinter::name(Function function) const {
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

std::string ExpressionPrinter::formula(const Tree& tree, const std::vector<std::string>& variables) const {
  const auto binary = [&](Primitive primitive, const InfixText& left, const InfixText& right) -> InfixText {
    if (is_called(primitive)) return {name(function_of(primitive)) + '(' + left.text + ", " + right.text + ')'};
    const Precedence own = primitive == Primitive::multiply ? Precedence::product : Precedence::sum;
    // The order of steps counts: what stands to the right is done first.
    const std::string last = right.precedence <= own ? '(' + right.text + ')' : right.text;
    return {in_parentheses_below(own, left) + ' ' + std::string(traits(primitive).symbol) + ' ' + last, own};
  };
  const auto unary = [&](Primitive primitive, const InfixText& argument) -> InfixText {
    const bool root = primitive == Primitive::square_root;
    const std::string inside = root ? name(Function::absolute) + '(' + argument.text + ')' : argument.text;
    return {name(function_of(primitive)) + '(' + inside + ')'};
  };
  const auto leaf = [&](const Node& node) -> InfixText {
    if (node.primitive == Primitive::variable) return {variables[node.variable]};
    return {number(node.value), std::signbit(node.value) ? Precedence::sum : Precedence::whole};
  };
  return fold<InfixText>(tree, leaf, unary, binary).text;
}

std::set<Function> functions_in(const std::vector<Expression>& expressions) {
  std::set<Function> found;
  for (const Expression term : terms_of(expressions)) {
    if (term->kind != ExpressionKind::function) continue;
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

namespace {

/// Whether writing the expression again costs nothing: a name, a number, or one of them with its sign changed.
bool is_free(const ExpressionNode& term) {
  if (term.kind == ExpressionKind::constant || term.kind == ExpressionKind::symbol) return true;
  return term.kind == ExpressionKind::sum && term.value == 0.0 && term.parts.size() == 1 &&
         term.parts[0].second == -1.0;
}

}  // namespace

Steps plan_steps(const std::vector<Expression>& expressions, const ExpressionPrinter& printer,
                 const std::string& stem) {
  std::map<std::uint32_t, int> written;
  for (const Expression expression : expressions) ++written[expression->id];
  const std::vector<Expression> terms = terms_of(expressions);
  Steps steps;
  std::vector<Expression> shared;
  for (std::size_t i = terms.size(); i-- > 0;) {  // from the whole to its parts
    const ExpressionNode& term = *terms[i];
    const int times = written[term.id];
    const bool named = times > 1 && !is_free(term);
    if (named) shared.push_back(terms[i]);
    for (const auto& [part, amount] : term.parts) {
      const int repeats = term.kind == ExpressionKind::product ? static_cast<int>(std::abs(amount)) : 1;
      written[part->id] += (named ? 1 : times) * repeats;
    }
  }
  std::ranges::reverse(shared);
  for (const Expression term : shared) {
    const std::string name = stem + std::to_string(steps.assignments.size() + 1);
    steps.assignments.emplace_back(name, printer(term, steps.names));
    steps.names.emplace(term->id, name);
  }
  for (const Expression expression : expressions) {
    const auto name = steps.names.find(expression->id);
    steps.results.push_back(name == steps.names.end() ? printer(expression, steps.names) : name->second);
  }
  return steps;
}

}  // namespace demecal::inline symbolic
