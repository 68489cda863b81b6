// A calibrated arm as other programs read it: as a URDF, as parameters of ROS 2, and as the calibration of Universal
// Robots' driver.
#pragma once

#include <string>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "closed_calibration/links_alone.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline config {

struct ExportedArm {
  std::string text;
  std::vector<std::string> notes;  ///< sentences: what the format cannot hold, in mm
};

/// The URDF that the robot was imported from, with the origins of its moving joints as they were identified (those of
/// links_alone(), where the model has corrections or effects) and nothing else changed; `file`, where it is not empty,
/// is where it stands now. A new one where the robot was not imported. Throws InputError where the file is not the one
/// that was imported.
ExportedArm calibrated_urdf(const CalibratedModel& model, const std::string& file);

/// The same as the parameter `robot_description` of any ROS 2 node, in a parameter file.
ExportedArm ros2_parameters(const CalibratedModel& model, const std::string& file);

/// The calibration file of Universal Robots' ROS 2 driver: six links' places, by its names. Throws InputError where the
/// robot is not of their kind.
ExportedArm ur_calibration(const CalibratedModel& model);

/// The arm in its own base frame: what a registration cannot tell from the base's place is as it was drawn.
CorrectedRobot in_own_base(const CalibratedModel& model);
/// Sentences on what these links leave out of a model, in mm.
std::vector<std::string> lacks_of_links(const CalibratedModel& model, const LinksAlone& alone);

}  // namespace demecal::inline config
