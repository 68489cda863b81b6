// Raw measurements, as read from their files, brought together: joints, nominal point and measured point of every pose,
// and both frames.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "errors/input_error.hpp"
#include "preparation/named_points.hpp"
#include "preparation/readings.hpp"
#include "preparation/taught_points.hpp"

namespace demecal::inline preparation {

/// One run through a program's points while the instrument read.
struct RawSet {
  PoseSet set = PoseSet::calibration;
  PointFile joints;
  std::string points;              ///< the array of precision points; empty: all
  std::optional<PointFile> poses;  ///< the programmed poses, where they are in a file of their own
  std::string pose_points;         ///< their array; empty: all
  Readings readings;
};

/// What becomes of several readings of one pose.
enum class Repeats {
  average,  ///< one row with their mean
  keep      ///< a row each, repeats of one pose: the data set then has a noise floor
};

struct RawMeasurements {
  std::string name;
  std::string file;  ///< the preparation file, as named to the user
  Robot robot;
  std::optional<TaughtPoints> local_frame;
  Repeats repeats = Repeats::average;
  std::vector<RawSet> sets;            ///< one at least
  std::vector<std::string> assumed{};  ///< of how tables are written; a sentence each
};

/// Where the programmed poses of a set stand, if it has any: a file of their own, or beside the joints.
inline const PointFile& file_of_poses(const RawSet& set) {
  return set.poses ? *set.poses : set.joints;
}

/// For each of `joints`, its programmed pose in file_of_poses(set): the pose with the same key. All or none have one:
/// those that the set names, or without that the one array of poses beside the joints that covers them. Throws
/// InputError where poses that are named do not cover the joints, or several have one key.
std::vector<std::optional<std::size_t>> programmed_poses(const RawSet& set, const std::vector<NamedPoint>& joints);

/// The ways from the instrument's frame to the robot's base.
enum class FrameKind { three_points, best_fit };
inline constexpr std::array<FrameKind, 2> kFrameKinds{FrameKind::three_points, FrameKind::best_fit};
/// "three_points", "best_fit".
std::string_view to_string(FrameKind kind);

struct PreparedPose {
  std::size_t entry = 0;                   ///< in RawMeasurements::sets
  std::string id;                          ///< no two poses share it
  MeasuredPose commanded;                  ///< joints, circumstances, set and line; nothing measured
  std::optional<std::size_t> pose_target;  ///< the programmed pose, where there is one: in Program::targets
  Eigen::Vector3d nominal_m;               ///< the programmed point, or that of the nominal arm at the joints; base
  AveragedReading measured;                ///< instrument's frame
};

struct Prepared {
  std::vector<PreparedPose> poses;                          ///< by entry, in the order of its file of joints
  std::optional<Eigen::Isometry3d> three_points, best_fit;  ///< base_from_instrument
  bool fitted_to_calibration = true;    ///< the best fit is of calibration poses; false: of all, there being too few
  double programmed_from_joints_m = 0;  ///< largest distance of a programmed point from the nominal arm's at its joints

  const std::optional<Eigen::Isometry3d>& frame(FrameKind kind) const {
    return kind == FrameKind::three_points ? three_points : best_fit;
  }
};

/// Joins points and readings of every set. Throws InputError where they do not match, where joints are far outside the
/// arm's limits or a column seems to be in another unit than it claims, or where the measured points are the nominal
/// ones in a mirror.
Prepared prepare_measurements(const RawMeasurements& raw);

/// measured - nominal of every pose in base axes, m. The frame must exist.
std::vector<Eigen::Vector3d> differences(const Prepared& prepared, FrameKind kind);

/// The data set: measured points in the base by that frame, or in the instrument's own where `kind` is empty.
/// Circumstances are kept where every pose has them.
DataSet prepared_data_set(const RawMeasurements& raw, const Prepared& prepared, std::optional<FrameKind> kind);

}  // namespace demecal::inline preparation
