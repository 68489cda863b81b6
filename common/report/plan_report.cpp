#include "report/plan_report.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "effects/catalogue.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "next_measurement/next_measurement.hpp"

namespace demecal::inline report {
namespace {

using Json = nlohmann::ordered_json;

Json error_json(const PredictedError& error) {
  return {{"rms_mm", millimetres(error.rms_m)},
          {"mean_mm", millimetres(error.mean_m)},
          {"p95_mm", millimetres(error.p95_m)}};
}

Json stop_json(const PlannedStop& stop, const Robot& robot) {
  Json joints = Json::array(), tool = Json::array();
  for (int i = 0; i < robot.chain.size(); ++i) {
    const double value = stop.pose.joints[i];
    const double shown = is_revolute(robot.chain, i) ? degrees(value) : millimetres(value);
    joints.push_back(std::round(1e3 * shown) / 1e3);
  }
  for (const double metre : tool_position(robot.chain, stop.pose.joints))
    tool.push_back(std::round(1e3 * millimetres(metre)) / 1e3);
  return {{"id", stop.id}, {"set", std::string(to_string(stop.set))}, {"joints_deg_or_mm", joints}, {"tool_mm", tool}};
}

Json numbers_json(const Plan& plan) {
  Json numbers = Json::array();
  for (const PredictedNumber& number : plan.numbers) {
    const NumberUnit unit = error_unit(number.id);
    numbers.push_back({{"name", number.id.name()},
                       {"standard_error", number.standard_error * unit.per_inside},
                       {"unit", unit.unit},
                       {"identifiable", number.identifiable}});
  }
  return numbers;
}

Json detectable_json(const Plan& plan, const Robot& robot) {
  Json sizes = Json::array();
  for (const DetectableSize& one : plan.detectable) {
    const CoefficientLabel label =
        law_of(one.effect).coefficients(one.effect, robot)[static_cast<std::size_t>(one.coefficient)];
    sizes.push_back({{"kind", one.effect.kind},
                     {"joint", one.effect.joint < 0 ? Json() : Json(one.effect.joint + 1)},
                     {"coefficient", label.name},
                     {"smallest_detectable", one.size},
                     {"unit", label.unit}});
  }
  return sizes;
}

}  // namespace

NumberUnit error_unit(const ParameterId& id) {
  if (id.kind == ParameterId::Kind::effect) return {"SI", 1.0};
  constexpr double kMilli = 1e3;
  return id.is_angle() ? NumberUnit{"mrad", kMilli} : NumberUnit{"mm", kMilli};
}

std::string detectable_text(const DetectableSize& detectable, const Robot& robot) {
  constexpr double kMilli = 1e3;
  const CoefficientLabel label =
      law_of(detectable.effect)
          .coefficients(detectable.effect, robot)[static_cast<std::size_t>(detectable.coefficient)];
  const std::string size = label.unit == "rad" ? fmt::format("{:.3g} mrad", kMilli * detectable.size)
                           : label.unit == "m" ? fmt::format("{:.3g} mm", kMilli * detectable.size)
                                               : fmt::format("{:.2g} {}", detectable.size, label.unit);
  return to_string(detectable.effect) + " (" + label.name + "): " + size;
}

std::vector<std::string> unidentified_sentences(const Plan& plan) {
  std::vector<std::string> sentences;
  for (const UnidentifiedDirection& direction : plan.unidentified) sentences.push_back(direction.sentence());
  return sentences;
}

std::string to_json(const Plan& plan, const PlanRequest& request, const std::vector<std::string>& files) {
  Json json{{"demecal_plan", 1},
            {"robot", request.robot.name},
            {"seed", request.seed},
            {"declared", request.declared.words()},
            {"detect", request.detect},
            {"poses", {{"calibration", plan.counts[0]}, {"validation", plan.counts[1]}, {"accept", plan.counts[2]}}},
            {"noise_mm", millimetres(plan.noise_m)},
            {"predicted_error_mm", {}},
            {"random_rms_mm", millimetres(plan.random_rms_m)}};
  json["predicted_error_mm"] = error_json(plan.predicted);
  json["curve"] = Json::array();
  for (const CurvePoint& point : plan.curve) {
    Json one = error_json(point.planned);
    one["poses"] = point.poses;
    one["random_rms_mm"] = millimetres(point.random_rms_m);
    json["curve"].push_back(one);
  }
  json["numbers"] = numbers_json(plan);
  json["not_identifiable"] = unidentified_sentences(plan);
  json["detectable"] = detectable_json(plan, request.robot);
  json["assumptions"] = plan.assumptions;
  json["warnings"] = plan.warnings;
  Json refused = Json::array();
  for (std::size_t i = 1; i < kObstructions; ++i) {
    if (plan.refused[i] == 0) continue;
    refused.push_back({{"why", std::string(to_string(static_cast<Obstruction>(i)))}, {"poses", plan.refused[i]}});
  }
  json["candidates"] = {{"drawn", plan.drawn}, {"feasible", plan.feasible}, {"refused", refused}};
  json["travel_deg"] = degrees(plan.travel_rad);
  json["stops"] = Json::array();
  for (const PlannedStop& stop : plan.stops) json["stops"].push_back(stop_json(stop, request.robot));
  json["files"] = files;
  constexpr int kIndent = 1;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace demecal::inline report
