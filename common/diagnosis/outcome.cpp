#include "diagnosis/outcome.hpp"

namespace demecal {

std::vector<std::array<double, 2>> intervals_of(const Effect& effect) {
  constexpr double kNormal95 = 1.96;
  std::vector<std::array<double, 2>> intervals;
  for (std::size_t i = 0; i < effect.standard_errors.size(); ++i) {
    const double half = kNormal95 * effect.standard_errors[i];
    intervals.push_back({effect.value(i) - half, effect.value(i) + half});
  }
  return intervals;
}

std::string word_of(StopReason reason) {
  switch (reason) {
    case StopReason::no_structure:
      return "no_structure";
    case StopReason::no_gain:
      return "no_gain";
    case StopReason::max_effects:
      return "max_effects";
    case StopReason::decoy:
      return "decoy";
    case StopReason::not_run:
      break;
  }
  return "not_run";
}

std::string word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::added:
      return "added";
    case Verdict::rejected:
      return "rejected";
    case Verdict::none:
      break;
  }
  return "none";
}

}  // namespace demecal
