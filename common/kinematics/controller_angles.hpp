// How controllers write an orientation.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace demecal::inline kinematics {

struct ControllerAngles {
  std::string controller;  ///< "KUKA"
  std::string key;         ///< "kuka_abc_deg": for programs
  std::string names;       ///< "A B C deg"
  std::vector<double> values;
};

/// The rotation as each of the controllers that this program knows would show it: angles in deg, UR's vector in rad.
std::vector<ControllerAngles> controller_angles(const Eigen::Matrix3d& rotation);

}  // namespace demecal::inline kinematics
