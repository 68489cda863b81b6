// What stands behind the public types, and the way from their units to those inside.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "kinematics/chain.hpp"
#include "library/demecal.hpp"
#include "programs/command_model.hpp"
#include "trials/finding.hpp"

namespace demecal::inline library {

struct Arm::Implementation {
  Robot robot;
};

struct Measurements::Implementation {
  DataSet data;  ///< without copies of rows
  DataCheck check;
  std::vector<std::string> findings;
};

/// The model's arm is what its text says: the text's numbers are not the bits of those that were fitted.
struct CalibratedArm::Implementation {
  CalibratedModel model;
  std::string text;  ///< of its model.yaml
};

/// Checked against its arm; throws InputError as load_data_set() does, and where a joint is far outside its limits.
std::shared_ptr<const Measurements::Implementation> checked_measurements(DataSet data);

/// Throws InputError where the numbers are not as many as the arm has joints, or one is not finite.
Stop to_stop(const JointCommand& command, const Chain& chain);
std::vector<double> to_deg_or_mm(const JointVector& joints, const Chain& chain);
ToolPose to_tool_pose(const Eigen::Isometry3d& pose);
PoseSet to_pose_set(PoseUse use);
PoseUse to_pose_use(PoseSet set);

/// The model as commands are corrected by it, with all that it states of how sure it is. `stated_tool_m`: see
/// with_stated_tool().
CommandModel to_command_model(const CalibratedModel& model,
                              const std::optional<Eigen::Vector3d>& stated_tool_m = std::nullopt);

}  // namespace demecal::inline library
