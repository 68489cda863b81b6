#include "transport/dropped_samples.hpp"

#include <cstdio>

#include "protocol/printable.hpp"

namespace demecal {
namespace {

constexpr std::size_t kMostTold = 64;

}  // namespace

void DroppedSamples::note(const std::string& source, const std::string& why) {
  const std::lock_guard lock(mutex_);
  ++count_;
  if (source.empty() || told_.size() >= kMostTold || !told_.insert(source).second) return;
  std::fprintf(stderr, "dropped a sample from %s: %s; what else is dropped from there is counted\n",
               printable(source).c_str(), printable(why).c_str());
  if (told_.size() == kMostTold) std::fprintf(stderr, "samples from further sources are dropped without a word\n");
}

std::uint64_t DroppedSamples::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

}  // namespace demecal
