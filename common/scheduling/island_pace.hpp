// How long islands still take where they are, as far as their reports tell.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>

#include "evolution/archipelago.hpp"

namespace demecal::inline scheduling {

/// Times are arguments and never go back.
class IslandPace {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `generations`: of every island.
  explicit IslandPace(std::uint32_t generations) : generations_(generations) {}

  /// A worker begins with the island after so many generations.
  void assigned(IslandKey island, std::uint32_t generation, Time now);
  /// So many generations of the island have been bred.
  void reached(IslandKey island, std::uint32_t generation, Time now);

  /// At the pace since it was assigned; Time::duration::max() where no report has told of generations.
  Time::duration left(IslandKey island, Time now) const;

 private:
  struct Course {
    Time begin, last;                ///< when it was assigned, and of its last report
    std::uint32_t from = 0, to = 0;  ///< the generation then
  };

  std::uint32_t generations_;
  std::map<IslandKey, Course> islands_;
};

}  // namespace demecal::inline scheduling
