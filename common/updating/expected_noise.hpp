// How far new measurements scatter about a model's predictions: by the model, or by repeats where these scatter more.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"
#include "updating/repeats.hpp"

namespace demecal::inline updating {

struct ExpectedNoise {
  double noise_m = 0.0;                     ///< of a pose (the mean of its repeats), per axis, with the model's error
  double known_rows = 0.0;                  ///< what is known of its size counts as so many rows
  std::vector<std::string> sentences = {};  ///< for people, where it is not the model's
};

/// At `poses` of `distinct`, which was made of `data`. A model of an old version states no noise: that of these poses
/// about it, base and tool fitted, is taken.
ExpectedNoise expected_noise(const CalibratedModel& model, const CorrectedRobot& robot, const DataSet& data,
                             const DistinctPoses& distinct, std::span<const std::size_t> poses);

}  // namespace demecal::inline updating
