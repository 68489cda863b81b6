// Kinematics written as matrices of text, for arms that no table of link parameters describes.
#pragma once

#include <filesystem>

#include "symbolic/code.hpp"

namespace demecal {

/// The product of the matrices of a MATRICES.yaml, in their order: `joints` names the joints' symbols, `values` what
/// other symbols are, and each of `matrices` is three rows of four expressions. The joints become q1 .. qn, rad or m,
/// uncorrected. Throws InputError with file, line, value and rule at the first fault; a name that is neither a joint
/// nor a value is one.
Listing load_matrices(Algebra& algebra, const std::filesystem::path& path);

}  // namespace demecal
