// Residuals dealt out anew among the poses: what luck alone leaves of how they depend on anything.
#pragma once

#include "diagnosis/residual_field.hpp"
#include "random/random_stream.hpp"

namespace demecal {

/// `rows` (the field's) with whole poses' parts in each other's places, at random; only poses with equally many rows
/// change places.
Eigen::VectorXd permuted(const ResidualField& field, const Eigen::VectorXd& rows, RandomStream& random);

}  // namespace demecal
