// How large the noise is that measured rows show, and so what noise alone would have left of them.
#pragma once

#include <cstddef>
#include <vector>

#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"
#include "shared_work/null_noise.hpp"

namespace demecal::inline residuals {

/// By what the model leaves of the field.
NullNoise null_noise(const ResidualField& field, const Projection& model);
/// `poses` of the field, by number, ascending.
NullResiduals null_residuals(const ResidualField& field, const Projection& model, std::vector<std::size_t> poses);

}  // namespace demecal::inline residuals
