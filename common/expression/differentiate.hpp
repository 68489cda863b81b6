// The exact derivative of a formula, as a formula.
#pragma once

#include "expression/tree.hpp"

namespace demecal {

/// d tree / d variable. SIGN has derivative 0 and SQRTp(x) has SIGN(x) x' % (SQRTp(x) + SQRTp(x)); where a formula
/// jumps, its derivative is that of the pieces beside the jump. Terms that are zero are left out.
Tree derivative(const Tree& tree, std::uint8_t variable);

}  // namespace demecal
