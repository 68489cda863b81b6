// Whether anything is left in the residual that depends on how the arm stood: tests that name no effect.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "parameters/observation.hpp"
#include "random/random_stream.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline residuals {

/// The p-value of an omnibus test for dependence. The residual of every pose is taken as an error of each joint in
/// turn; for each joint and each circumstance (every joint's value, approach, torque, payload, temperature, time, and
/// every pair of joint values) poses that are neighbours in that circumstance are asked whether their errors agree more
/// than chance would have it. The largest agreement, each in units of its own scatter under `draws` of noise in place
/// of the whitened residual (a rotation test), is compared with the largest of each draw: family-wise. At most 1000
/// poses take part, evenly spaced. `make` makes the draws.
double structure_p_value(const ResidualField& field, const Projection& model, const Chain& chain, int draws,
                         RandomStream random, const DoWork& make = do_work);

/// Repeats of a pose, from the same sides and station, give the pure error, whatever the model.
struct PureError {
  double deviation_m = 0.0;  ///< of positions, per axis, about the mean of their repeats
  double freedom = 0.0;      ///< degrees of freedom, in rows
  double squares = 0.0;      ///< sum of squared deviations of position rows, m^2
};
/// Nothing where no pose is repeated. A pose counts by its station's factor in `scales`: deviations are then those of a
/// station that is not named.
std::optional<PureError> pure_error(const DataSet& data, std::span<const std::size_t> poses,
                                    const RowScales& scales = {});

/// p-value of the lack-of-fit F test: whether position residuals scatter more than repeats do. `squares_m2` is the sum
/// of squares of the position residuals with `freedom` degrees of freedom.
double lack_of_fit_p_value(const PureError& pure, double squares_m2, double freedom);

}  // namespace demecal::inline residuals
