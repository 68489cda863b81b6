#include "report/effect_entry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/amount.hpp"

namespace demecal {
namespace {

using Json = nlohmann::ordered_json;

/// Settings that tell effects of one kind and joint apart.
constexpr std::array<const char*, 3> kTelling{"ratio", "order", "from"};

/// The form, where it is not the one that a kind without words for it has.
std::string unusual_form(const EffectEntry& effect) {
  const EffectLaw* const law = find_law(effect.kind);
  const std::vector<std::string> forms = law == nullptr ? std::vector<std::string>{} : law->forms();
  return !forms.empty() && forms.front() == effect.form ? "" : effect.form;
}

Json numbers(const std::vector<NamedNumber>& parameters, std::optional<double> NamedNumber::*which) {
  Json json = Json::object();
  for (const NamedNumber& parameter : parameters) {
    const std::optional<double>& number = parameter.*which;
    const bool finite = number && std::isfinite(*number);
    if (number || which == &NamedNumber::value) json[parameter.name] = finite ? Json(*number) : Json(nullptr);
  }
  return json;
}

}  // namespace

std::optional<double> EffectEntry::parameter(const std::string& wanted) const {
  const auto found = std::ranges::find(parameters, wanted, &NamedNumber::name);
  return found == parameters.end() ? std::nullopt : found->value;
}

std::string EffectEntry::telling() const {
  std::string text = unusual_form(*this);
  for (const char* const setting : kTelling) {
    const std::optional<double> value = parameter(setting);
    if (value) text += fmt::format("{}{} {:g}", text.empty() ? "" : ", ", setting, *value);
  }
  return text;
}

std::string EffectEntry::name() const {
  const std::string which = telling();
  return kind + (which.empty() ? "" : " (" + which + ")") + (joint ? fmt::format(", joint {}", *joint) : "");
}

std::string EffectEntry::size() const {
  return amplitude ? amount(*amplitude, unit) : "";
}

std::vector<CoefficientLabel> labels_of(const Effect& effect, const Robot& robot) {
  const EffectLaw* const law = find_law(effect.kind);
  return law == nullptr ? std::vector<CoefficientLabel>{} : law->coefficients(effect, robot);
}

std::optional<double> amplitude_of(const Effect& effect, const std::vector<CoefficientLabel>& labels) {
  const std::size_t count = std::min(effect.values.size(), labels.size());
  if (count == 0) return std::nullopt;
  double size = 0.0;
  std::size_t alike = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (labels[i].unit != labels[0].unit) continue;
    size = std::hypot(size, effect.values[i]);
    ++alike;
  }
  return alike == 1 ? effect.values[0] : size;
}

EffectEntry effect_entry(const Effect& effect, const Robot& robot) {
  EffectEntry entry{
      .kind = effect.kind, .joint = {}, .form = effect.form, .parameters = {}, .amplitude = {}, .unit = {}};
  if (effect.joint >= 0) entry.joint = static_cast<std::uint64_t>(effect.joint) + 1;
  for (const auto& [name, value] : effect.settings) entry.parameters.push_back({name, value});
  const std::vector<CoefficientLabel> labels = labels_of(effect, robot);
  for (std::size_t i = 0; i < std::min(labels.size(), effect.values.size()); ++i) {
    const bool known = i < effect.standard_errors.size();
    entry.parameters.push_back(
        {labels[i].name, effect.values[i], known ? std::optional(effect.standard_errors[i]) : std::nullopt});
  }
  entry.amplitude = amplitude_of(effect, labels);
  if (entry.amplitude) entry.unit = labels.front().unit;
  return entry;
}

EffectEntry effect_entry(const JsonValue& json) {
  EffectEntry entry{.kind = json["kind"].text(),
                    .joint = json["joint"].count(),
                    .form = json["form"].text(),
                    .parameters = {},
                    .amplitude = json["amplitude"].number(),
                    .unit = json["unit"].text()};
  if (entry.joint == 0) entry.joint.reset();
  const JsonValue errors = json["standard_errors"];
  for (const auto& [name, value] : json["parameters"].members()) {
    entry.parameters.push_back({name, value.number(), errors[name].number()});
  }
  return entry;
}

Json to_json(const EffectEntry& effect) {
  Json json{{"kind", effect.kind}, {"joint", effect.joint ? Json(*effect.joint) : Json(nullptr)}};
  if (!effect.form.empty()) json["form"] = effect.form;
  json["parameters"] = numbers(effect.parameters, &NamedNumber::value);
  const Json errors = numbers(effect.parameters, &NamedNumber::standard_error);
  if (!errors.empty()) json["standard_errors"] = errors;
  if (effect.amplitude) {
    json["amplitude"] = std::isfinite(*effect.amplitude) ? Json(*effect.amplitude) : Json(nullptr);
    json["unit"] = effect.unit;
  }
  return json;
}

}  // namespace demecal
