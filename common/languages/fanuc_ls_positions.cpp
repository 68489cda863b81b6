#include "languages/fanuc_ls_positions.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "data/text.hpp"

namespace demecal::inline languages {
namespace {

/// What stands between "GP1:" and the next group or the position's end; all of it where no group is named.
std::optional<std::pair<std::size_t, std::size_t>> first_group(const ProgramText& text, std::size_t begin,
                                                               std::size_t end) {
  std::size_t first = begin;
  bool named = false, others = false;
  for (std::size_t at = begin; at < end; ++at) {
    if (!text.begins_word(at)) continue;
    const std::string word = text.word_at(at);
    if (word.size() == 3 && word.starts_with("gp") && is_digit(word[2])) {
      if (named) return std::pair{first, at};
      if (word == "gp1") first = text.word_end(at);
      named = word == "gp1";
      others = others || !named;
    }
    at = text.word_end(at) - 1;
  }
  if (others && !named) return std::nullopt;
  return std::pair{first, end};
}

/// The value that begins at `begin`; `last` becomes its last byte.
FanucPart value_at(const ProgramText& text, std::size_t begin, std::size_t end, std::size_t& last) {
  const std::string_view code = text.code();
  begin = std::min(begin, end);
  if (begin < end && code[begin] == '\'') {
    const std::size_t close = std::min(code.find('\'', begin + 1), end);
    last = close < end ? close : end - 1;
    return {{begin + 1, close - begin - 1, false, {}}};
  }
  const std::size_t stop = std::min(code.find_first_of(" \t\r\n,;", begin), end);
  FanucPart component{{begin, stop - begin, false, {}}, ""};
  const std::size_t unit = text.skip_spaces(stop);
  if (unit < end && (stop == begin || code[stop] != ',')) component.unit = text.word_at(unit);
  last = stop > begin ? stop - 1 : begin;
  return component;
}

}  // namespace

/// "NAME = number unit," and "NAME : word,".
std::optional<FanucParts> fanuc_position_parts(const ProgramText& text, std::size_t begin, std::size_t end) {
  const auto group = first_group(text, begin, end);
  if (!group) return std::nullopt;
  std::tie(begin, end) = *group;
  const std::string_view code = text.code();
  FanucParts found;
  for (std::size_t at = begin; at < end; ++at) {
    if (!text.begins_word(at)) continue;
    const std::size_t word_end = std::min(text.word_end(at), end), sign = text.skip_spaces(word_end);
    const std::string name = lower_case(code.substr(at, word_end - at));
    at = word_end - 1;
    if (sign >= end || (code[sign] != '=' && code[sign] != ':')) continue;
    found.try_emplace(name, value_at(text, text.skip_spaces(sign + 1), end, at));
  }
  return found;
}

std::vector<std::optional<int>> fanuc_turns(std::string_view configuration) {
  constexpr std::array<std::size_t, 3> kJoints{0, 3, 5};
  std::vector<std::optional<int>> turns(6);
  for (const std::size_t joint : kJoints) {
    const std::size_t comma = configuration.find(',');
    if (comma == std::string_view::npos) return {};
    configuration.remove_prefix(comma + 1);
    const std::string_view number = configuration.substr(0, configuration.find(','));
    int turn = 0;
    const auto [end, fault] = std::from_chars(number.data(), number.data() + number.size(), turn);
    if (fault != std::errc() || end != number.data() + number.size()) return {};
    turns[joint] = turn;
  }
  return turns;
}

std::string fanuc_joint_counting(const std::vector<Target>& targets, const Chain& arm) {
  const bool has_joints = std::ranges::any_of(targets, [](const Target& target) { return !target.is_pose(); });
  const auto is_it = [](const CommandCoupling& coupling) { return coupling.joint == 2 && coupling.from == 1; };
  if (!has_joints || std::ranges::any_of(arm.couplings, is_it)) return {};
  return "Joint 3 is taken to count against link 2, as in the robot's description; FANUC's programs count it against "
         "the ground: state `couplings: [{joint: 3, from: 2, factor: 1}]` there if these do.";
}

}  // namespace demecal::inline languages
