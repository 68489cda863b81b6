// Mistakes in data where poses say what they touch: a whole arm described otherwise, poses at another contact than they
// say, and poses that touch nothing.
#pragma once

#include <vector>

#include "data/data_set.hpp"
#include "data_check/finding.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline data_check {

/// Checks data that contacts alone tell of: tool and links are fitted to the calibration poses, robustly. Where poses
/// then disagree by more than any arm errs, joints' signs are tried, and the description is contradicted. Else single
/// poses are named, of all sets.
std::vector<Finding> check_contacts(const DataSet& data);

/// Poses that the contact they name does not fit: those that fit another one, as wrong_contact, others as outlier.
/// `robot` predicts the tool.
std::vector<Finding> find_wrong_contacts(const DataSet& data, const CorrectedRobot& robot);

}  // namespace demecal::inline data_check
