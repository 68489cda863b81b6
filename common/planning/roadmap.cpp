#include "planning/roadmap.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>

#include "data/data_set.hpp"
#include "planning/travel.hpp"

namespace demecal::inline planning {

Roadmap::Roadmap(const FeasibleSpace& space, std::vector<JointVector> places)
    : space_(space),
      places_(std::move(places)),
      neighbours_(places_.size()),
      motions_(places_.size() * places_.size(), Motion::unknown) {
  constexpr std::size_t kNearest = 12;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    std::vector<Neighbour> near;
    for (std::size_t k = 0; k < places_.size(); ++k)
      if (k != i) near.push_back({k, travel(space_.robot().chain, places_[i], places_[k])});
    const std::size_t kept = std::min(kNearest, near.size());
    std::ranges::partial_sort(near, near.begin() + static_cast<std::ptrdiff_t>(kept), {},
                              [](const Neighbour& one) { return std::pair(one.length, one.place); });
    for (std::size_t k = 0; k < kept; ++k) {
      neighbours_[i].push_back(near[k]);
      neighbours_[near[k].place].push_back({i, near[k].length});
    }
  }
}

Roadmap::Motion& Roadmap::motion(std::size_t from, std::size_t to) {
  return motions_[std::min(from, to) * places_.size() + std::max(from, to)];
}

bool Roadmap::is_open(std::size_t from, std::size_t to) {
  Motion& known = motion(from, to);
  if (known == Motion::unknown) known = is_free(space_, places_[from], places_[to]) ? Motion::free : Motion::blocked;
  return known == Motion::free;
}

std::optional<std::vector<JointVector>> Roadmap::between(std::size_t from, std::size_t to) {
  struct Step {
    double estimate = 0.0, length = 0.0;
    std::size_t place = 0, before = 0;
    bool operator>(const Step& other) const {
      return std::tie(estimate, place, before) > std::tie(other.estimate, other.place, other.before);
    }
  };
  const std::size_t nowhere = places_.size();
  const auto left = [&](std::size_t place) { return travel(space_.robot().chain, places_[place], places_[to]); };
  std::vector<std::size_t> came_from(places_.size(), nowhere);
  std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
  open.push({left(from), 0.0, from, from});
  while (!open.empty() && came_from[to] == nowhere) {
    const Step step = open.top();
    open.pop();
    if (came_from[step.place] != nowhere || (step.place != from && !is_open(step.before, step.place))) continue;
    came_from[step.place] = step.before;
    for (const Neighbour& next : neighbours_[step.place]) {
      if (came_from[next.place] != nowhere || motion(step.place, next.place) == Motion::blocked) continue;
      const double length = step.length + next.length;
      open.push({length + left(next.place), length, next.place, step.place});
    }
  }
  if (came_from[to] == nowhere) return std::nullopt;
  std::vector<JointVector> way;
  for (std::size_t place = came_from[to]; place != from && to != from; place = came_from[place])
    way.push_back(places_[place]);
  std::ranges::reverse(way);
  return way;
}

}  // namespace demecal::inline planning
