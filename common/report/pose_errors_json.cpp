#include "report/pose_errors_json.hpp"

#include <cmath>

#include "kinematics/units.hpp"
#include "report/json_number.hpp"

namespace demecal {
nlohmann::ordered_json pose_errors_to_json(const std::vector<PoseErrorLine>& lines) {
  auto json = nlohmann::ordered_json::array();
  for (const PoseErrorLine& line : lines) {
    json.push_back({{"id", line.id},
                    {"target", line.target},
                    {"set", line.set},
                    {"before_mm", number_or_null(line.before_mm)},
                    {"after_mm", number_or_null(line.after_mm)},
                    {"interval95_mm", number_or_null(line.interval95_mm)},
                    {"flags", line.flags}});
  }
  return json;
}

nlohmann::ordered_json prediction_to_json(const PredictionInterval& interval) {
  return {{"quantile", number_or_null(interval.quantile)},
          {"noise_mm", millimetres(interval.noise_m)},
          {"distance_noise_mm", millimetres(interval.distance_noise_m)},
          {"model_error_mm", millimetres(interval.model_error_m)},
          {"told_by", interval.fitted ? "calibration" : "validation"},
          {"poses", interval.poses},
          {"gross_errors", interval.gross_errors},
          {"remark", sentence_of(interval)}};
}

}  // namespace demecal
