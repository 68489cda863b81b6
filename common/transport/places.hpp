// Numbers for the values that a writer keeps for those who come late: small ones, given again when a value is over.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "transport/topic.hpp"

namespace demecal {

/// The places of one writer (idl/calibration.idl).
class Places {
 public:
  /// Where a message is said: the place of what it replaces, or the least that is free.
  std::uint32_t place_of(const Message& message);
  /// Frees the places of what was said of this run, and returns them.
  std::vector<std::uint32_t> vacate(RunId run);

 private:
  /// A value, and which of those that are kept of it.
  using Value = std::pair<TopicKey, std::uint32_t>;
  std::map<RunId, std::map<Value, std::uint32_t>> taken_;
  std::set<std::uint32_t> free_;
  std::uint32_t count_ = 0;
};

}  // namespace demecal
