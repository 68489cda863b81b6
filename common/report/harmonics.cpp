#include "report/harmonics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/amount.hpp"

namespace demecal {
namespace {

std::optional<double> largest_error(const EffectEntry& effect) {
  std::optional<double> largest;
  for (const NamedNumber& number : effect.parameters) {
    if (number.standard_error) largest = std::max(largest.value_or(0.0), *number.standard_error);
  }
  return largest;
}

}  // namespace

std::map<std::uint64_t, std::vector<Harmonic>> harmonics_of(const std::vector<EffectEntry>& effects) {
  std::map<std::uint64_t, std::vector<Harmonic>> joints;
  for (const EffectEntry& effect : effects) {
    const std::optional<double> cycles = effect.parameter("ratio");
    const bool drawable = effect.amplitude && std::isfinite(*effect.amplitude) && cycles && std::isfinite(*cycles);
    if (effect.kind != "gear_harmonic" || !effect.joint || !drawable) continue;
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
