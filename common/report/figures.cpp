#include "report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "effects/catalogue.hpp"
#include "report/wording.hpp"

namespace demecal {
namespace {

bool has_mean(const ErrorBySet& errors) {
  return std::ranges::any_of(kPoseSets,
                             [&](const PoseSetOfReport& set) { return (errors.*set.errors).mean_mm.has_value(); });
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

}  // namespace

std::vector<Stage> error_stages(const Report& report) {
  std::vector<Stage> stages{{"nominal", "before registration (instrument frame)", &report.nominal},
                            {"registered", "base fitted", &report.registered},
                            {"declared", "declared model fitted", &report.declared},
                            {"before", declared_stage(report), &report.before},
                            {"after", "with the effects found", &report.after}};
  if (has_mean(report.before) && !report.added_any()) stages.pop_back();
  std::erase_if(stages, [](const Stage& stage) { return !has_mean(*stage.errors); });
  return stages;
}

const Stage* find_stage(const std::vector<Stage>& stages, const std::string& key) {
  const auto found = std::ranges::find(stages, key, &Stage::key);
  return found == stages.end() ? nullptr : &*found;
}

std::vector<PoseSetOfReport> measured_sets(const std::vector<Stage>& stages) {
  std::vector<PoseSetOfReport> sets(kPoseSets.begin(), kPoseSets.end());
  std::erase_if(sets, [&](const PoseSetOfReport& set) {
    return std::ranges::none_of(stages, [&](const Stage& stage) { return stage.on(set).mean_mm.has_value(); });
  });
  return sets;
}

std::optional<Judgement> judgement(const std::vector<Stage>& stages) {
  if (stages.size() < 2) return std::nullopt;
  const Stage* const registered = find_stage(stages, "registered");
  const Stage& before = registered != nullptr ? *registered : stages.front();
  const Stage& after = stages.back();
  if (&before == &after) return std::nullopt;
  for (std::size_t i = kPoseSets.size(); i-- > 0;) {
    const PoseSetOfReport& set = kPoseSets[i];
    if (before.on(set).mean_mm && after.on(set).mean_mm)
      return Judgement{set, before.title, after.title, before.on(set), after.on(set)};
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

std::string harmonics_words(const std::vector<Harmonic>& harmonics) {
  const Harmonic& largest = *std::ranges::max_element(harmonics, {}, &Harmonic::amplitude);
  const std::string size = amount(largest.amplitude, largest.unit);
  if (harmonics.size() == 1) return fmt::format("1 harmonic, {:g} cycles per turn, {}", largest.cycles, size);
  return fmt::format("{} harmonics, {:g} to {:g} cycles per turn, largest {} at {:g}", harmonics.size(),
                     harmonics.front().cycles, harmonics.back().cycles, size, largest.cycles);
}

}  // namespace demecal
