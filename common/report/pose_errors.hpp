// The error of every pose, and the radius that was predicted to hold it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibrated_model.hpp"

namespace demecal {

/// One pose (one row of the data set). NaN is what is not known; mm.
struct PoseErrorLine {
  std::string id, target, set;
  double before_mm = 0.0;            ///< of what the closed loop started from
  double after_mm = 0.0;             ///< of the model
  double interval95_mm = 0.0;        ///< radius that holds 95 % of the model's errors there, measurement noise included
  std::vector<std::string> flags{};  ///< "outlier", "near_singular"
};

/// Of all poses of the data, in their order, by a model that predicts them with `robot` (its own, or the same with
/// another base). `before`: none where it is not known.
std::vector<PoseErrorLine> pose_errors(const DataSet& data, const CalibratedModel& model, const CorrectedRobot& robot,
                                       const CorrectedRobot* before);

/// How many accept poses lie within their radius, of how many, and the radii's median, mm.
struct IntervalCoverage {
  std::size_t poses = 0, inside = 0;
  double median_mm = 0.0;
};
IntervalCoverage coverage_of(const std::vector<PoseErrorLine>& lines);

/// Where the radii come from: a sentence for an engineer.
std::string sentence_of(const PredictionInterval& interval);

}  // namespace demecal
