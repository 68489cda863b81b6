// New poses against an old model: rows of unit variance, and how everything that may have changed would move them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline updating {

/// What may happen to an arm between two measurements: what is declared of most models, and what depends on the side a
/// joint comes from or on the temperature; single numbers where they are of a joint.
std::vector<Effect> possible_changes(const DataSet& data, std::span<const std::size_t> poses);

/// Residuals and columns, made independent of unit variance by the model's noise and covariance.
struct ChangeRows {
  Eigen::VectorXd values;
  std::vector<Eigen::MatrixXd> columns;  ///< by effect
};

/// The poses that are compared, and by what.
struct ComparedPoses {
  const CorrectedRobot& robot;  ///< the model's, in the data's frame
  const std::vector<std::size_t>& poses;
  double noise_m = 0.0;      ///< per axis
  bool set_up_anew = false;  ///< the base was found again: it is known to nothing but these poses
};

ChangeRows change_rows(const CalibratedModel& model, const DataSet& data, const ComparedPoses& compared,
                       const std::vector<Effect>& effects);

}  // namespace demecal::inline updating
