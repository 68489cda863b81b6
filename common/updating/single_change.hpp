// What the check for a change finds, as a way of bringing a model up to date: zeros, base and tool that moved, and
// nothing else.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"
#include "updating/prior_model.hpp"

namespace demecal::inline updating {

struct SingleChange {
  CorrectedRobot placed;  ///< the model's robot with what moved where `data` have it
  Moved moved;
};

/// By find_change() on these poses; without any change that is worth naming, the model's robot where it was. Nothing
/// where the poses cannot tell, what changed has no name, or is neither a joint's zero nor the base or the tool, and of
/// several stations and of places touched.
std::optional<SingleChange> single_change(const CalibratedModel& model, const DataSet& data,
                                          const std::vector<std::size_t>& poses);

/// For people: what was changed, and that nothing else was. `as_known`: of the rest of the model, neither.
std::string sentence_of(const Moved& moved, const CorrectedRobot& before, const CorrectedRobot& after, bool as_known);

}  // namespace demecal::inline updating
