// The check of a data set against its robot: whether what was measured can be what this arm did, and if not, what fits.
#pragma once

#include "data_check/finding.hpp"
#include "effects/corrected_robot.hpp"

namespace demecal {

// What a real arm may leave. Base, tools and links are fitted, links held near their description (5 mm and 1 degree
// standard deviation): measured arms of the shared data then leave .02 to .2 % of their reach at the median,
// cable-driven ones included; makers' figures taken as they are leave .07 to .6 %. Thus:
inline constexpr double kImplausibleShare = 0.006;  ///< of the reach: more than this no real arm leaves
inline constexpr double kNotableShare = 0.0008;     ///< of the reach: from here on other explanations are tried

/// Checks the data before anything is fitted, with the arm of `data.robot` and nothing else known: the measured points
/// against a quick fit that a few wrong rows do not move (trial_fit.hpp). Where its median error is notable the
/// explanations of whole_set_explanations(), shifts of rows and moves of the instrument are tried; one that halves the
/// error is named. An error that is implausible, and that nothing explains, means shuffled rows or another robot. Then
/// sets in another frame or with another tool, tools far from their description, single poses, joints and points that
/// lack spread. A function of the data. Data sets without positions are checked for spread alone.
DataCheck check_data(const DataSet& data);

/// Throws InputError where a joint stands far outside its limits in a pose that no finding names.
void require_joint_limits(const DataSet& data, const DataCheck& check);

/// Adds the single poses (of all sets) that do not fit `robot`, a model fitted to the data, to those that are named
/// already: it sees smaller faults than the quick fit does.
void check_fitted(const DataSet& data, const CorrectedRobot& robot, DataCheck& check);

}  // namespace demecal
