// Performance criteria of ISO 9283:1998 as far as positions that were measured for calibration can give them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline acceptance {

/// The repeats of one pose, approached from the same side.
struct AttainedPose {
  std::string id, target;
  std::string approach{};         ///< the side each joint came from, "+-0" of three joints; empty: not recorded
  std::vector<std::size_t> rows;  ///< of the data set
  Eigen::Vector3d attained_m = Eigen::Vector3d::Zero();   ///< the barycentre of the measured positions
  Eigen::Vector3d commanded_m = Eigen::Vector3d::Zero();  ///< where the model takes the arm to be sent
  double accuracy_m = 0.0;                                ///< AP (7.2.1): the distance of the two
  std::optional<double> repeatability_m{};  ///< RP (7.2.2): mean + 3 standard deviations of the distances from the
                                            ///< barycentre; of two repeats or more
  bool has_position = true;  ///< else lengths were measured: accuracy_m is the root mean square of their errors
};

/// Of those rows that have a tool error, in the order in which the poses first appear.
std::vector<AttainedPose> attained_poses(const DataSet& data, std::span<const std::size_t> rows,
                                         const CorrectedRobot& robot);

/// The largest error of every pose, over its targets and the sides it was approached from: poses of one id, or at the
/// very same joints, are one and no independent evidence. In the order in which they first appear.
std::vector<double> largest_by_pose(const DataSet& data, const std::vector<AttainedPose>& poses);

/// One criterion: its value, or why the data cannot give it.
struct Characteristic {
  std::string symbol, title;
  std::string clause;                ///< of ISO 9283
  std::optional<double> value_mm{};  ///< none: not measured
  std::string basis;                 ///< what it is of, or what is missing
};

/// AP, RP, vAP, AD, dAP and dRP, in this order.
std::vector<Characteristic> characteristics(const DataSet& data, const std::vector<AttainedPose>& poses,
                                            const CorrectedRobot& robot);

/// What of the standard is not here, in a sentence.
std::string not_implemented();

}  // namespace demecal::inline acceptance
