// How much the rows of each station scatter, where several measured: instruments are not alike.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "parameters/observation.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline fitting {

inline constexpr double kSmallestScale = 1e-9;  ///< m or rad: exact data must not divide by zero

/// Of one station's rows, per kind: squared residuals over present scales, and the freedom they have left.
struct RowSums {
  std::array<double, kRowKinds> squares{}, freedom{};
};

/// By station, as MeasuredPose names it; one of poses that were all measured from one place.
using StationSums = std::map<std::string, RowSums>;

/// The deviation of every kind of row that the sums show. Of several stations, that of all their rows and each
/// station's own over it: its logarithm by its rows and as if ten more scattered as all do, and within a factor of 20.
RowScales rescaled(const StationSums& sums, const RowScales& present);

/// Whether the scales of all kinds and stations are as they were, within a share of them.
bool scales_settled(const RowScales& before, const RowScales& after, double tolerance);

/// Of several stations: how each one's rows scatter about `robot` by their median, which gross errors cannot drive up.
/// Of one: `pooled`. Kinds that `pooled` does not use are not used.
RowScales scales_of_stations(const DataSet& data, const CorrectedRobot& robot,
                             const std::vector<Observation>& observations, const RowScales& pooled);

}  // namespace demecal::inline fitting
