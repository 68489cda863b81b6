#include "targets.hpp"

#include <cstdio>
#include <cstdlib>

namespace demecal::fuzz {

std::vector<Target> targets() {
  std::vector<Target> all = wire_targets();
  for (auto more : {text_targets(), file_targets(), program_targets()}) all.insert(all.end(), more.begin(), more.end());
  return all;
}

void demand(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", promise);
  std::abort();
}

}  // namespace demecal::fuzz
