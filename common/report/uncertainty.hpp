// How far a corrected position may be off, in the words of the GUM (JCGM 100): contributions, standard uncertainty,
// coverage factor, expanded uncertainty.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"

namespace demecal::inline report {

struct UncertaintyContribution {
  std::string name;
  std::string type;                     ///< "A": from the scatter of measurements; "B": stated by others
  std::optional<double> standard_mm{};  ///< none: not stated
};

/// Of the position of the tool at poses like those it was asked about, measurement noise not included.
struct UncertaintyEntry {
  std::vector<UncertaintyContribution> contributions;
  std::optional<double> standard_mm;      ///< the root of the sum of squares
  std::optional<double> coverage_factor;  ///< 2
  std::optional<double> expanded_mm;      ///< radius that holds about 95 % of positions
  std::string remark;                     ///< where the figures come from
};

/// The coverage factor of all expanded uncertainties.
inline constexpr double kCoverageFactor = 2.0;

/// Over the poses `rows` of `data`, root mean squares. Contributions are scaled by half the quantile of the model's
/// prediction interval, so that kCoverageFactor times the standard uncertainty is the radius that held 95 % of the
/// errors the quantile was found from. `instrument_m`: the expanded uncertainty stated for the instrument. Nothing
/// where the model does not state its covariance.
std::optional<UncertaintyEntry> uncertainty_of(const CalibratedModel& model, const DataSet& data,
                                               std::span<const std::size_t> rows, std::optional<double> instrument_m);

}  // namespace demecal::inline report
