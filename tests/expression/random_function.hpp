// Random shared functions and formulas that call them, for property tests.
#pragma once

#include <utility>
#include <vector>

#include "expression/shared_function.hpp"
#include "random_tree.hpp"

namespace demecal {

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
