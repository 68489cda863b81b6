#include "calibration/last_fit.hpp"

#include "calibration/prediction_scores.hpp"
#include "effects/measurement.hpp"

namespace demecal {

DiagnosedModel with_corrections_kept(const DataSet& data, const DeclaredModel& declared, const Fit& fit,
                                     const CorrectedRobot& robot) {
  DeclaredModel without_terms = declared;
  without_terms.joint_corrections = false;
  const DiagnosisProblem of{data, without_terms, poses_of(data, PoseSet::calibration), {}};
  return diagnosed_model(of, loop_start(data, fit, robot));
}

std::optional<LastFit> last_fit(const DataSet& data, const DeclaredModel& declared, LoopEnds ends) {
  if (poses_of_last_fit(data) == poses_of(data, PoseSet::calibration)) return std::nullopt;
  const std::vector<std::size_t> validation = poses_of(data, PoseSet::validation);
  const std::vector<std::size_t> calibration = poses_of(data, PoseSet::calibration);
  UnseenValidation unseen{error_figures(ends.before.robot, data, validation).rms_mm,
                          error_figures(ends.after.robot, data, validation).rms_mm,
                          {}};
  unseen.interval =
      prediction_interval(data, fitted_posterior(data, declared, ends.after.robot, calibration), ends.after.robot);
  for (DiagnosedModel* model : {&ends.before, &ends.after}) {
    *model = final_fit(data, declared, std::move(*model));
    tidy(*model);
  }
  return LastFit{std::move(ends), unseen};
}

}  // namespace demecal
