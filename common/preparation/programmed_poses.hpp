// The programmed poses that belong to the joints of a set.
#pragma once

#include <optional>
#include <vector>

#include "errors/input_error.hpp"
#include "preparation/raw_measurements.hpp"

namespace demecal {

/// Where the programmed poses of a set stand, if it has any: a file of their own, or beside the joints.
inline const PointFile& file_of_poses(const RawSet& set) {
  return set.poses ? *set.poses : set.joints;
}

/// For each of `joints`, its programmed pose in file_of_poses(set): the pose with the same key. All or none have one:
/// those that the set names, or without that the one array of poses beside the joints that covers them. Throws
/// InputError where poses that are named do not cover the joints, or several have one key.
std::vector<std::optional<std::size_t>> programmed_poses(const RawSet& set, const std::vector<NamedPoint>& joints);

}  // namespace demecal
