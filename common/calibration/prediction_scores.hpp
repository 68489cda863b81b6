// How far a model's predictions err, told by poses that had no part in its fit.
#pragma once

#include "calibration/model_posterior.hpp"

namespace demecal {

/// From the validation poses, which must be unseen by the fit that `fitted` (of `robot`) comes from: split conformal
/// prediction of scores |error| / deviation, the deviation that of posterior, noise and model error together. Poses are
/// exchangeable but for repeats: those of one id share one vote. Scores beyond ten times their median are gross errors,
/// and left out. With fewer than 19 distinct poses the quantile is that of normal errors. Without validation poses the
/// calibration poses tell, as far as the fit left their errors visible.
PredictionInterval prediction_interval(const DataSet& data, const FittedPosterior& fitted, const CorrectedRobot& robot);

/// Of a finished calibration: from the validation poses while they were unseen.
PredictionInterval interval_of(const DataSet& data, const DeclaredModel& declared, const Calibration& calibration);

}  // namespace demecal
