#include "baselines/comparison.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace demecal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> kSets{"calibration", "validation", "accept"};

std::string cell(double figure_mm) {
  return std::isnan(figure_mm) ? "-" : fmt::format("{:.4f}", figure_mm);
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json figures_json(const ErrorFigures& figures) {
  return {{"mean", number(figures.mean_mm)},
          {"rms", number(figures.rms_mm)},
          {"p95", number(figures.p95_mm)},
          {"max", number(figures.max_mm)}};
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
  const auto& [calibration, validation, accept] = comparison.poses;
  std::string text = fmt::format("{} on {}: {} poses fitted, {} of validation, {} of acceptance\n\n", comparison.robot,
                                 comparison.data, calibration, validation, accept);
  text += fmt::format("{:42}{:>8}{:>20}{:>20}{:>9}\n", "", "", "validation, mm", "accept, mm", "");
  text += fmt::format("{:42}{:>8}{:>10}{:>10}{:>10}{:>10}{:>9}\n", "method", "numbers", "mean", "rms", "mean", "rms",
                      "time, s");
  std::string notes;
  for (const ComparedMethod& method : comparison.methods) {
    const ErrorFigures &on_validation = method.figures[1], &on_accept = method.figures[2];
    text += fmt::format("{:42}{:>8}{:>10}{:>10}{:>10}{:>10}{:>9.2f}\n", method.title, method.parameters,
                        cell(on_validation.mean_mm), cell(on_validation.rms_mm), cell(on_accept.mean_mm),
                        cell(on_accept.rms_mm), method.wall_s);
    if (!method.chosen.empty()) notes += fmt::format("  {}: {}\n", method.title, method.chosen);
  }
  if (!notes.empty()) text += "\nchosen by cross-validation within the poses fitted, and notes:\n" + notes;
  return text;
}

std::string comparison_json(const Comparison& comparison, int indent) {
  Json json{{"demecal_comparison", 1},
            {"job", comparison.job},
            {"robot", comparison.robot},
            {"data", comparison.data},
            {"data_sha256", comparison.data_sha256}};
  for (std::size_t set = 0; set < kSets.size(); ++set) json["poses"][kSets[set]] = comparison.poses[set];
  json["methods"] = Json::array();
  for (const ComparedMethod& method : comparison.methods) {
    Json entry{{"method", method.key},
               {"title", method.title},
               {"parameters", method.parameters},
               {"wall_s", method.wall_s},
               {"chosen", method.chosen}};
    for (std::size_t set = 0; set < kSets.size(); ++set) {
      entry["error_mm"][kSets[set]] = figures_json(method.figures[set]);
    }
    json["methods"].push_back(std::move(entry));
  }
  return json.dump(indent) + '\n';
}

}  // namespace demecal
