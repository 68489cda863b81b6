#include "fitting/station_scales.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "fitting/least_squares.hpp"

namespace demecal::inline fitting {
namespace {

constexpr double kFewestFree = 1.0;    ///< at and below which rows tell no scale
constexpr double kRowsLikeAll = 10.0;  ///< a station's beyond its own
constexpr double kMostApart = 20.0;

const std::array<double, kRowKinds>& factors_of(const RowScales& scales, const std::string& station) {
  static constexpr std::array<double, kRowKinds> kAlike{1.0, 1.0, 1.0};
  const auto own = std::ranges::find(scales.stations, station, &StationFactors::station);
  return own == scales.stations.end() ? kAlike : own->factors;
}

/// The variance of all stations' rows of a kind over that of the present scale; nothing where too few are free.
std::optional<double> variance_of_all(const StationSums& sums, const RowScales& present, std::size_t kind) {
  double squares = 0.0, freedom = 0.0;
  for (const auto& [station, own] : sums) {
    squares += std::pow(factors_of(present, station)[kind], 2) * own.squares[kind];
    freedom += own.freedom[kind];
  }
  return freedom > kFewestFree ? std::optional(squares / freedom) : std::nullopt;
}

/// `present`: the station's factor until now. `all`: as variance_of_all() has it. `scale`: of all, the new one, beside
/// which no station's is below the smallest.
double factor_of_station(const RowSums& own, double present, double all, double scale, std::size_t kind) {
  const double freedom = own.freedom[kind];
  if (freedom <= kFewestFree || all <= 0.0) return 1.0;
  const double variance = present * present * own.squares[kind] / (freedom * all);
  const double factor = std::pow(variance, 0.5 * freedom / (freedom + kRowsLikeAll));
  return std::max(std::clamp(factor, 1.0 / kMostApart, kMostApart), kSmallestScale / scale);
}

}  // namespace

RowScales rescaled(const StationSums& sums, const RowScales& present) {
  RowScales scales{};
  if (sums.size() > 1)
    for (const auto& [station, own] : sums) scales.stations.push_back({station, factors_of(present, station)});
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    if (present[kind] <= 0) continue;
    const std::optional<double> all = variance_of_all(sums, present, kind);
    scales[kind] = std::max(kSmallestScale, present[kind] * std::sqrt(all.value_or(1.0)));
    if (!all) continue;
    for (auto& [station, factors] : scales.stations)
      factors[kind] = factor_of_station(sums.at(station), factors[kind], *all, scales[kind], kind);
  }
  return scales;
}

bool scales_settled(const RowScales& before, const RowScales& after, double tolerance) {
  const auto settled = [&](double from, double to) { return !(std::abs(to / from - 1.0) > tolerance); };
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    if (before[kind] <= 0) continue;
    if (!settled(before[kind], after[kind])) return false;
    for (const auto& [station, factors] : after.stations)
      if (!settled(factors_of(before, station)[kind], factors[kind])) return false;
  }
  return true;
}

RowScales scales_of_stations(const DataSet& data, const CorrectedRobot& robot,
                             const std::vector<Observation>& observations, const RowScales& pooled) {
  if (data.stations.empty()) return pooled;
  RowScales units{};
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) units[kind] = pooled[kind] > 0 ? 1.0 : 0.0;
  std::map<std::string, std::vector<Observation>> observed;
  for (const Observation& one : observations) observed[data.poses[one.pose].station].push_back(one);
  StationSums sums;
  for (const auto& [station, own] : observed) {
    const RowScales medians = median_deviations(data, robot, own);
    const RowCounts count = count_rows(data, own);
    for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
      sums[station].freedom[kind] = count[kind];
      sums[station].squares[kind] = count[kind] * medians[kind] * medians[kind];
    }
  }
  return rescaled(sums, units);
}

}  // namespace demecal::inline fitting
