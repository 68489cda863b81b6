#include "report/loop_words.hpp"

#include <fmt/format.h>

#include <cmath>

namespace demecal {

std::string stop_sentence(const std::string& stopped) {
  if (stopped.empty() || stopped == "not_run") return {};
  if (stopped == "no_structure") return "The loop stopped because the error that is left shows no more structure.";
  if (stopped == "no_gain") return "The loop stopped because no further effect improved the validation poses.";
  if (stopped == "max_effects") return "The loop stopped at the largest number of effects it was allowed to add.";
  if (stopped == "decoy") {
    return "The loop stopped because a control, which cannot be true, explained the error better than every effect.";
  }
  return "The loop stopped: " + stopped + ".";
}

std::string probability(std::optional<double> p) {
  return p && std::isfinite(*p) ? fmt::format("{:.2g}", *p) : "–";
}

std::string statistics_sentences(const LoopStatistics& statistics) {
  std::string text;
  const auto add = [&text](const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence; };
  if (statistics.lack_of_fit_p) {
    add(fmt::format("Before the loop the error's excess over the repeats' own scatter had p = {}.",
                    probability(statistics.lack_of_fit_p)));
  }
  if (statistics.explained_share && std::isfinite(*statistics.explained_share)) {
    add(fmt::format("Of the mean square error beyond that scatter the effects explain {:.1f} %.",
                    100.0 * *statistics.explained_share));
  }
  if (statistics.structure_left_p) {
    add(fmt::format("What is left depends on joints, load, approach, warmth or time with p = {}.",
                    probability(statistics.structure_left_p)));
  }
  return text;
}

}  // namespace demecal
