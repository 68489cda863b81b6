// The noise of a data set as the residuals of a model show it.
#pragma once

#include "residuals/diagnosed_model.hpp"

namespace demecal {

/// The model with the noise, and the scales of independent noise, that its residuals over the fitted poses show. Poses
/// far out have no part in it. Smooth terms count whether they were chosen or not, slow ones first, as many as leave
/// enough distinct poses: what a choice among them explains by chance is not taken for less noise. The model as it is
/// where its residuals scatter by more than noise may: 1 mrad of a joint, 5 mm that poses share.
DiagnosedModel with_noise_estimated(const DiagnosisProblem& problem, DiagnosedModel model);

}  // namespace demecal
