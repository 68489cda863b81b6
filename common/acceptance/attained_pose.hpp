// What a robot attained where it was sent repeatedly: barycentres, scatter, and which measurements belong together.
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

/// The repeats of one pose, approached from the same side under the same conditions.
struct AttainedPose {
  std::string id, target;         ///< of the first of the repeats
  std::string approach{};         ///< the side each joint came from, "+-0" of three joints; empty: not recorded
  std::size_t place = 0;          ///< see places_of(): of the same joints, whatever the rest
  std::size_t payload = 0;        ///< number of the payload among those that differ; 0: none is stated
  std::size_t temperature = 0;    ///< the same of temperatures
  std::vector<std::size_t> rows;  ///< of the data set
  Eigen::Vector3d attained_m = Eigen::Vector3d::Zero();   ///< the barycentre of the measured positions
  Eigen::Vector3d commanded_m = Eigen::Vector3d::Zero();  ///< where the model takes the arm to be sent
  double accuracy_m = 0.0;                                ///< AP (7.2.1): the distance of the two
  double single_m = 0.0;                                  ///< 95 % of the single measurements err by no more
  std::optional<double> repeatability_m{};  ///< RP (7.2.2): mean + 3 standard deviations of the distances from the
                                            ///< barycentre; of the series of two repeats or more that has the largest
  std::size_t fewest_repeats = 0;           ///< in such a series
  bool has_position = true;  ///< else lengths were measured: accuracy_m is the root mean square of their errors
};

/// Of those rows that have a tool error, in the order in which the poses first appear. Payloads differ by more than
/// 0.1 kg, temperatures by more than 4 degrees, the +-2 of the standard's test.
std::vector<AttainedPose> attained_poses(const DataSet& data, std::span<const std::size_t> rows,
                                         const CorrectedRobot& robot);

/// Repeats apart in time: a gap of ten minutes or more, five times as long as the median one, parts them. One series
/// where times are not stated.
std::vector<std::vector<std::size_t>> in_series(const DataSet& data, std::vector<std::size_t> rows);

/// The same pose with other rows.
AttainedPose with_rows(const DataSet& data, const CorrectedRobot& robot, const AttainedPose& pose,
                       std::vector<std::size_t> rows);

/// The largest error of every place, over its targets, the sides it was approached from and conditions, none of which
/// are independent evidence; in the order in which places first appear.
struct ErrorsByPlace {
  std::vector<double> single_m;  ///< of AttainedPose::single_m
  std::vector<double> mean_m;    ///< of AttainedPose::accuracy_m
};
ErrorsByPlace errors_by_place(const std::vector<AttainedPose>& poses);

}  // namespace demecal::inline acceptance
