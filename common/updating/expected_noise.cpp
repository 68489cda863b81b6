#include "updating/expected_noise.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "fitting/fit.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"

namespace demecal::inline updating {
namespace {

constexpr double kMostKnownRows = 60.0, kFewestKnownRows = 10.0;

/// How far repeats of a pose lie apart, once what their joints differ by is taken away.
struct ScatterOfRepeats {
  double squares_m2 = 0.0, freedom = 0.0;
  double share_of_mean = 1.0;  ///< variance of a pose's mean over that of one measurement, on average
};

/// Of each pose by itself.
std::vector<ScatterOfRepeats> scatter_by_pose(const CorrectedRobot& robot, const DataSet& data,
                                              const DistinctPoses& distinct, std::span<const std::size_t> poses) {
  std::vector<ScatterOfRepeats> all;
  for (const std::size_t pose : poses) {
    const std::vector<std::size_t>& repeats = distinct.repeats[pose];
    if (!data.poses[repeats.front()].position_m) continue;
    Eigen::Matrix3Xd errors_m(3, static_cast<Eigen::Index>(repeats.size()));
    for (std::size_t i = 0; i < repeats.size(); ++i)
      errors_m.col(static_cast<Eigen::Index>(i)) = residual(robot, data, data.poses[repeats[i]]).head<3>();
    const auto count = static_cast<double>(repeats.size());
    all.push_back({(errors_m.colwise() - errors_m.rowwise().mean()).squaredNorm(), 3.0 * (count - 1.0), 1.0 / count});
  }
  return all;
}

/// Of all poses together, without those of which a row is in gross error.
ScatterOfRepeats scatter_of_repeats(const std::vector<ScatterOfRepeats>& all) {
  constexpr double kGross = 25.0;  // of the median: beyond it normal scatter comes once in many million poses
  std::vector<double> variances_m2;
  for (const ScatterOfRepeats& one : all)
    if (one.freedom > 0.0) variances_m2.push_back(one.squares_m2 / one.freedom);
  if (variances_m2.empty()) return {};
  const double most_m2 = kGross * median(variances_m2);
  ScatterOfRepeats sum{0.0, 0.0, 0.0};
  double poses = 0.0;
  for (const ScatterOfRepeats& one : all) {
    if (one.squares_m2 > most_m2 * one.freedom) continue;
    sum.squares_m2 += one.squares_m2;
    sum.freedom += one.freedom;
    sum.share_of_mean += one.share_of_mean;
    poses += 1.0;
  }
  sum.share_of_mean /= poses;
  return sum;
}

ExpectedNoise noise_about_fit(const CorrectedRobot& robot, const DistinctPoses& distinct,
                              std::span<const std::size_t> poses) {
  const Fit fit = fit_registration(distinct.data, poses, {.registration = true, .tool = true}, robot);
  return {std::max(1e-6, fit.sigma_position_m),
          kFewestKnownRows,
          {"The model states no noise (it is of an older version): that of these poses themselves is taken, so that "
           "small changes may be missed."}};
}

/// Noise of the model's station that the data set is named after; of its stations together where there is none.
struct StatedNoise {
  double noise_m = 0.0;
  std::vector<std::string> sentences{};
};

StatedNoise stated_noise(const CalibratedModel& model, const PredictionInterval& interval, const DataSet& data) {
  constexpr double kApart = 2.0;  // times: from there on it matters which station measured
  const std::map<std::string, double>& by_station = interval.station_noise_m;
  if (by_station.empty()) return {interval.noise_m};
  const bool first = !model.stations.empty() && model.stations.front().name == data.name;
  if (const auto own = by_station.find(first ? std::string() : data.name); own != by_station.end())
    return {own->second};
  const auto less = [](const auto& one, const auto& other) { return one.second < other.second; };
  const double finest_m = std::ranges::min_element(by_station, less)->second;
  const double coarsest_m = std::ranges::max_element(by_station, less)->second;
  if (coarsest_m < kApart * finest_m) return {interval.noise_m};
  return {
      interval.noise_m,
      {fmt::format("The model's stations measured with {:.2g} to {:.2g} mm of noise per axis, and this data set has "
                   "the name of none: it is taken to have {:.2g} mm, so that smaller changes may be missed, or a "
                   "coarser instrument's noise be taken for a change. Name it as the station whose instrument "
                   "measured it.",
                   millimetres(finest_m), millimetres(coarsest_m), millimetres(interval.noise_m))}};
}

}  // namespace

ExpectedNoise expected_noise(const CalibratedModel& model, const CorrectedRobot& robot, const DataSet& data,
                             const DistinctPoses& distinct, std::span<const std::size_t> poses) {
  constexpr double kByChance = 0.05, kFewestOfRepeats = 3.0;
  const PredictionInterval stated = model.interval.value_or(PredictionInterval{});
  const StatedNoise of_station = stated_noise(model, stated, data);
  const double by_model_m = std::hypot(of_station.noise_m, stated.model_error_m);
  if (by_model_m <= 0.0) {
    ExpectedNoise noise = noise_about_fit(robot, distinct, poses);
    if (model.interval)
      noise.known_rows = std::clamp(3.0 * static_cast<double>(stated.poses), kFewestKnownRows, kMostKnownRows);
    return noise;
  }
  ExpectedNoise noise{by_model_m, std::clamp(3.0 * static_cast<double>(stated.poses), kFewestKnownRows, kMostKnownRows),
                      of_station.sentences};
  const ScatterOfRepeats scatter = scatter_of_repeats(scatter_by_pose(robot, data, distinct, poses));
  if (scatter.freedom == 0.0) return noise;
  const double variance_m2 = scatter.squares_m2 / scatter.freedom;
  // Repeats scatter with the arm too, which the model counts as its own error.
  const double ratio = variance_m2 / (by_model_m * by_model_m);
  if (ratio <= 1.0 || fisher_p_value(ratio, scatter.freedom, noise.known_rows) >= kByChance) return noise;
  // What the model left of the poses it was fitted to may be of the arm, and stays; what scatters more is new.
  noise.noise_m = std::sqrt(by_model_m * by_model_m + scatter.share_of_mean * variance_m2);
  noise.known_rows = std::clamp(scatter.freedom, kFewestOfRepeats, kMostKnownRows);
  noise.sentences.push_back(fmt::format(
      "Repeats of a pose scatter by {:.2g} mm per axis, more than the model expects ({:.2g} mm): that counts as "
      "noise, so that changes below it may be missed.",
      millimetres(std::sqrt(variance_m2)), millimetres(by_model_m)));
  return noise;
}

}  // namespace demecal::inline updating
