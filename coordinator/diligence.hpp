// Whether islands get on, as far as nothing keeps them: told from what they say.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <vector>

#include "evolution/archipelago.hpp"

namespace demecal {

/// An island that lacks nothing and does not get on shows that its worker does not work, whatever that says of itself.
/// Times are arguments and never go back.
class Diligence {
 public:
  using Time = std::chrono::steady_clock::time_point;

  Diligence(const Archipelago& archipelago, Time now);

  /// A worker begins with the island after so many epochs.
  void given(IslandKey island, std::uint32_t epoch, Time now);
  /// So many epochs of the island are known to be completed.
  void reached(IslandKey island, std::uint32_t epoch, Time now);
  void finished(IslandKey island) { islands_.at(island).is_finished = true; }

  /// Islands that have not got on for `patience`, and for several times as long as any took to get on, while their
  /// sources were as far as they.
  std::vector<IslandKey> stalled(Time now, std::chrono::milliseconds patience) const;

 private:
  struct Isle {
    std::vector<IslandKey> sources;
    std::uint32_t epoch = 0;
    Time since;  ///< when it last got on, or was given
    bool is_finished = false;
  };
  bool is_stalled(const Isle& isle, Time before) const;

  bool waits_;  ///< for sources
  std::map<IslandKey, Isle> islands_;
  Time::duration longest_{};  ///< that an island took to get on
};

}  // namespace demecal
