#include "report/figures.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <span>
#include <string_view>

#include "effects/catalogue.hpp"
#include "effects/effect.hpp"

namespace demecal::inline report {
namespace {

bool has_mean(const ErrorBySet& errors) {
  return std::ranges::any_of(kPoseSets,
                             [&](const ReportPoseSet& set) { return (errors.*set.errors).mean_mm.has_value(); });
}

/// What the stage of everything declared adds to the fit.
const char* declared_stage(const Report& report) {
  if (report.method == "structural") return "with the structure found";
  const bool corrected = std::ranges::any_of(report.joints, &JointEntry::kept);
  return corrected || !report.loop_ran() ? "with joint corrections" : "start of the closed loop";
}

std::optional<double> largest_error(const EffectEntry& effect) {
  std::optional<double> largest;
  for (const auto& [name, error] : effect.standard_errors) {
    if (error) largest = std::max(largest.value_or(0.0), *error);
  }
  return largest;
}

/// "none is a formula", "1 is a formula", "2 are formulas".
std::string in_number(std::ptrdiff_t count, const char* one, const char* several) {
  return fmt::format("{} {}", count == 0 ? "none" : std::to_string(count), count < 2 ? one : several);
}

/// Settings that tell effects of one kind and joint apart.
constexpr std::array<const char*, 4> kTelling{"ratio", "order", "per_turn", "from"};

/// The form, where it is not the one that a kind without words for it has.
std::string unusual_form(const EffectEntry& effect) {
  const EffectLaw* const law = find_law(effect.kind);
  const std::vector<std::string> forms = law == nullptr ? std::vector<std::string>{} : law->forms();
  return !forms.empty() && forms.front() == effect.form ? "" : effect.form;
}

std::optional<double> value_of(const std::vector<NamedNumber>& numbers, const std::string& wanted) {
  const auto found = std::ranges::find(numbers, wanted, &NamedNumber::name);
  return found == numbers.end() ? std::nullopt : found->value;
}

/// Significant digits, but never an exponent for what has up to six digits before the point.
std::string significant_digits(double value, int significant) {
  const double size = std::abs(value);
  const bool whole = size >= std::pow(10.0, significant - 1) && size < 1e6;
  return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.{}g}", value, significant);
}

/// `value` in thousandths or millionths of the unit whose name follows the prefix.
std::string small_part(double value, const std::string& unit, int significant) {
  const bool tiny = value != 0.0 && std::abs(value) < 1e-5;
  return significant_digits(value * (tiny ? 1e6 : 1e3), significant) + (tiny ? " µ" : " m") + unit;
}

/// What stands after the "1" of "1/K"; empty for a plain share.
std::string per(const std::string& unit) {
  return unit.size() > 1 ? unit.substr(1) : "";
}

std::string with_unit(double value, const std::string& unit, int significant) {
  if (!std::isfinite(value)) return "–";
  if (unit.starts_with("rad") || unit == "m" || unit.starts_with("m/")) return small_part(value, unit, significant);
  if (unit == "1" || unit.starts_with("1/")) return significant_digits(1e6 * value, significant) + " ppm" + per(unit);
  return significant_digits(value, significant) + (unit.empty() ? "" : " " + unit);
}

/// Whether all is touched and nothing measured, so that nothing tells where the arm stands and no base is fitted.
bool tells_no_place(const Report& report) {
  return !report.contacts.empty() && report.workspace_error && report.workspace_error->beside_base;
}

/// Whether numbers were fitted, and none of them is of the base: registration was not declared.
bool fits_no_base(const Report& report) {
  return !report.parameters.empty() && std::ranges::none_of(report.parameters, [](const ParameterEntry& entry) {
    return entry.name.starts_with("base_");
  });
}

/// Whether neither base nor tool was fitted.
bool places_nothing(const Report& report) {
  return report.parameters.empty() && has_mean(report.registered) &&
         std::ranges::all_of(kPoseSets, [&](const ReportPoseSet& set) {
           return (report.registered.*set.errors).mean_mm == (report.nominal.*set.errors).mean_mm;
         });
}

}  // namespace

