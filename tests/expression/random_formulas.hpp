// Random columns, formulas and shared functions for properties.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "expression/shared_function.hpp"
#include "expression/tree.hpp"
#include "random/random_stream.hpp"

namespace demecal {

/// `count` columns of `rows` numbers in [-largest, largest); the very first is 0, where formulas are at their worst.
inline std::vector<std::vector<double>> random_columns(RandomStream& random, std::size_t count, std::size_t rows,
                                                       double largest = 3.0) {
  std::vector<std::vector<double>> columns(count, std::vector<double>(rows));
  for (std::vector<double>& column : columns) {
    for (double& entry : column) entry = random.real(-largest, largest);
  }
  if (rows > 0) columns.front().front() = 0.0;
  return columns;
}

/// Bit by bit, but any two that are not a number.
inline bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// A variable, or a constant in [-1, 1), with equal chances.
inline Tree random_terminal(RandomStream& random, int variables = 1) {
  if (random.chance(0.5))
    return variable_tree(static_cast<std::uint8_t>(random.index(static_cast<std::size_t>(variables))));
  return constant_tree(random.real(-1.0, 1.0));
}

/// A valid tree no deeper than `max_depth`, over all primitives.
inline Tree random_tree(RandomStream& random, int max_depth, int variables = 1) {
  if (max_depth == 0 || random.chance(0.15)) return random_terminal(random, variables);
  const PrimitiveTraits& function = kPrimitives[2 + random.index(kPrimitives.size() - 2)];
  const Tree first = random_tree(random, max_depth - 1, variables);
  if (function.arity == 1) return apply(function.primitive, first);
  return apply(function.primitive, first, random_tree(random, max_depth - 1, variables));
}

/// A sound function: every constant of a random formula a coefficient, every variable an argument, some of them one.
inline SharedFunction random_function(RandomStream& random, int max_depth = 3) {
  while (true) {
    SharedFunction function{random_tree(random, max_depth), 0};
    for (const Node& node : function.body) function.coefficients += node.primitive == Primitive::constant ? 1 : 0;
    int coefficient = 0, argument = function.coefficients;
    const bool one_argument = random.chance(0.3);
    for (Node& node : function.body) {
      if (node.primitive == Primitive::constant)
        node = {Primitive::variable, static_cast<std::uint8_t>(coefficient++), 0.0};
      else if (node.primitive == Primitive::variable)
        node.variable = static_cast<std::uint8_t>(one_argument ? argument : argument++);
    }
    if (!find_fault(function)) return function;
  }
}

/// What a function may be called with: numbers, then formulas.
inline std::vector<Tree> random_places(RandomStream& random, const SharedFunction& function, int max_depth = 2) {
  std::vector<Tree> places;
  for (int i = 0; i < arity(function); ++i) {
    places.push_back(i < function.coefficients ? constant_tree(random.real(-1.0, 1.0))
                                               : random_tree(random, max_depth));
  }
  return places;
}

/// A formula with calls of one of the functions in it, written out.
inline Tree random_calling_tree(RandomStream& random, const std::vector<SharedFunction>& functions, int max_depth) {
  if (max_depth == 0) return random_terminal(random);
  if (random.chance(0.4)) {
    const SharedFunction& function = functions[random.index(functions.size())];
    std::vector<Tree> places = random_places(random, function);
    for (std::size_t i = static_cast<std::size_t>(function.coefficients); i < places.size(); ++i)
      places[i] = random_calling_tree(random, functions, max_depth - 1);
    return expanded(function, places);
  }
  const PrimitiveTraits& function = kPrimitives[2 + random.index(kPrimitives.size() - 2)];
  const Tree first = random_calling_tree(random, functions, max_depth - 1);
  if (function.arity == 1) return apply(function.primitive, first);
  return apply(function.primitive, first, random_calling_tree(random, functions, max_depth - 1));
}

/// The formula with the arguments of commutative functions swapped at random.
inline Tree swapped(RandomStream& random, const Tree& tree, std::size_t& at) {
  const Node node = tree[at++];
  if (arity(node.primitive) == 0) return {node};
  const Tree first = swapped(random, tree, at);
  if (arity(node.primitive) == 1) return apply(node.primitive, first);
  const Tree second = swapped(random, tree, at);
  const bool commutes = node.primitive == Primitive::add || node.primitive == Primitive::multiply ||
                        node.primitive == Primitive::minimum || node.primitive == Primitive::maximum;
  return commutes && random.chance(0.5) ? apply(node.primitive, second, first) : apply(node.primitive, first, second);
}
inline Tree swapped(RandomStream& random, const Tree& tree) {
  std::size_t at = 0;
  return swapped(random, tree, at);
}

}  // namespace demecal
