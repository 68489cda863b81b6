#include "studies/plan_report.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "data/contacts.hpp"
#include "effects/catalogue.hpp"
#include "effects/effect.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "next_measurement/next_measurement.hpp"
#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "planning/sockets.hpp"
#include "planning/way.hpp"

namespace demecal::inline studies {
namespace {

using Json = nlohmann::ordered_json;

Json error_json(const PredictedError& error) {
  return {{"rms_mm", millimetres(error.rms_m)},
          {"mean_mm", millimetres(error.mean_m)},
          {"p95_mm", millimetres(error.p95_m)}};
}

Json point_json(const Eigen::Vector3d& point_m) {
  Json point = Json::array();
  for (const double metre : point_m) point.push_back(std::round(1e3 * millimetres(metre)) / 1e3);
  return point;
}

/// Sockets that no calibration pose touches are those of accept poses.
bool is_fitted(const Plan& plan, std::size_t socket) {
  return std::ranges::none_of(
      plan.stops, [&](const PlannedStop& stop) { return stop.pose.socket == socket && stop.set == PoseSet::accept; });
}

Json sockets_json(const Plan& plan) {
  Json sockets = Json::array();
  for (std::size_t i = 0; i < plan.sockets.size(); ++i)
    sockets.push_back({{"name", plan.sockets[i].name},
                       {"place_mm", point_json(plan.sockets[i].place_m)},
                       {"fitted", is_fitted(plan, i)}});
  return sockets;
}

Json stop_json(const PlannedStop& stop, const Plan& plan, const Robot& robot) {
  Json joints = Json::array();
  for (int i = 0; i < robot.chain.size(); ++i) {
    const double value = stop.pose.joints[i];
    const double shown = is_revolute(robot.chain, i) ? degrees(value) : millimetres(value);
    joints.push_back(std::round(1e3 * shown) / 1e3);
  }
  Json json{{"id", stop.id}, {"set", std::string(to_string(stop.set))}};
  if (stop.pose.socket) json["contact"] = plan.sockets[*stop.pose.socket].name;
  json["joints_deg_or_mm"] = joints;
  json["tool_mm"] = point_json(tool_position(robot.chain, stop.pose.joints));
  return json;
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

std::vector<std::string> socket_sentences(const Plan& plan) {
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < plan.sockets.size(); ++i) {
    const Eigen::Vector3d place_mm = 1e3 * plan.sockets[i].place_m;
    const auto poses =
        std::ranges::count_if(plan.stops, [&](const PlannedStop& stop) { return stop.pose.socket == i; });
    sentences.push_back(fmt::format("{} at {:.0f}, {:.0f}, {:.0f} mm{}: {} poses", plan.sockets[i].name, place_mm.x(),
                                    place_mm.y(), place_mm.z(), is_fitted(plan, i) ? "" : " (accept alone)", poses));
  }
  for (const KnownDistance& length : plan.lengths)
    sentences.push_back(fmt::format("{} and {}: {:g} mm apart, known to {:g} mm", length.first, length.second,
                                    millimetres(length.length_m), millimetres(length.sigma_m)));
  return sentences;
}

std::string places_sentence(const Plan& plan) {
  std::string text;
  for (const ErrorByPlaces& one : plan.by_places)
    text += fmt::format("{}{}{}: {:.2g} mm", text.empty() ? "" : ", ", one.places,
                        text.empty() ? (one.places == 1 ? " place" : " places") : "", millimetres(one.rms_m));
  return text;
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
            {"random_rms_mm", millimetres(plan.random_rms_m)},
            {"bound_rms_mm", millimetres(plan.bound_rms_m)}};
  json["predicted_error_mm"] = error_json(plan.predicted);
  json["curve"] = Json::array();
  for (const CurvePoint& point : plan.curve) {
    Json one = error_json(point.planned);
    one["poses"] = point.poses;
    one["random_rms_mm"] = millimetres(point.random_rms_m);
    json["curve"].push_back(one);
  }
  if (!plan.sockets.empty()) {
    json["sockets"] = sockets_json(plan);
    json["error_by_places"] = Json::array();
    for (const ErrorByPlaces& one : plan.by_places)
      json["error_by_places"].push_back({{"places", one.places}, {"rms_mm", millimetres(one.rms_m)}});
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
  for (const PlannedStop& stop : plan.stops) json["stops"].push_back(stop_json(stop, plan, request.robot));
  json["by_hand"] = Json::array();
  for (const std::size_t i : plan.way.blocked) json["by_hand"].push_back(plan.stops[i].id);
  json["files"] = files;
  constexpr int kIndent = 1;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace demecal::inline studies
