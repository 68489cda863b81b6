// Whether a formula keeps to a limit, whatever its variable.
#pragma once

#include <span>

#include "expression/interval.hpp"
#include "expression/tree.hpp"

namespace demecal {

/// Whether the interval of bound() on so many halved pieces of `range` as it takes, at most 2^halvings, lies within
/// -largest and largest: pieces are halved only where they do not. False where a pole cannot be excluded.
bool stays_within(std::span<const Node> tree, Interval range, double largest, int halvings = 8);

}  // namespace demecal
