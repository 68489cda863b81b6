#include "drafting/planned_programs.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "kinematics/chain.hpp"
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

namespace {

/// With what its head says.
std::string headed(std::string text, const Plan& plan, const std::string& first_stop, const Language& language) {
  if (const std::string by_hand = poses_by_hand(plan); !by_hand.empty())
    text = with_mark(text, language, "Left out, as no free way was found there: " + by_hand);
  return with_mark(text, language, "Drive to " + first_stop + " by hand first: the way there was not checked");
}

}  // namespace

std::string planned_program(const Plan& plan, const Chain& arm, const Language& language) {
  const std::vector<ProgrammedStop> stops = programmed_stops(plan);
  if (language.write == nullptr || stops.empty()) return {};
  std::string text = language.write(stops, arm);
  return text.empty() ? text : headed(std::move(text), plan, stops.front().name, language);
}

std::string planned_program_beside(const Plan& plan, const Language& language) {
  const std::vector<ProgrammedStop> stops = programmed_stops(plan);
  if (language.write_beside == nullptr || stops.empty()) return {};
  return headed(language.write_beside(stops), plan, stops.front().name, language);
}

std::string programs_left_out(const Plan& plan, const Chain& arm) {
  if (programmed_stops(plan).empty()) return "";
  std::vector<std::string> titles;
  for (const Language& language : all_languages()) {
    if (language.write != nullptr && planned_program(plan, arm, language).empty()) titles.emplace_back(language.title);
  }
  if (titles.empty()) return "";
  return "no program is written in " + listed_words(titles, "and") +
         ", whose targets cannot state the joints of this arm: " + std::to_string(arm.size()) + ", of which " +
         (is_revolute(arm, 0) ? "the first turns" : "the first slides, as a rail does");
}

}  // namespace demecal::inline drafting
