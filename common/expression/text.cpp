#include "expression/text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include "errors/check.hpp"
#include "errors/input_error.hpp"
#include "expression/tree.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline expression {
namespace {

Precedence precedence_of(Primitive function) {
  return function == Primitive::add || function == Primitive::subtract ? Precedence::sum : Precedence::product;
}

std::string constant_text(double constant) {
  std::array<char, 32> digits;
  const std::to_chars_result end = std::to_chars(digits.data(), digits.data() + digits.size(), constant);
  return {digits.data(), end.ptr};
}

bool is_operator(const PrimitiveTraits& function) {
  return function.arity == 2 && std::isalpha(static_cast<unsigned char>(function.symbol.front())) == 0;
}

InfixText joined_texts(Primitive function, InfixText left, InfixText right) {
  if (!is_operator(traits(function)))
    return {std::string(traits(function).symbol) + "(" + left.text + ", " + right.text + ")"};
  const Precedence own = precedence_of(function);
  if (left.precedence < own) left.text = "(" + left.text + ")";
  // Operators bind from the left, and even a sum's order counts: rounding makes a + (b + c) another value.
  const bool begins_with_minus = right.text.front() == '-';
  if (right.precedence <= own || begins_with_minus) right.text = "(" + right.text + ")";
  left.text.append(" ").append(traits(function).symbol).append(" ").append(right.text);
  return {std::move(left.text), own};
}

class FormulaParser {
 public:
  FormulaParser(std::string_view text, const VariableNames& names, std::span<const SharedFunction> functions)
      : text_(text), names_(names), functions_(functions) {}

