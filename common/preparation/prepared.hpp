// Raw measurements brought together: joints, nominal point and measured point of every pose, and both frames.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "preparation/raw_measurements.hpp"

namespace demecal {

/// The ways from the instrument's frame to the robot's base.
enum class FrameKind { three_points, best_fit };
inline constexpr std::array<FrameKind, 2> kFrameKinds{FrameKind::three_points, FrameKind::best_fit};
/// "three_points", "best_fit".
std::string_view word_of(FrameKind kind);

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
DataSet data_set_of(const RawMeasurements& raw, const Prepared& prepared, std::optional<FrameKind> kind);

}  // namespace demecal
