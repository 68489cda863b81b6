#include "transport/places.hpp"

namespace demecal {
namespace {

/// Migrants of so many epochs are kept beside each other.
std::uint32_t turn_of(const Message& message) {
  const auto* migrants = std::get_if<Migrants>(&message);
  return migrants != nullptr ? migrants->epoch % static_cast<std::uint32_t>(values_kept(Topic::migrants)) : 0;
}

}  // namespace

std::uint32_t Places::place_of(const Message& message) {
  const TopicKey key = key_of(message);
  auto& of_run = taken_[key.run];
  const auto [known, is_new] = of_run.try_emplace({key, turn_of(message)}, count_);
  if (!is_new) return known->second;
  if (free_.empty()) return count_++;
  known->second = *free_.begin();
  free_.erase(free_.begin());
  return known->second;
}

std::vector<std::uint32_t> Places::vacate(RunId run) {
  std::vector<std::uint32_t> places;
  const auto of_run = taken_.find(run);
  if (of_run == taken_.end()) return places;
  for (const auto& [value, place] : of_run->second) places.push_back(place);
  taken_.erase(of_run);
  free_.insert(places.begin(), places.end());
  return places;
}

}  // namespace demecal
