// What was received and not acted on: counted, and told once for each source.
#pragma once

#include <cstdint>
#include <mutex>
#include <set>
#include <string>

namespace demecal {

/// Any thread may call.
class DroppedSamples {
 public:
  /// One more from this source, and why. The first from there is told on standard error; of the first few sources, lest
  /// one that invents names fills the screen, and of none without a name.
  void note(const std::string& source, const std::string& why);
  std::uint64_t count() const;

 private:
  mutable std::mutex mutex_;
  std::uint64_t count_ = 0;
  std::set<std::string> told_;
};

}  // namespace demecal
