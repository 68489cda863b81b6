// Known lengths between contacts as a model has them: how far off each is and how sure that is, what those that nothing
// was fitted to say of the model's accuracy, and which tell nothing.
#pragma once

#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"
#include "report/pose_places.hpp"

namespace demecal::inline report {

/// Of every known length between contacts, in every set that touches both its ends. `before`: none where not known.
std::vector<LengthErrorEntry> length_error_entries(const DataSet& data, const CorrectedRobot& robot,
                                                   const CorrectedRobot* before);

/// The one figure without an instrument that shows accuracy and not agreement, and how few touches it rests on. Poses
/// of another set that touch the ends of a fitted length tell nothing new of whether it is as long as it is stated.
std::string unfitted_lengths_sentence(const DataSet& data, const std::vector<LengthErrorEntry>& lengths,
                                      const std::vector<std::string>& fitted_sets);

/// That nothing tells the arm's scale, where calibration poses touch no known length and nothing measures.
std::string unknown_scale_sentence(const DataSet& data);

/// Known lengths of which no set of poses touches both ends, and places of grids that are in no other length: what is
/// stated of these counts nowhere. Empty where there are none.
std::string untold_lengths_sentence(const DataSet& data);

}  // namespace demecal::inline report
