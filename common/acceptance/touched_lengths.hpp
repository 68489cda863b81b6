// Known lengths between two contacts, as the arm has them each time it touches both ends: what is judged where no
// instrument saw the tool.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "acceptance/certificate.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline acceptance {

/// One length, touched at its two ends in one posture each.
struct TouchedLength {
  const KnownDistance* known = nullptr;
  std::array<std::size_t, 2> rows{};        ///< of the data set, one at each end
  std::array<Eigen::Vector3d, 2> ends_m{};  ///< where the model has the tool there
  double error_m = 0.0;                     ///< of the distance of the two, without its sign
};

/// Whether all of those rows touch points or spheres, and none was measured.
bool touch_alone(const DataSet& data, std::span<const std::size_t> rows);

/// Of the known lengths between contacts that those rows touch, in the rows' order. Every row is an end of one length
/// at most: so many lengths are independent of one another.
std::vector<TouchedLength> touched_lengths(const DataSet& data, std::span<const std::size_t> rows,
                                           const CorrectedRobot& robot);

/// Fills in what these lengths tell of a model. Throws InputError where none is known, or the base was to be fitted.
void judge_lengths(const CalibratedModel& model, const DataSet& data, std::span<const std::size_t> rows,
                   const CertifiedRun& run, Certificate& certificate);

}  // namespace demecal::inline acceptance