  Tree whole() {
    Tree tree = chain(Precedence::sum);
    if (at_ < text_.size()) fail("an operator (+ - * %) or the end");
    return tree;
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const { throw_syntax_error(text_, at_, expected); }

  void skip_spaces() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  char next() {
    skip_spaces();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  void take(char character, const std::string& expected) {
    if (next() != character) fail(expected);
    ++at_;
  }

  std::optional<Primitive> operator_of(Precedence precedence) {
    const char character = next();
    for (const PrimitiveTraits& operation : kPrimitives) {
      if (is_operator(operation) && operation.symbol.front() == character &&
          precedence_of(operation.primitive) == precedence) {
        ++at_;
        return operation.primitive;
      }
    }
    return std::nullopt;
  }

  // a - b + c is +(-(a b) c): in prefix form the operators stand first, last one foremost, then the operands in order.
  Tree chain(Precedence precedence) {
    const auto link = [&] { return precedence == Precedence::sum ? chain(Precedence::product) : operand(); };
    Tree operands = link();
    Tree operators;
    while (const std::optional<Primitive> operation = operator_of(precedence)) {
      operators.push_back(Node{*operation, 0, 0.0});
      const Tree right = link();
      operands.insert(operands.end(), right.begin(), right.end());
    }
    operands.insert(operands.begin(), operators.rbegin(), operators.rend());
    return operands;
  }

  Tree operand() {
    const char first = next();
    if (first == '(') return parenthesis();
    if (first == '-' || first == '.' || std::isdigit(static_cast<unsigned char>(first))) return number();
    if (first == '_' || std::isalpha(static_cast<unsigned char>(first))) return named();
    fail("a number, " + known_names() + " or '('");
  }

  Tree parenthesis() {
    if (++nesting_ > kDeepestNesting) fail("no more than " + std::to_string(kDeepestNesting) + " nested parentheses");
    take('(', "'('");
    Tree tree = chain(Precedence::sum);
    take(')', "an operator (+ - * %) or ')'");
    --nesting_;
    return tree;
  }

  Tree call_of_two(Primitive function) {
    if (++nesting_ > kDeepestNesting) fail("no more than " + std::to_string(kDeepestNesting) + " nested parentheses");
    take('(', "'('");
    const Tree left = chain(Precedence::sum);
    take(',', "an operator (+ - * %) or ','");
    const Tree right = chain(Precedence::sum);
    take(')', "an operator (+ - * %) or ')'");
    --nesting_;
    return apply(function, left, right);
  }

  Tree call_of_shared(const SharedFunction& function) {
    if (++nesting_ > kDeepestNesting) fail("no more than " + std::to_string(kDeepestNesting) + " nested parentheses");
    std::vector<Tree> places;
    for (int i = 0; i < arity(function); ++i) {
      take(i == 0 ? '(' : ',', i == 0 ? "'('" : "an operator (+ - * %) or ','");
      places.push_back(chain(Precedence::sum));
      const bool is_number = places.back().front().primitive == Primitive::constant;
      if (i < function.coefficients && !is_number) fail("a number as coefficient before here");
    }
    take(')', "an operator (+ - * %) or ')'");
    --nesting_;
    called_nodes_ += expanded_size(function, places);
    if (called_nodes_ > kLongestExpansion)
      fail("calls that come to no more than " + std::to_string(kLongestExpansion) + " nodes");
    return expanded(function, places);
  }

  Tree number() {
    const bool negative = text_[at_] == '-';
    if (negative) ++at_;
    const char first = next();
    if (first != '.' && !std::isdigit(static_cast<unsigned char>(first))) fail("a number after '-'");
    double value = 0.0;
    const char* const begin = text_.data() + at_;
    const std::from_chars_result end = std::from_chars(begin, text_.data() + text_.size(), value);
    if (end.ec == std::errc::result_out_of_range) fail("a number that a double can hold");
    if (end.ec != std::errc{}) fail("a number");
    at_ += static_cast<std::size_t>(end.ptr - begin);
    return constant_tree(negative ? -value : value);
  }

  Tree named() {
    const std::size_t begin = at_;
    std::size_t end = at_;
    while (end < text_.size() && (text_[end] == '_' || std::isalnum(static_cast<unsigned char>(text_[end])))) ++end;
    const std::string_view name = text_.substr(begin, end - begin);
    for (const PrimitiveTraits& function : kPrimitives) {
      if (function.arity != 0 && !is_operator(function) && function.symbol == name) {
        at_ = end;
        if (next() != '(') fail("'(' after " + std::string(name));
        return function.arity == 1 ? apply(function.primitive, parenthesis()) : call_of_two(function.primitive);
      }
    }
    for (std::size_t i = 0; i < functions_.size(); ++i) {
      if (name != name_of_function(i)) continue;
      at_ = end;
      return call_of_shared(functions_[i]);
    }
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) fail(known_names() + ", not " + std::string(name));
    at_ = end;
    return variable_tree(static_cast<std::uint8_t>(found - names_.begin()));
  }

  std::string known_names() const {
    std::string list;
    for (const std::string& name : names_) list += name + " ";
    for (const PrimitiveTraits& function : kPrimitives) {
      if (function.arity != 0 && !is_operator(function)) list.append(function.symbol).append(" ");
    }
    for (std::size_t i = 0; i < functions_.size(); ++i) list.append(name_of_function(i)).append(" ");
    list.pop_back();
    return list;
  }

  std::string_view text_;
  const VariableNames& names_;
  std::span<const SharedFunction> functions_;
  std::size_t called_nodes_ = 0;
  std::size_t at_ = 0;
  int nesting_ = 0;
};

}  // namespace

VariableNames theta_only() {
  return {"theta"};
}

std::string to_string(std::span<const Node> tree, const VariableNames& names) {
  return fold<InfixText>(
             tree,
             [&](const Node& node) {
               if (node.primitive == Primitive::constant) return InfixText{constant_text(node.value)};
               DEMECAL_CHECK(node.variable < names.size(), "variable=" << int{node.variable});
               return InfixText{names[node.variable]};
             },
             [](Primitive function, const InfixText& argument) {
               return InfixText{std::string(traits(function).symbol) + "(" + argument.text + ")"};
             },
             joined_texts)
      .text;
}

Tree parse(std::string_view text, const VariableNames& names, std::span<const SharedFunction> functions) {
  return FormulaParser(text, names, functions).whole();
}

void throw_syntax_error(std::string_view text, std::size_t position, const std::string& expected) {
  constexpr std::size_t kShown = 80;
  std::string shown(text.substr(0, kShown));
  if (text.size() > kShown) shown += "...";
  throw InputError({}, shown, "column " + std::to_string(position + 1) + ": expected " + expected);
}

}  // namespace demecal::inline expression
