// A network of radial functions of the joints on what registration leaves of the position.
#pragma once

#include "baselines/baseline.hpp"

namespace demecal {

/// Gaussians about some of the calibration poses, spread as far apart as can be, in joints scaled to what was measured;
/// their number, width and ridge by cross-validation. Orientations are those of the registered arm.
BaselineFit fit_radial_basis(const RegisteredArm& arm);

}  // namespace demecal
