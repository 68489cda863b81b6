// Brings an evolved formula into the form that people write: constants at their least-squares values, round where the
// data allow it.
#pragma once

#include "calibration/formula_misfit.hpp"

namespace demecal {

/// `tree` with its constants (the first 8) where the misfit's sum of squares is least, the formula's amplitude free:
/// Levenberg and Marquardt's steps from where they are. Then, one after another, a constant within 0.15 of a whole or
/// half number is put there where the others, fitted again, make up for it but for what its digits would cost (see
/// description_nats). The tree must be finite at all poses.
Tree polished(const Tree& tree, FormulaMisfit& misfit);

}  // namespace demecal
