#include "config/prediction_text.hpp"

#include "config/yaml_text.hpp"
#include "kinematics/units.hpp"

namespace demecal {

std::string prediction_text(const CalibratedModel& model) {
  if (!model.interval) return {};
  const PredictionInterval& interval = *model.interval;
  return "# Radius that holds 95 % of the errors at a pose: quantile * root of (what the posterior gives there + noise "
         "+ "
         "model error)\nprediction_interval: {quantile: " +
         number_text(interval.quantile) + ", noise_mm: " + millimetres_text(interval.noise_m) +
         ", distance_noise_mm: " + millimetres_text(interval.distance_noise_m) +
         ", model_error_mm: " + millimetres_text(interval.model_error_m) +
         ", poses: " + std::to_string(interval.poses) + ", gross_errors: " + std::to_string(interval.gross_errors) +
         ", told_by: " + (interval.fitted ? "calibration" : "validation") + "}\n";
}

void read_prediction(const YamlNode& file, CalibratedModel& model) {
  const YamlNode* node = file.find("prediction_interval");
  if (node == nullptr) return;
  constexpr int kMostPoses = 1'000'000'000;
  node->with_keys({"quantile", "noise_mm", "distance_noise_mm", "model_error_mm", "poses", "gross_errors", "told_by"});
  const auto length_m = [&](const char* key) { return metres(node->at(key).non_negative()); };
  const auto count = [&](const char* key) {
    return static_cast<std::size_t>(node->at(key).whole_number(0, kMostPoses));
  };
  model.interval =
      PredictionInterval{.quantile = node->at("quantile").non_negative(),
                         .noise_m = length_m("noise_mm"),
                         .distance_noise_m = length_m("distance_noise_mm"),
                         .model_error_m = length_m("model_error_mm"),
                         .poses = count("poses"),
                         .gross_errors = count("gross_errors"),
                         .fitted = node->at("told_by").one_of<bool>({{"validation", false}, {"calibration", true}})};
}

}  // namespace demecal
