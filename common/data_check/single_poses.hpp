// Poses that do not fit although the others do, and what would make each fit: outliers, typing errors, exchanged rows.
#pragma once

#include <functional>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/finding.hpp"
#include "data_check/trial_fit.hpp"

namespace demecal {

/// What is known of the rows of a data set by a fit.
struct PointPrediction {
  std::function<Eigen::Vector3d(const TrialRow&)> point;  ///< tool point at the row's joints, m, instrument's frame
  std::function<double(const TrialRow&)> deviations_off;  ///< how far off the row is, in standard deviations
};

/// A finding for each pose among `rows` (of any sets) that lies farther out than 8 standard deviations, than 3.5
/// times what four in five poses keep, and than `least_m`, which good poses may err by: rows whose points fit each
/// other's joints (a cycle of up to four), points that stand beside other joints too, one joint with another value (or
/// two exchanged) by which the pose fits to within the noise and ten times better, and what is left as outliers, each
/// with its error.
std::vector<Finding> find_single_poses(const DataSet& data, const std::vector<TrialRow>& rows,
                                       const PointPrediction& predict, double least_m);

}  // namespace demecal