std::vector<Stage> error_stages(const Report& report) {
  const bool nothing = places_nothing(report);
  const bool placed = !tells_no_place(report) && !fits_no_base(report) && !nothing;
  std::vector<Stage> stages{
      {"nominal", placed ? "before registration (instrument frame)" : "as described", &report.nominal},
      {"registered", placed ? "base fitted" : "tool fitted", &report.registered},
      {"declared", "declared model fitted", &report.declared},
      {"before", declared_stage(report), &report.before},
      {"after", "with the effects found", &report.after}};
  if (has_mean(report.before) && !report.added_any()) stages.pop_back();
  if (nothing) std::erase_if(stages, [](const Stage& stage) { return stage.key == "registered"; });
  std::erase_if(stages, [](const Stage& stage) { return !has_mean(*stage.errors); });
  return stages;
}

const Stage* find_stage(const std::vector<Stage>& stages, const std::string& key) {
  const auto found = std::ranges::find(stages, key, &Stage::key);
  return found == stages.end() ? nullptr : &*found;
}

std::vector<ReportPoseSet> measured_sets(const std::vector<Stage>& stages) {
  std::vector<ReportPoseSet> sets(kPoseSets.begin(), kPoseSets.end());
  std::erase_if(sets, [&](const ReportPoseSet& set) {
    return std::ranges::none_of(stages, [&](const Stage& stage) { return stage.on(set).mean_mm.has_value(); });
  });
  return sets;
}

std::optional<Improvement> improvement(const std::vector<Stage>& stages) {
  if (stages.size() < 2) return std::nullopt;
  const Stage* const registered = find_stage(stages, "registered");
  const Stage& before = registered != nullptr ? *registered : stages.front();
  const Stage& after = stages.back();
  if (&before == &after) return std::nullopt;
  for (std::size_t i = kPoseSets.size(); i-- > 0;) {
    const ReportPoseSet& set = kPoseSets[i];
    if (before.on(set).mean_mm && after.on(set).mean_mm)
      return Improvement{set, before.title, after.title, before.on(set), after.on(set)};
  }
  return std::nullopt;
}

std::map<std::uint64_t, std::vector<Harmonic>> harmonics_of(const std::vector<EffectEntry>& effects) {
  std::map<std::uint64_t, std::vector<Harmonic>> joints;
  for (const EffectEntry& effect : effects) {
    const std::optional<double> cycles = effect.parameter("ratio");
    if (!is_harmonic(effect.kind) || !effect.joint || !effect.amplitude || !cycles) continue;
    joints[*effect.joint].push_back({*cycles, std::abs(*effect.amplitude), largest_error(effect), effect.unit});
  }
  for (auto& [joint, harmonics] : joints) std::ranges::stable_sort(harmonics, {}, &Harmonic::cycles);
  return joints;
}

std::string harmonics_text(const std::vector<Harmonic>& harmonics) {
  const Harmonic& largest = *std::ranges::max_element(harmonics, {}, &Harmonic::amplitude);
  const std::string size = amount(largest.amplitude, largest.unit);
  if (harmonics.size() == 1) return fmt::format("1 harmonic, {:g} cycles per turn, {}", largest.cycles, size);
  return fmt::format("{} harmonics, {:g} to {:g} cycles per turn, largest {} at {:g}", harmonics.size(),
                     harmonics.front().cycles, harmonics.back().cycles, size, largest.cycles);
}

std::optional<double> EffectEntry::parameter(const std::string& wanted) const {
  return value_of(parameters, wanted);
}

std::optional<double> EffectEntry::standard_error(const std::string& wanted) const {
  return value_of(standard_errors, wanted);
}

std::string EffectEntry::distinction() const {
  std::string text = unusual_form(*this);
  for (const char* const setting : kTelling) {
    const std::optional<double> value = parameter(setting);
    if (value) text += fmt::format("{}{} {:g}", text.empty() ? "" : ", ", setting, *value);
  }
  return text;
}

