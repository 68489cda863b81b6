// Finds where the base stands in the instrument's frame, and how the tool is held, from anywhere.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

#include "data/data_set.hpp"
#include "fitting/fit.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline fitting {

/// Farther from where it is described than this another tool was measured; nearer, the described one has an error.
inline constexpr double kOtherTool_m = 0.01;
/// Nearer than this to a described or measured tool point, a stated one means that tool.
inline constexpr double kSameTool_m = 3e-3;

/// `start` with base and tools, where declared, placed by least squares over at most options.start_poses poses spread
/// over `poses`: near enough for every parameter to be refined together. Every start is refined a little and the best
/// one to the end. Starts are: the start's own base; the closed-form registration of its predicted points to the
/// measured ones; and options.starts orientations spread evenly over all (super-Fibonacci spiral, Alexa 2022) with the
/// middle of the points brought together or, where only distances were measured, set down around the anchors. Where
/// that leaves more than 1 mm, every start again with the tools that suit its orientation best. The base
/// is searched for only in a data set whose frame is the instrument's. The start's effects are too small to matter to
/// the search, which leaves them out. With options.starts 0 the start is trusted.
CorrectedRobot locate_base_and_tools(const DataSet& data, std::span<const std::size_t> poses,
                                     const DeclaredModel& declared, const CorrectedRobot& start,
                                     const FitOptions& options);

/// Poses of the base in the measurements' frame that the observations suggest. Where positions were measured: the
/// closed-form registration of `robot`'s points to the measured ones (Horn 1987, Umeyama 1991), then `count`
/// orientations spread over all, the middles of the points brought together. Where only distances were: the `count`
/// best of these orientations set down in 15 places around the anchors. Otherwise: the orientations alone.
std::vector<Eigen::Isometry3d> base_candidates(const DataSet& data, const std::vector<Observation>& observations,
                                               const CorrectedRobot& robot, int count);

/// The `index`-th of `count` rotations spread evenly over all (super-Fibonacci spiral, Alexa 2022).
Eigen::Matrix3d spread_rotation(int index, int count);

}  // namespace demecal::inline fitting
