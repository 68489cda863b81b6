#include "updating/changed_zeros.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "diagnosis/candidates.hpp"
#include "next_measurement/next_measurement.hpp"
#include "parameters/declared_model.hpp"

namespace demecal::inline updating {
namespace {

constexpr const char* kReference = "reference_celsius";

bool is_of_heat(const ChangeCause& cause) {
  return law_of(cause.effect).prerequisite() == Circumstance::temperature;
}

/// A zero that moves with the temperature.
bool warms(const ChangeCause& cause, const ChangeCause& zero) {
  return is_of_heat(cause) && cause.effect.joint == zero.effect.joint && cause.unit == zero.unit + "/K";
}

std::optional<double> reference_by_model(const CorrectedRobot& robot, const Effect& like) {
  for (const Effect& effect : robot.effects)
    if (effect.kind == like.kind && effect.joint == like.joint && effect.settings.contains(kReference))
      return effect.setting(kReference);
  return std::nullopt;
}

/// Where heat by itself does what was found, the zero is as it was at the temperature of the model, or of some hall.
void compare_with_heat(const ChangeCause& zero, const ChangeCause& heat, WarmedZero& warmed) {
  constexpr double kColdest = 0.0, kWarmest = 45.0, kSure = 2.0;
  warmed.found_celsius = heat.effect.setting(kReference);
  if (heat.size == 0.0) return;
  const double away = zero.size / heat.size;
  warmed.unmoved_celsius = *warmed.found_celsius - away;
  const double uncertainty = std::hypot(zero.standard_error, away * heat.standard_error) / std::abs(heat.size);
  warmed.may_be_heat = warmed.by_model_celsius
                           ? std::abs(*warmed.unmoved_celsius - *warmed.by_model_celsius) < kSure * uncertainty
                           : *warmed.unmoved_celsius > kColdest && *warmed.unmoved_celsius < kWarmest;
}

}  // namespace

std::vector<UnseenZero> unseen_zeros(const ScaledChangeRows& scaled, const ChangeRows& rows,
                                     const std::vector<Effect>& effects, bool set_up_anew) {
  constexpr double kNineInTen = 1.645 + 1.282, kLarge = 10e-3;
  constexpr double kFewest = kNineInTen / kLarge;  // norm of a column per rad or m
  std::vector<UnseenZero> unseen;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (declared_flag(effects[i].kind) != &DeclaredModel::joint_offset || rows.columns[i].norm() >= kFewest) continue;
    const int joint = effects[i].joint;
    const char* why = "the model itself knows it no better. Measure more poses for the calibration";
    if (scaled.columns[i].norm() < kFewest)
      why =
          "the tool point lies on its axis, or close to it, and no orientations are compared. Measure a target beside "
          "that axis, or orientations with a model that was calibrated with them";
    else if (set_up_anew)
      why =
          "the base was found again, and a turn of the base does the same. Leave instrument and base where they were "
          "at "
          "the calibration";
    unseen.push_back({joint, fmt::format("The zero of joint {} cannot be seen by these poses, and may be off: {}.",
                                         joint + 1, why)});
  }
  std::ranges::sort(unseen, {}, &UnseenZero::joint);
  return unseen;
}

std::vector<WarmedZero> warmed_zeros(const std::vector<ChangeCause>& found, const std::vector<ChangeCause>& tried,
                                     const CorrectedRobot& robot) {
  std::vector<WarmedZero> all;
  for (const ChangeCause& zero : found) {
    if (declared_flag(zero.effect.kind) != &DeclaredModel::joint_offset) continue;
    WarmedZero warmed{zero.effect.joint};
    const auto heat = std::ranges::find_if(found, [&](const ChangeCause& cause) { return warms(cause, zero); });
    if (heat != found.end()) {
      warmed.by_model_celsius = reference_by_model(robot, heat->effect);
      compare_with_heat(zero, *heat, warmed);
    } else {
      warmed.may_be_heat = std::ranges::any_of(tried, [&](const ChangeCause& cause) {
        return is_of_heat(cause) && std::ranges::count(zero.rivals, to_string(cause.effect)) > 0;
      });
      if (!warmed.may_be_heat) continue;
    }
    all.push_back(warmed);
  }
  return all;
}

std::string unseen_heat_sentence(const std::vector<ChangeCause>& found, const CorrectedRobot& robot,
                                 const DataSet& data, const std::vector<std::size_t>& poses) {
  const bool zeros = std::ranges::any_of(
      found, [](const ChangeCause& cause) { return declared_flag(cause.effect.kind) == &DeclaredModel::joint_offset; });
  const bool warms = std::ranges::any_of(
      robot.effects, [](const Effect& effect) { return law_of(effect).prerequisite() == Circumstance::temperature; });
  if (!zeros || !warms || evidence_of(data, poses).temperature) return {};
  const bool stated =
      std::ranges::all_of(poses, [&](std::size_t pose) { return data.poses[pose].temperature_celsius.has_value(); });
  return fmt::format("{}: heat cannot be told apart from the zeros that were found.",
                     stated ? "The temperature is the same at all poses" : "The temperature was not recorded");
}

}  // namespace demecal::inline updating
