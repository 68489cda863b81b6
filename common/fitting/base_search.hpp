// Finds where the base stands in the instrument's frame, and how the tool is held, from anywhere.
#pragma once

#include <span>

#include "fitting/fit.hpp"

namespace demecal {

/// `start` with base and tools, where declared, placed by least squares over at most options.start_poses poses spread
/// over `poses`: near enough for every parameter to be refined together. Every start is refined a little and the best
/// one to the end. Starts are: the start's own base; the closed-form registration of its predicted points to the
/// measured ones; and options.starts orientations spread evenly over all (super-Fibonacci spiral, Alexa 2022) with the
/// middle of the points brought together or, where only distances were measured, set down around the anchors. The base
/// is searched for only in a data set whose frame is the instrument's. The start's effects are too small to matter to
/// the search, which leaves them out. With options.starts 0 the start is trusted.
CorrectedRobot place(const DataSet& data, std::span<const std::size_t> poses, const DeclaredModel& declared,
                     const CorrectedRobot& start, const FitOptions& options);

}  // namespace demecal