std::string EffectEntry::name() const {
  const std::string which = distinction();
  return kind + (which.empty() ? "" : " (" + which + ")") + (joint ? fmt::format(", joint {}", *joint) : "");
}

std::string EffectEntry::size() const {
  return amplitude ? amount(*amplitude, unit) : "";
}

std::string limit_sentence(const JointEntry& joint) {
  constexpr double kAbove = 1.001;
  if (!joint.limit_rad || !joint.bound_rad) return {};
  const double limit_mrad = 1e3 * *joint.limit_rad, bound_mrad = 1e3 * *joint.bound_rad;
  if (bound_mrad > kAbove * limit_mrad)
    return fmt::format(
        "This correction may reach {:.3g} mrad, above its limit of {:.3g} mrad: measure more poses before you trust "
        "it.",
        bound_mrad, limit_mrad);
  return fmt::format("The poses ask for more than its limit of {:.3g} mrad: this correction is held back.", limit_mrad);
}

std::string origins_sentence(const Report& report) {
  const auto of_origin = [&](const char* origin) {
    return std::ranges::count(report.joints, origin, &JointEntry::origin);
  };
  const auto kept = std::ranges::count_if(report.joints, &JointEntry::kept);
  const auto evolved = of_origin("evolved"), both = of_origin("evolved_and_smooth_terms"),
             sums = of_origin("smooth_terms");
  const bool any_evolved =
      std::ranges::any_of(report.joints, [](const JointEntry& joint) { return !joint.as_evolved.empty(); });
  if (!any_evolved && !report.distal) return {};
  std::string text;
  if (kept > 0 && evolved + both + sums == kept) {
    text = fmt::format("Of the {} correction{} in the model ", kept, kept == 1 ? "" : "s") +
           in_number(evolved, "is a formula as it evolved", "are formulas as they evolved");
    if (both > 0)
      text += "; " + in_number(both, "is an evolved formula with smooth terms added",
                               "are evolved formulas with smooth terms added");
    if (sums > 0)
      text += "; " + in_number(sums, "is a sum of smooth terms, fitted to the poses, in the place of an evolved one",
                               "are sums of smooth terms, fitted to the poses, in the place of evolved ones");
    text += ".";
  }
  const auto& [calibration, validation, accept] = report.as_evolved;
  const std::optional<double>& all = accept.mean_mm ? accept.mean_mm : validation.mean_mm;
  if (!any_evolved || !all) return text;
  return text + fmt::format(
                    "{}With all as they evolved the mean error of {} poses would be {:.3f} mm. fronts.csv has "
                    "the evolved formulas to choose from.",
                    text.empty() ? "" : " ", accept.mean_mm ? "accept" : "validation", *all);
}

bool Report::added_any() const {
  return std::ranges::any_of(rounds, &RoundEntry::added);
}

std::string amount(double value, const std::string& unit) {
  return with_unit(value, unit, 3);
}

std::string limit_amount(double value, const std::string& unit) {
  constexpr double kArcsecondsPerRadian = 648000.0 / std::numbers::pi;
  const double angle_arcsec = kArcsecondsPerRadian * value;
  if (unit == "rad" && std::isfinite(value) && std::abs(angle_arcsec) < 3600.0)
    return significant_digits(angle_arcsec, 2) + " arcsec";
  return with_unit(value, unit, 2);
}

std::array<std::string, 2> limit_amounts(double lower, double upper, const std::string& unit) {
  constexpr double kThousandth = 1e-3;
  std::array<std::string, 2> texts{limit_amount(lower, unit), limit_amount(upper, unit)};
  const auto unit_of = [](const std::string& text) { return text.substr(std::min(text.size(), text.find(' '))); };
  const std::string shown = unit_of(texts[1]);
  if (shown != unit_of(texts[0]) && shown == " m" + unit) texts[0] = significant_digits(lower / kThousandth, 2) + shown;
  return texts;
}

std::string probability(std::optional<double> p) {
  return p && std::isfinite(*p) ? fmt::format("{:.2g}", *p) : "–";
}

}  // namespace demecal::inline report
