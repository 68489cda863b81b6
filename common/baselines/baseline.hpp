// Methods of the literature that a calibration is compared with, each fitted to the same poses.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "fitting/fit.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline baselines {

/// What every method starts from: the nominal robot in the base, and with the tool where declared, that fit the
/// calibration poses best.
struct RegisteredArm {
  const DataSet& data;
  DeclaredModel base_and_tool;
  std::vector<std::size_t> poses;  ///< of calibration
  CorrectedRobot robot;
  int parameters = 0;  ///< of base and tool
};

/// Fits base and tool. Throws InputError where the calibration poses are too few for that.
RegisteredArm registered_arm(const DataSet& data, const DeclaredModel& declared);

/// A fitted method: where it says that the tool is at a measured pose's joints, in the measurements' frame.
struct BaselineFit {
  std::function<Eigen::Isometry3d(const MeasuredPose&)> predict;
  int parameters = 0;  ///< numbers identified, base and tool included
  std::string chosen;  ///< what cross-validation within the calibration poses chose, or why there is nothing to show
};

struct Baseline {
  std::string key;    ///< "fourier_2"
  std::string title;  ///< for people
  std::function<BaselineFit(const RegisteredArm&)> fit;
};

/// In the order of a table: registration alone, gain and offset of each joint, polynomials (Shamma), Fourier series of
/// order 1 to 3 on all geometric parameters (Everett, Vincze), a radial-basis network on the position's error,
/// Levenberg-Marquardt on offsets and geometry.
const std::vector<Baseline>& all_baselines();

/// Figures on calibration, validation and accept poses; NaN where a set is empty.
std::array<ErrorFigures, 3> figures_by_set(const BaselineFit& fit, const DataSet& data);

}  // namespace demecal::inline baselines
