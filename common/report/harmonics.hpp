// The gear harmonics that the closed loop added, gathered by joint: there may be dozens of them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "report/effect_entry.hpp"

namespace demecal {

struct Harmonic {
  double cycles = 0.0;                     ///< a turn
  double amplitude = 0.0;                  ///< SI, not negative
  std::optional<double> standard_error{};  ///< of the amplitude: the largest of its coefficients
  std::string unit;
};

/// By joint (from 1), each ascending by cycles. Only effects of kind gear_harmonic that have a joint, a ratio and a
/// finite amplitude.
std::map<std::uint64_t, std::vector<Harmonic>> harmonics_of(const std::vector<EffectEntry>& effects);

/// "9 harmonics, 11 to 31 cycles per turn, largest 0.21 mrad at 15"; of at least one.
std::string harmonics_words(const std::vector<Harmonic>& harmonics);

}  // namespace demecal
