// One effect as the report has it: its place, its numbers by name, and how large it is.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "effects/effect.hpp"
#include "report/json_value.hpp"

namespace demecal {

/// A setting or coefficient of an effect, SI.
struct NamedNumber {
  std::string name;  ///< with its unit
  std::optional<double> value;
  std::optional<double> standard_error{};  ///< of coefficients, where known
};

struct EffectEntry {
  std::string kind;                     ///< a word of the catalogue; empty: no effect
  std::optional<std::uint64_t> joint;   ///< from 1; none: of the whole arm or of the instrument
  std::string form;                     ///< of the law, where it has several
  std::vector<NamedNumber> parameters;  ///< settings, then coefficients where they have values
  std::optional<double> amplitude;      ///< see amplitude_of()
  std::string unit;                     ///< of the amplitude

  std::optional<double> parameter(const std::string& name) const;
  /// "ratio 24": form and settings that tell it from others of its kind and joint; empty where there are none.
  std::string telling() const;
  /// "gear_harmonic (ratio 24), joint 2".
  std::string name() const;
  /// "0.412 mrad"; empty where it has no values.
  std::string size() const;
};

EffectEntry effect_entry(const Effect& effect, const Robot& robot);
/// Reads what to_json() wrote; keys may be missing. Joint 0 counts as none.
EffectEntry effect_entry(const JsonValue& json);

/// {kind, joint, form, parameters {name: value}, standard_errors {name: value}, amplitude, unit}, without those that it
/// does not have; joint is null where it is of none.
nlohmann::ordered_json to_json(const EffectEntry& effect);

/// The names and units of the coefficients; none for a kind that is not of the catalogue.
std::vector<CoefficientLabel> labels_of(const Effect& effect, const Robot& robot);

/// How much of an effect there is: its one coefficient, or the root of the sum of squares of those that have the same
/// unit as the first (for a cosine and a sine that is the amplitude of the wave). Nothing without values.
std::optional<double> amplitude_of(const Effect& effect, const std::vector<CoefficientLabel>& labels);

}  // namespace demecal
