// What the joints' table of a report says: how far each joint was off, and how far it is with its correction.
#pragma once

#include <string>
#include <vector>

#include "calibration/joint_targets.hpp"

namespace demecal {

/// Mean absolute joint error over the calibration poses (thesis Table 6-5), rad.
struct JointSummary {
  int joint = 0;      ///< from 0
  bool kept = false;  ///< whether a correction is in the model
  double before_rad = 0.0;
  double after_rad = 0.0;
  double bound_rad = 0.0;  ///< of the correction over its range
  std::vector<double> discontinuities_rad{};
  std::string note;  ///< why a joint was left neutral; empty where it was not
};

/// One summary per joint of `robot`, without notes. `declared`: the joints' errors before anything but the declared
/// numbers was in the model; `now`: what they are of the robot without its corrections. Errors are 0 where there are
/// no targets.
std::vector<JointSummary> joint_summaries(const JointTargets& declared, const JointTargets& now,
                                          const CorrectedRobot& robot);

/// Whether any joint's correction is not neutral.
bool has_corrections(const CorrectedRobot& robot);

/// The robot with all its corrections neutral.
CorrectedRobot without_corrections(CorrectedRobot robot);

}  // namespace demecal
