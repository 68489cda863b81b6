#include "staubli_kawasaki/departures.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace demecal::inline staubli_kawasaki {

bool Departures::read(const ProgramText& text, std::size_t begin, std::size_t argument, std::size_t end) {
  constexpr std::array<std::string_view, 4> kWords{"depart", "departs", "jdepart", "ldepart"};
  const std::string word = text.word_at(begin);
  if (std::find(kWords.begin(), kWords.end(), word) == kWords.end()) return false;
  const std::string_view number = text.trimmed(argument, end);
  const auto cell = cell_at(text.code(), argument, number.size(), {});
  departures_.push_back({begin, word, std::exchange(at_, {}), cell ? std::optional(cell->value) : std::nullopt});
  return true;
}

void Departures::take(const ProgramText& text, const FrameFlow& way,
                      std::map<std::string, std::vector<TargetUse>>& uses, Program& program) const {
  for (const auto& [begin, word, from, distance_mm] : departures_) {
    if (from.key.empty() || !way.is_straight(from.motion, begin)) {
      note_unknown_motion(program, begin, {.name = "", .place = text.place(begin)},
                          "the motion of " + word + " leaves a place that is no location of this program");
      continue;
    }
    const bool line = word == "departs" || word == "ldepart";
    uses[from.key].push_back({begin, line ? Motion::line : Motion::joints, {}, place_before(distance_mm)});
    note_offset(program, text.place(begin), from.name, distance_mm);
  }
}

}  // namespace demecal::inline staubli_kawasaki
