// Why a data set as a whole does not fit its robot: the reading, the order of rows, or another robot.
#pragma once

#include <vector>

#include "data/data_set.hpp"
#include "data_check/finding.hpp"
#include "data_check/trial_fit.hpp"

namespace demecal {

// What a real arm may leave. Base, tools and links are fitted, links held near their description (5 mm and 1 degree
// standard deviation): five measured series of the shared data then leave .011 to .19 % of their reach at the median, a
// cable-driven arm the most; simulated arms .002 to .023 %; mistakes of a whole set 2.8 % and more. Thus:
inline constexpr double kImplausibleShare = 0.006;  ///< of the reach: more than this no real arm leaves
inline constexpr double kNotableShare = 0.0008;  ///< of the reach: from here on explanations are tried, and poses named

/// The rows of a data set for the check: all of them, and those calibration rows that explanations are tried on.
struct CheckedRows {
  Trial whole;  ///< in the file's order
  Trial trial;
};

/// What contradicts the robot's description, if anything does: `fit` is that of links to `rows.trial`, `placed` that of
/// base and tools alone. Where the median error is notable the explanations of whole_set_explanations(), shifts of rows
/// and moves of the instrument are tried; one that halves the error is named (a move is not: no contradiction). An
/// error that is implausible, and that nothing explains, means shuffled rows or another robot. Where most rows fit and
/// many do not a shift of the others is looked for.
std::vector<Finding> find_contradictions(const DataSet& data, const CheckedRows& rows, const TrialFit& placed,
                                         const TrialFit& fit);

}  // namespace demecal
