#include "preparation/results.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/units.hpp"
#include "prediction/measurement.hpp"
#include "preparation/prepared.hpp"
#include "preparation/readings.hpp"
#include "preparation/taught_points.hpp"

namespace demecal::inline preparation {
namespace {

using Indices = std::vector<std::size_t>;

Indices poses_of_set(const Prepared& prepared, PoseSet set) {
  Indices indices;
  for (std::size_t i = 0; i < prepared.poses.size(); ++i) {
    if (prepared.poses[i].commanded.set == set) indices.push_back(i);
  }
  return indices;
}

std::optional<FrameFigures> figures_in(const Prepared& prepared, const Indices& indices, FrameKind kind) {
  if (!prepared.frame(kind)) return std::nullopt;
  const std::vector<Eigen::Vector3d> differences_m = differences(prepared, kind);
  FrameFigures figures;
  std::vector<double> errors_mm;
  for (const std::size_t i : indices) {
    errors_mm.push_back(millimetres(differences_m[i].norm()));
    figures.mean_difference_mm += 1e3 * differences_m[i] / static_cast<double>(indices.size());
  }
  figures.error = error_figures(std::move(errors_mm));
  return figures;
}

SetStatistic statistic_of_set(const Prepared& prepared, PoseSet set, const Indices& indices) {
  SetStatistic statistic{.set = set,
                         .poses = indices.size(),
                         .three_points = figures_in(prepared, indices, FrameKind::three_points),
                         .best_fit = figures_in(prepared, indices, FrameKind::best_fit)};
  double squares_m2 = 0.0, variances_m2 = 0.0;
  bool stated = true;
  for (const std::size_t i : indices) {
    const AveragedReading& measured = prepared.poses[i].measured;
    statistic.readings += measured.rows.size();
    squares_m2 += measured.squares_m2;
    stated = stated && measured.standard_error_m;
    if (stated) variances_m2 += measured.standard_error_m->squaredNorm();
  }
  const std::size_t beyond_first = statistic.readings - statistic.poses;
  if (beyond_first > 0) statistic.spread_mm = millimetres(std::sqrt(squares_m2 / static_cast<double>(beyond_first)));
  if (stated) {
    statistic.standard_error_mm = millimetres(std::sqrt(variances_m2 / static_cast<double>(indices.size())));
  }
  return statistic;
}

std::optional<FrameDifference> frame_difference(const Prepared& prepared) {
  if (!prepared.three_points || !prepared.best_fit) return std::nullopt;
  FrameDifference found;
  for (const PreparedPose& pose : prepared.poses) {
    const Eigen::Vector3d point_m = pose.measured.point_m;
    const double distance_mm = millimetres((*prepared.three_points * point_m - *prepared.best_fit * point_m).norm());
    found.mean_mm += distance_mm / static_cast<double>(prepared.poses.size());
    found.max_mm = std::max(found.max_mm, distance_mm);
  }
  const Eigen::Quaterniond first(prepared.three_points->linear()), second(prepared.best_fit->linear());
  found.turn_deg = degrees(first.angularDistance(second));
  return found;
}

using Json = nlohmann::ordered_json;

std::string figures_text(const std::optional<FrameFigures>& figures) {
  if (!figures) return fmt::format("  {:>8}{:>8}{:>8}{:>8}", "-", "-", "-", "-");
  const ErrorFigures& error = figures->error;
  return fmt::format("  {:>8.3f}{:>8.3f}{:>8.3f}{:>8.3f}", error.mean_mm, error.rms_mm, error.p95_mm, error.max_mm);
}

std::string frames_sentence(const FrameDifference& apart) {
  return fmt::format(
      "  The three-point frame places the measured points {:.3f} mm (mean; {:.3f} mm at most) from where\n"
      "  the best fit places them, and is turned by {:.4f} deg against it. It carries the errors of its\n"
      "  three points alone: calibration takes that difference for the robot's, unless it fits the base.\n",
      apart.mean_mm, apart.max_mm, apart.turn_deg);
}

std::string readings_sentence(const SetStatistic& set) {
  std::string text;
  if (set.spread_mm) {
    text += fmt::format("  {}: one reading is {:.3f} mm (standard deviation) off its pose's mean ({} readings).\n",
                        to_string(set.set), *set.spread_mm, set.readings);
  }
  if (set.standard_error_mm) {
    text += fmt::format("  {}: by the cords' standard error a point is {:.3f} mm off (root mean square).\n",
                        to_string(set.set), *set.standard_error_mm);
  }
  return text;
}

Json json_of(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json_of(const std::optional<FrameFigures>& figures) {
  if (!figures) return nullptr;
  const ErrorFigures& error = figures->error;
  const Eigen::Vector3d& mean = figures->mean_difference_mm;
  return {{"mean", error.mean_mm},
          {"rms", error.rms_mm},
          {"p95", error.p95_mm},
          {"max", error.max_mm},
          {"mean_difference", Json::array({mean.x(), mean.y(), mean.z()})}};
}

}  // namespace

ErrorStatistic error_statistic(const RawMeasurements& raw, const Prepared& prepared) {
  ErrorStatistic statistic{.apart = frame_difference(prepared),
                           .fitted_to_calibration = prepared.fitted_to_calibration};
  for (const PoseSet set : {PoseSet::calibration, PoseSet::validation, PoseSet::accept}) {
    const Indices indices = poses_of_set(prepared, set);
    if (!indices.empty()) statistic.sets.push_back(statistic_of_set(prepared, set, indices));
  }
  if (raw.local_frame) statistic.taught_difference_mm = millimetres(largest_difference_m(*raw.local_frame));
  return statistic;
}

std::string statistic_table(const ErrorStatistic& statistic, const std::string& name) {
  std::string text = fmt::format("{}: measured - nominal before calibration, mm\n", name);
  text += fmt::format("  {:<12}{:>6}  {:<32}  {}\n", "", "", "  three-point frame", "  best fit");
  text += fmt::format("  {:<12}{:>6}  {:>8}{:>8}{:>8}{:>8}  {:>8}{:>8}{:>8}{:>8}\n", "set", "poses", "mean", "rms",
                      "P95", "max", "mean", "rms", "P95", "max");
  for (const SetStatistic& set : statistic.sets) {
    text += fmt::format("  {:<12}{:>6}", to_string(set.set), set.poses) + figures_text(set.three_points) +
            figures_text(set.best_fit) + '\n';
  }
  if (statistic.apart) text += frames_sentence(*statistic.apart);
  if (statistic.taught_difference_mm) {
    text += fmt::format("  The distances between the three points differ by up to {:.3f} mm in the two frames.\n",
                        *statistic.taught_difference_mm);
  }
  if (!statistic.fitted_to_calibration) {
    text += "  The best fit is of the poses of all sets: those for calibration alone are too few or on a line.\n";
  }
  for (const SetStatistic& set : statistic.sets) text += readings_sentence(set);
  return text;
}

std::string statistic_json(const ErrorStatistic& statistic, const std::string& name, const std::string& frame,
                           const std::vector<std::string>& files) {
  Json json{{"name", name}, {"frame", frame}, {"sets", Json::object()}};
  for (const SetStatistic& set : statistic.sets) {
    json["sets"][std::string(to_string(set.set))] = {{"poses", set.poses},
                                                     {"readings", set.readings},
                                                     {"spread_mm", json_of(set.spread_mm)},
                                                     {"standard_error_mm", json_of(set.standard_error_mm)},
                                                     {"three_points", json_of(set.three_points)},
                                                     {"best_fit", json_of(set.best_fit)}};
  }
  json["frames_apart"] = nullptr;
  if (const auto& apart = statistic.apart) {
    json["frames_apart"] = {{"mean_mm", apart->mean_mm}, {"max_mm", apart->max_mm}, {"turn_deg", apart->turn_deg}};
  }
  json["taught_difference_mm"] = json_of(statistic.taught_difference_mm);
  json["best_fit_of"] = statistic.fitted_to_calibration ? "calibration" : "all";
  json["files"] = files;
  return json.dump() + '\n';
}

}  // namespace demecal::inline preparation
