// Random formulas for property tests.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "expression/tree.hpp"
#include "random/random_stream.hpp"

namespace demecal {

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

}  // namespace demecal
