// The exact derivative of a formula, as a formula.
#pragma once

#include <cstdint>

#include "expression/tree.hpp"

namespace demecal {

/// d tree / d variable, simplified only where that keeps every finite value. SIGN has derivative 0, ABS(x) has
/// SIGN(x) * x', EXPb is cut off and MIN and MAX are chosen between by SIGN, SQRTp(x) has
/// SIGN(x) * (x' % (SQRTp(x) + SQRTp(x))) and f % g has SIGN(g) * ((f' - f % g * g') % (SIGN(g) * g)): by the leading
/// SIGN they are 0 wherever % and SQRTp are constant because their argument is 0 throughout. Where a formula jumps, its
/// derivative is that of the pieces beside the jump; at the point of the jump itself it has some finite value.
Tree derivative(const Tree& tree, std::uint8_t variable);

}  // namespace demecal
