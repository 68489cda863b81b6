#include "diagnosis/outcome.hpp"

namespace demecal {

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
