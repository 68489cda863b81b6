#include "report/left_error.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "data/text.hpp"
#include "effects/catalogue.hpp"
#include "random/distributions.hpp"
#include "report/report.hpp"

namespace demecal::inline report {
namespace {

constexpr double kPointAxes = 3.0;

/// Of a position, per axis, squared; nothing where it is not known.
std::optional<double> noise_variance_mm2(const Report& report) {
  if (!report.noise || !report.noise->estimated || !(report.noise->independent_mm.value_or(0.0) > 0.0))
    return std::nullopt;
  const double in_order_mm = report.noise->shared_in_order_mm.value_or(0.0);
  const double estimated_mm = std::hypot(*report.noise->independent_mm, in_order_mm);
  return std::pow(std::max(estimated_mm, report.noise_floor_mm.value_or(0.0)), 2);
}

/// The rms error that the chosen model left at validation poses while they were unseen.
std::optional<double> left_mm(const Report& report) {
  const auto chosen = std::ranges::find(report.front, true, &FrontEntry::chosen);
  if (chosen != report.front.end()) return chosen->validation_rms_mm;
  if (report.unseen_validation_rms_mm) return report.unseen_validation_rms_mm->after;
  return report.after.validation.rms_mm;
}

std::string advice_on_unexplained(const Report& report) {
  std::vector<std::string> may_be{
      "gears with a ratio above closed_loop.highest_ratio (state it as gear in the robot "
      "file)"};
  if (!report.considered.empty()) may_be.emplace_back("effects that were not looked for");
  std::vector<std::string> unseen;
  for (const UntestableEntry& one : report.untestable)
    if (rarity(one.kind) < causes().size() && std::ranges::count(unseen, cause_of(one.kind).words) == 0)
      unseen.emplace_back(cause_of(one.kind).words);
  if (!unseen.empty()) may_be.push_back("what these data cannot show (" + listed_words(unseen, "or") + ")");
  may_be.emplace_back("several small causes that so few poses do not tell from noise");
  if (!report.noise_floor_mm) may_be.emplace_back("joints that do not repeat");
  std::string text = "It may be " + listed_words(may_be, "or") + ". Measure more poses";
  if (!report.noise_floor_mm) text += ", some of them three times: what repeats is no noise";
  return text + ".";
}

}  // namespace

std::optional<UnexplainedEntry> unexplained_error(const Report& report) {
  constexpr std::uint64_t kFewest = 10;
  constexpr double kMostByChance = 1e-3;
  const std::optional<double> noise_mm2 = noise_variance_mm2(report), left = left_mm(report);
  if (!report.loop_ran() || !noise_mm2 || !left || report.poses.validation < kFewest || !report.contacts.empty() ||
      !report.prediction_interval || report.prediction_interval->distance_noise_mm.value_or(0.0) > 0.0)
    return std::nullopt;
  const PredictionEntry& prediction = *report.prediction_interval;
  const double without_posterior_mm2 =
      std::pow(prediction.noise_mm.value_or(0.0), 2) + std::pow(prediction.model_error_mm.value_or(0.0), 2);
  const double error_mm2 = std::min(*left * *left / kPointAxes, without_posterior_mm2) - *noise_mm2;
  if (error_mm2 < *noise_mm2) return std::nullopt;
  const auto rows = [](std::uint64_t poses) { return kPointAxes * static_cast<double>(poses); };
  const double chance =
      fisher_p_value(1.0 + error_mm2 / *noise_mm2, rows(report.poses.validation), 0.5 * rows(report.poses.calibration));
  if (chance > kMostByChance) return std::nullopt;
  return UnexplainedEntry{.error_mm = std::sqrt(kPointAxes * error_mm2),
                          .left_mm = *left,
                          .noise_mm = std::sqrt(kPointAxes * *noise_mm2),
                          .advice = advice_on_unexplained(report)};
}

std::string unexplained_sentence(const UnexplainedEntry& unexplained) {
  return fmt::format(
      "Not explained: {:.3f} mm of the error: {:.3f} mm are left on validation poses, of which noise makes {:.3f} mm.",
      unexplained.error_mm.value_or(0.0), unexplained.left_mm.value_or(0.0), unexplained.noise_mm.value_or(0.0));
}

}  // namespace demecal::inline report
