#include "scheduling/island_pace.hpp"

namespace demecal::inline scheduling {

void IslandPace::assigned(IslandKey island, std::uint32_t generation, Time now) {
  islands_[island] = {now, now, generation, generation};
}

void IslandPace::reached(IslandKey island, std::uint32_t generation, Time now) {
  const auto found = islands_.find(island);
  if (found == islands_.end() || generation <= found->second.to) return;
  found->second.last = now;
  found->second.to = generation;
}

IslandPace::Time::duration IslandPace::left(IslandKey island, Time now) const {
  const auto found = islands_.find(island);
  if (found == islands_.end() || found->second.to == found->second.from) return Time::duration::max();
  const Course& course = found->second;
  const auto generation = (course.last - course.begin) / (course.to - course.from);
  return course.last + generation * (generations_ - course.to) - now;
}

}  // namespace demecal::inline scheduling
