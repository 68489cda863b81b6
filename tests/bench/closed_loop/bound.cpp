#include "bound.hpp"

#include <fmt/ostream.h>

namespace demecal::bench {
namespace {

std::string bound_text(const Bound& bound) {
  if (bound.at_least && bound.at_most) return fmt::format("{:.2f} .. {:.2f}", *bound.at_least, *bound.at_most);
  if (bound.at_least) return fmt::format(">= {:.2f}", *bound.at_least);
  return bound.at_most ? fmt::format("<= {:.2f}", *bound.at_most) : "";
}

}  // namespace

bool Bound::kept_by(double value) const {
  return (!at_least || value >= *at_least) && (!at_most || value <= *at_most);
}

void write_bound(std::ostream& out, const std::string& name, double value, const Bound& bound) {
  const char* verdict = !bound.holds() ? "" : bound.kept_by(value) ? "kept" : "MISSED";
  fmt::print(out, "{:<64}{:>9.3f}   {:<13}{}\n", name, value, bound_text(bound), verdict);
}

}  // namespace demecal::bench
