// Which of many places of a tool are the same one, when neither the places nor, quite, the tool point are known.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

namespace demecal::inline preparation {

/// The tool point, in the flange's frame, by which most of the flanges agree on few places: least squares over all
/// pairs of flanges, with weights (Geman and McClure's) that give up pairs far apart as their scale falls from 200 to
/// 15 mm, so that pairs of different places stop counting. `nominal_m` holds what the flanges' orientations do not
/// show.
Eigen::Vector3d common_tool_point(const std::vector<Eigen::Isometry3d>& flanges, const Eigen::Vector3d& nominal_m);

/// A group that may be two.
struct DoubtfulSplit {
  std::size_t group = 0;
  std::size_t first = 0, second = 0;  ///< how many places either part has
  double apart_m = 0.0;               ///< mean distance between the parts
};

struct PlaceGroups {
  std::vector<std::size_t> group_of;  ///< of each place; groups are counted in the order of their first places
  std::size_t groups = 0;
  double widest_within_m = 0.0;  ///< largest mean distance at which parts of three places and more became one
  double nearest_apart_m = 0.0;  ///< least at which parts were not, kNeverOne_m where none is nearer
  std::vector<DoubtfulSplit> doubtful{};
};

/// Places whose parts are farther apart on average are never one, m.
inline constexpr double kNeverOne_m = 0.06;

/// Agglomeration by mean distances (average linkage), cut at `gap_m` or, without it, where the ratio of successive mean
/// distances of groups that became one is largest; those below 5 mm count as 5 mm: an arm's own errors. Stray places,
/// fewer than three together, have no say in where.
PlaceGroups group_places(const std::vector<Eigen::Vector3d>& places_m, const std::optional<double>& gap_m);

}  // namespace demecal::inline preparation
