#include "expression/shared_function.hpp"

#include <algorithm>

#include "errors/check.hpp"
#include "errors/input_error.hpp"
#include "expression/text.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline expression {
namespace {

std::size_t places_in(const Tree& body) {
  std::size_t places = 0;
  for (const Node& node : body)
    if (node.primitive == Primitive::variable) places = std::max<std::size_t>(places, node.variable + std::size_t{1});
  return places;
}

bool leaves_one_out(const Tree& body) {
  for (std::size_t place = 0; place < places_in(body); ++place) {
    const bool stands = std::any_of(body.begin(), body.end(), [place](const Node& node) {
      return node.primitive == Primitive::variable && node.variable == place;
    });
    if (!stands) return true;
  }
  return false;
}

VariableNames place_names(std::size_t coefficients, std::size_t places) {
  VariableNames names;
  for (std::size_t i = 1; i <= coefficients; ++i) names.push_back("c" + std::to_string(i));
  for (std::size_t i = 1; i + coefficients <= places; ++i) names.push_back("a" + std::to_string(i));
  return names;
}

std::string head_text(const VariableNames& names, std::size_t place) {
  std::string text = name_of_function(place) + "(";
  for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : ", ") + names[i];
  return text + ")";
}

std::string without_spaces(std::string_view text) {
  std::string rest(text);
  std::erase(rest, ' ');
  return rest;
}

/// How many of the names in a head begin with the letter.
std::size_t names_with(std::string_view head, char letter) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < head.size(); ++i)
    count += (head[i - 1] == '(' || head[i - 1] == ',') && head[i] == letter ? 1 : 0;
  return count;
}

}  // namespace

std::optional<std::string> find_fault(const SharedFunction& function) {
  const Tree& body = function.body;
  if (body.size() > kLongestBody) return "must have at most " + std::to_string(kLongestBody) + " nodes";
  if (!is_valid(body, 255)) return "must be one complete formula";
  if (contains(body, Primitive::constant)) return "must have no constants";
  if (arity(body.front().primitive) == 0) return "must hold a function";
  if (leaves_one_out(body)) return "must have each of its coefficients and arguments in it";
  if (function.coefficients < 0) return "must not have less than no coefficients";
  if (static_cast<std::size_t>(function.coefficients) >= places_in(body)) return "must take an argument";
  return std::nullopt;
}

int arity(const SharedFunction& function) {
  return static_cast<int>(places_in(function.body));
}

std::size_t expanded_size(const SharedFunction& function, std::span<const Tree> places) {
  DEMECAL_CHECK(places.size() == places_in(function.body), places.size() << " of " << places_in(function.body));
  std::size_t nodes = 0;
  for (const Node& node : function.body)
    nodes += node.primitive == Primitive::variable ? places[node.variable].size() : 1;
  return nodes;
}

Tree expanded(const SharedFunction& function, std::span<const Tree> places) {
  Tree tree;
  tree.reserve(expanded_size(function, places));
  for (const Node& node : function.body) {
    if (node.primitive != Primitive::variable) {
      tree.push_back(node);
      continue;
    }
    const Tree& argument = places[node.variable];
    tree.insert(tree.end(), argument.begin(), argument.end());
  }
  return tree;
}

std::string name_of_function(std::size_t place) {
  return "F" + std::to_string(place + 1);
}

std::string definition_text(const SharedFunction& function, std::size_t place) {
  const VariableNames names = place_names(static_cast<std::size_t>(function.coefficients), places_in(function.body));
  return head_text(names, place) + " = " + to_string(function.body, names);
}

SharedFunction parse_definition(std::string_view text, std::size_t place) {
  const std::string shown(text.substr(0, 80));
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string head = without_spaces(text.substr(0, equals));
  const std::size_t coefficients = names_with(head, 'c'), places = coefficients + names_with(head, 'a');
  const VariableNames names = place_names(coefficients, std::min(places, kLongestBody));
  if (equals == text.size() || head != without_spaces(head_text(names, place)))
    throw InputError({}, shown, "must define " + name_of_function(place) + "(c1, ..., a1, ...) = its formula");
  SharedFunction function{parse(text.substr(equals + 1), names), static_cast<int>(coefficients)};
  if (const auto fault = find_fault(function)) throw InputError({}, shown, *fault);
  return function;
}

}  // namespace demecal::inline expression
