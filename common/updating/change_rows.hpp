// The rows of unit variance by which new poses are compared with a model, the causes that are tried on them, and how
// far orientations scatter there.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "data/written_steps.hpp"
#include "effects/effect.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline updating {

/// What may happen to an arm between two measurements: what is declared of most models, and what depends on the side a
/// joint comes from or on the temperature; single numbers where they are of a joint. `orientations`: of the tool its
/// turn too.
std::vector<Effect> possible_changes(const DataSet& data, std::span<const std::size_t> poses, bool orientations);

/// The poses that are compared, and by what.
struct ComparedPoses {
  const CorrectedRobot& robot;  ///< the model's, in the data's frame, perhaps with what changed
  const std::vector<std::size_t>& poses;
  double noise_m = 0.0;          ///< per axis
  double orientation_rad = 0.0;  ///< noise of orientations, per axis; 0: they are not compared
  bool set_up_anew = false;      ///< the base was found again: it is known to nothing but these poses
  JointSteps rounding{};         ///< by which joints were rounded when they were written; 0: they are as commanded
};

/// Residuals and columns in units of the noise.
struct ScaledChangeRows {
  Eigen::VectorXd values;
  std::vector<Eigen::MatrixXd> columns;  ///< by effect
  Eigen::MatrixXd covariance;           ///< of what model, base, joints and circumstances add to noise of unit variance
  std::vector<Eigen::Index> first_row;  ///< of each pose compared, and one past the last
  std::vector<Eigen::Index> turned;     ///< rows of orientations
  double unstated_m = 0.0;              ///< how far what poses do not state may move the tool, rms
  double expected_m = 0.0;              ///< rms of what an unchanged robot errs by, once its base is found
};
ScaledChangeRows scaled_change_rows(const CalibratedModel& model, const DataSet& data, const ComparedPoses& compared,
                                    const std::vector<Effect>& effects);

/// The same made independent of unit variance.
struct ChangeRows {
  Eigen::VectorXd values;
  std::vector<Eigen::MatrixXd> columns;
  std::vector<Eigen::Index> first_row;
  double unstated_m = 0.0, expected_m = 0.0;
};
ChangeRows whitened(const ScaledChangeRows& scaled);

/// Without the orientations of poses whose tool's turn the model does not know.
DataSet without_unknown_orientations(const CalibratedModel& model, DataSet data);

struct OrientationNoise {
  double noise_rad = 0.0;  ///< per axis
  double freedom = 0.0;    ///< as of so many rows that is known
};

/// What poses show of it once the model's covariance and all that may have changed are taken out: a model file states
/// none. By restricted maximum likelihood, the noise of positions being known.
OrientationNoise orientation_noise(const CalibratedModel& model, const DataSet& data, const ComparedPoses& compared,
                                   const std::vector<Effect>& effects);

}  // namespace demecal::inline updating
