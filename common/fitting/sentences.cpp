#include <sstream>

#include "fitting/fit.hpp"

namespace demecal {
namespace {

std::string ratio(double share) {
  std::ostringstream text;
  text.precision(2);
  text << share;
  return text.str();
}

}  // namespace

std::string UnidentifiedDirection::sentence() const {
  const std::string kept = weak ? "; kept near nominal" : "";
  if (parts.size() == 1)
    return parts[0].first.name() + (weak ? " hardly shows" : " does not show") + " in these poses" + kept;
  std::string names, ratios;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    names += (i == 0 ? "" : i + 1 < parts.size() ? ", " : " and ") + parts[i].first.name();
    ratios += (i == 0 ? "" : " : ") + ratio(parts[i].second / parts[0].second);
  }
  return names + (weak ? " can hardly" : " cannot") + " be told apart by these poses (" + ratios + " by effect)" + kept;
}

}  // namespace demecal
