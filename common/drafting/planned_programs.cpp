#include "drafting/planned_programs.hpp"

#include <cstddef>

#include "languages/languages.hpp"
#include "planning/way.hpp"

namespace demecal::inline drafting {

std::vector<ProgrammedStop> programmed_stops(const Plan& plan) {
  std::vector<ProgrammedStop> stops;
  const std::vector<WayStop>& way = plan.way.stops;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (way[i].pose < 0) continue;
    const std::string number = plan.stops[static_cast<std::size_t>(way[i].pose)].id.substr(1);
    for (std::size_t k = begin; k < i; ++k) {
      const std::size_t before = k - begin;
      const bool approaches = k + 1 == i;
      const std::string letter = before == 0 ? "" : std::string(1, static_cast<char>('a' + before % 26));
      stops.push_back({approaches ? "A" + number : "W" + number + letter, way[k].joints, false});
    }
    stops.push_back({"P" + number, way[i].joints, true});
    begin = i + 1;
  }
  return stops;
}

std::string planned_program(const Plan& plan, const Chain& arm, const Language& language) {
  const std::vector<ProgrammedStop> stops = programmed_stops(plan);
  if (language.write == nullptr || stops.empty()) return {};
  std::string text = language.write(stops, arm);
  if (text.empty()) return text;
  if (const std::string by_hand = poses_by_hand(plan); !by_hand.empty())
    text = with_mark(text, language, "Left out, as no free way was found there: " + by_hand);
  return with_mark(text, language, "Drive to " + stops.front().name + " by hand first: the way there was not checked");
}

}  // namespace demecal::inline drafting
