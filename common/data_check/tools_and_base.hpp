// Whether tools and base stand where the data set and the robot file say.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/finding.hpp"
#include "data_check/trial_fit.hpp"

namespace demecal {

/// In data said to be in the base's frame: axes, a turn of joint 1, or another frame where the fitted base is not
/// there.
std::vector<Finding> find_other_base(const DataSet& data, const TrialFit& fit);

/// Tools that the points put elsewhere than their description does, by more than 10 mm and than 5 standard deviations:
/// a quarter turn of the last joint, or another tool. `target_of`: the number of each target's tool in `trial`.
std::vector<Finding> find_other_tools(const Trial& trial, const std::map<std::string, int>& target_of,
                                      const TrialFit& fit);

}  // namespace demecal
