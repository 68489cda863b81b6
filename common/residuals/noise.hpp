// What noise does to the rows of a field: errors that several poses share.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "products/tall_products.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline residuals {

/// Columns of unit variance each: random effects, marginalised where they are believed to be zero within one.
struct SharedErrors {
  RowMatrix fitted, validation;
};

/// The part of noise.order^2 that the functions of shared_errors() for poses at `places` in the order of measuring do
/// not follow, as NoiseModel::fast has it.
double unfollowed_variance(const NoiseModel& noise, std::span<const std::size_t> places);

/// What repeats of one pose have in common, and what drifts in the order of measuring, of the components that `noise`
/// has; `validation` poses share it with `fitted` ones. The order of measuring is that of the data set. Drift is
/// followed through at most 120 of the fitted poses; of more than 200 repeated poses the error is not modelled.
SharedErrors shared_errors(const NoiseModel& noise, const ResidualField& fitted, const ResidualField& validation);

}  // namespace demecal::inline residuals
