// Which axes of the measured positions are exchanged or negated, told by where the base then stands.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "data_check/explanations.hpp"

namespace demecal {

/// How a mirrored or exchanged pair of axes reads, by where the base then stands: `sensor_from_base` is that of a fit
/// to points whose y is negated. In a frame that is the base's own, `is_base`, the axes can be named.
Explanation axes_explanation(const Eigen::Isometry3d& sensor_from_base, bool is_base);

/// Whether the map from a base to positions said to be in it is no identity: exchanged axes, a turned first joint, or
/// another frame. Nothing where it is.
std::optional<Explanation> base_frame_explanation(const Eigen::Isometry3d& sensor_from_base);

}  // namespace demecal
