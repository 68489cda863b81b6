#include "kuka_abb_ur/krl_statements.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "data/text.hpp"

namespace demecal::inline kuka_abb_ur {

std::size_t points_of_krl_motion(std::string_view word) {
  if (word == "circ" || word == "scirc") return 2;
  constexpr std::array<std::string_view, 5> kMotions{"ptp", "sptp", "lin", "slin", "spl"};
  return std::find(kMotions.begin(), kMotions.end(), word) != kMotions.end() ? 1 : 0;
}

std::size_t next_krl_argument(std::string_view code, std::size_t begin, std::size_t end) {
  int depth = 0;
  for (; begin < end; ++begin) {
    const char letter = code[begin];
    if (letter == ',' && depth == 0) break;
    depth += letter == '{' || letter == '[' || letter == '('   ? 1
             : letter == '}' || letter == ']' || letter == ')' ? -1
                                                               : 0;
  }
  return begin + 1;
}

std::pair<std::string, std::string> krl_point_name(std::string_view name) {
  const std::size_t open = std::min(name.find('['), name.size());
  std::string stem = lower_case(name.substr(0, open)), index(name.substr(open));
  for (std::string* const part : {&stem, &index})
    std::erase_if(*part, [](char letter) { return letter == ' ' || letter == '\t'; });
  if (index.find_first_not_of("0123456789,[]") != std::string::npos) index.clear();
  return {stem, index};
}

KrlStatements::KrlStatements(const ProgramText& text, Program& program)
    : text_(text), code_(text.code()), program_(program), changes_(text) {
  for (const Target& target : program.targets) {
    numbers_.insert(target.begin());
    if (!target.name.empty()) names_.insert(lower_case(target.name.substr(0, target.name.find('['))));
  }
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    read_name(begin, end);
    if (begin == 0 || (code_[begin - 1] != '.' && code_[begin - 1] != '#')) read_motion(begin, end);
    read_guidance(begin, end);
  });
  changes_.mark(program.targets);
  for (Target& target : program.targets) {
    if (!target.not_sent_to.empty()) continue;
    if (!displaces_.empty())
      target.not_sent_to =
          "the program lets sensors displace motions (" + displaces_ + "), and where it does is not followed";
    else if (keeps_orientation_ && target.is_pose())
      target.not_sent_to =
          "lines may end with another orientation than that of their point ($ORI_TYPE=#CONSTANT), and where they do is "
          "not followed";
  }
}

/// Says where a motion goes to what has no numbers, or by numbers.
void KrlStatements::read_motion(std::size_t begin, std::size_t end) {
  const std::string word = lower_case(code_.substr(begin, end - begin));
  const std::size_t line_end = std::min(code_.find('\n', begin), code_.size());
  if (word.ends_with("_rel") && points_of_krl_motion(word.substr(0, word.size() - 4)) > 0)
    return read_relative(begin, std::min(text_.skip_spaces(end), line_end), line_end);
  std::size_t points = points_of_krl_motion(word);
  for (std::size_t at = end; points > 0 && at < line_end; at = next_krl_argument(code_, at, line_end), --points)
    read_destination(begin, std::min(text_.skip_spaces(at), line_end), line_end, points == 1);
  if (word == "circ" || word == "scirc") read_circle_angle(end, line_end);
}

/// CA 180: it ends there, and not at the second point.
void KrlStatements::read_circle_angle(std::size_t begin, std::size_t line_end) {
  for (std::size_t at = begin; at < line_end; ++at) {
    if (!text_.begins_word(at)) continue;
    if (text_.word_at(at) == "ca") program_.joints_lost_at.push_back(at);
    at = text_.word_end(at) - 1;
  }
}

/// What lets motions end elsewhere than at their points: RSI_ON, ST_ON, technology functions, $ORI_TYPE=#CONSTANT.
void KrlStatements::read_guidance(std::size_t begin, std::size_t end) {
  constexpr std::array<std::string_view, 4> kSensors{"rsi_on", "rsi_movecorr", "st_on", "st_on1"};
  const std::string word = text_.word_at(begin);
  const std::size_t line_end = std::min(code_.find('\n', begin), code_.size());
  if (std::find(kSensors.begin(), kSensors.end(), word) != kSensors.end() && text_.next(end) == '(')
    displaces_ = code_.substr(begin, end - begin);
  const std::size_t sign = std::min(code_.find('=', end), line_end);
  if (sign >= line_end || code_.substr(sign).starts_with("==")) return;
  const std::string value = lower_case(code_.substr(text_.skip_spaces(sign + 1), 9));
  const bool mode = lower_case(code_.substr(end, sign - end)).find(".mode") != std::string::npos;
  if (word.starts_with("$tech") && mode && !value.starts_with("#off")) displaces_ = code_.substr(begin, end - begin);
  keeps_orientation_ = keeps_orientation_ || (word == "$ori_type" && value == "#constant");
}

/// Whether ":" follows the aggregate that begins there; its target is then none.
bool KrlStatements::is_part_of_sum(std::size_t begin, std::size_t line_end) {
  if (code_[begin] != '{') return false;
  const std::size_t close = std::min(code_.find('}', begin), line_end),
                    after = text_.skip_spaces(std::min(close + 1, line_end));
  if (after >= line_end || code_[after] != ':') return false;
  for (Target& target : program_.targets) {
    if (target.begin() > begin && target.begin() < close) target.not_sent_to = "it is part of a sum (:)";
  }
  return true;
}

/// A point that the motion at `motion` goes to (`last`) or only by.
void KrlStatements::read_destination(std::size_t motion, std::size_t begin, std::size_t line_end, bool last) {
  if (last) moved_mm_ = 0.0;
  if (begin >= line_end || (is_point(begin) && !is_part_of_sum(begin, line_end))) return;
  const std::size_t stop = std::min(next_krl_argument(code_, begin, line_end) - 1, line_end);
  const std::size_t name_end = after_index(text_.word_end(begin), line_end), after = text_.skip_spaces(name_end);
  const bool whole = after >= stop || (text_.begins_word(after) && after > name_end);
  const std::string name = text_.word_at(begin);
  if (whole && names_.contains(name)) return;
  if (last) program_.joints_lost_at.push_back(motion);
  // Robots are sent to where they stand, so that they have met their path.
  if (whole && (name == "$axis_act" || name == "$pos_act")) return;
  const TextPlace place = text_.place(begin);
  const bool said = code_[begin] == '{' && std::ranges::any_of(program_.uncorrected, [&](const Remark& remark) {
                      return remark.place.line == place.line && remark.place.file == place.file;
                    });
  if (said) return;  // by who read the aggregate
  std::size_t first = begin;
  const std::string written(text_.trimmed(first, whole ? name_end : stop));
  skip_target(program_, {.name = whole ? written : "", .place = place},
              "the motion goes to '" + written.substr(0, 40) + "', which " +
                  (whole ? "is no point that this program gives as numbers and declares (--with FILE takes in another "
                           "of its files)"
                         : "is computed when the program runs"));
}

/// What a motion goes by, added to what motions before it went by since the last that goes to a place.
void KrlStatements::read_relative(std::size_t motion, std::size_t begin, std::size_t line_end) {
  program_.joints_lost_at.push_back(motion);
  double square_mm2 = begin < line_end && code_[begin] == '{' ? 0.0 : std::nan("");
  const BracketItem list = square_mm2 == 0.0 ? read_list(text_, begin, '{') : BracketItem{};
  for (const BracketItem& item : list.items) {
    const std::size_t name_end = std::min(text_.word_end(item.begin), item.begin + item.size);
    const std::string axis = lower_case(code_.substr(item.begin, name_end - item.begin));
    std::size_t value = name_end;
    const std::string_view number = text_.trimmed(value, item.begin + item.size);
    const auto cell = cell_at(code_, value, number.size(), {});
    if (cell && cell->value == 0.0) continue;
    const bool length = cell && (axis == "x" || axis == "y" || axis == "z");
    square_mm2 += length ? cell->value * cell->value : std::nan("");
  }
  moved_mm_ += std::sqrt(square_mm2);
  if (moved_mm_ <= kCloseToPoint_mm) return;
  const std::string distance =
      std::isfinite(moved_mm_) ? std::to_string(std::lround(moved_mm_)) + " mm" : "by an amount that is not known";
  program_.remarks.push_back({text_.place(motion), "",
                              "the motion goes " + distance +
                                  " away from the last place that is told, with the correction of that place, which "
                                  "need not be right there"});
}

std::size_t KrlStatements::after_index(std::size_t end, std::size_t line_end) const {
  const std::size_t open = text_.skip_spaces(end);
  if (open >= line_end || code_[open] != '[') return end;
  return std::min(code_.find(']', open), line_end - 1) + 1;
}

void KrlStatements::read_name(std::size_t begin, std::size_t end) {
  const std::string word = lower_case(code_.substr(begin, end - begin));
  if (!names_.contains(word)) return;
  if (begin > 0 && (code_[begin - 1] == '.' || code_[begin - 1] == '#')) return;
  Place place{begin == 0 ? 0 : code_.rfind('\n', begin - 1) + 1, std::min(code_.find('\n', begin), code_.size()), begin,
              end, end};
  place.name_end = place.end = after_index(end, place.line_end);
  bool part = false;
  for (; text_.next(place.end) == '.' && text_.skip_spaces(place.end) < place.line_end; part = true)
    place.end = after_index(text_.word_end(text_.skip_spaces(text_.skip_spaces(place.end) + 1)), place.line_end);
  const std::size_t sign = text_.skip_spaces(place.end);
  const bool assigned = sign < place.line_end && code_[sign] == '=' && !code_.substr(sign).starts_with("==");
  const std::string_view name = code_.substr(begin, place.name_end - begin);
  if (assigned && !part && is_point(text_.skip_spaces(sign + 1))) return;
  if (assigned) return changes_.changed(name, begin);
  if (!part && (is_declaration(place) || is_destination(place) || is_copied(place))) return;
  changes_.used(name, begin);
}

bool KrlStatements::is_point(std::size_t begin) const {
  if (begin >= code_.size() || code_[begin] != '{') return false;
  const BracketItem list = read_list(text_, begin, '{');
  const auto number = numbers_.lower_bound(begin);
  return number != numbers_.end() && *number < begin + list.size;
}

/// "DECL E6POS XP1, XP2" and "GLOBAL E6AXIS HOME".
bool KrlStatements::is_declaration(const Place& place) const {
  constexpr std::array<std::string_view, 7> kWords{"decl", "global", "const", "pos", "e6pos", "axis", "e6axis"};
  const std::string first = text_.word_at(place.line_begin);
  return std::find(kWords.begin(), kWords.end(), first) != kWords.end();
}

/// Whether the name is all that a motion is sent to: "LIN XP2 C_DIS", and each of the two points of "CIRC XP1, XP2".
bool KrlStatements::is_destination(const Place& place) const {
  std::size_t motion_end = 0, points = 0;
  for (std::size_t at = place.line_begin; at < place.begin; ++at) {
    if (!text_.begins_word(at)) continue;
    const std::size_t end = text_.word_end(at);
    if (const std::size_t count = points_of_krl_motion(lower_case(code_.substr(at, end - at)))) {
      motion_end = end;
      points = count;
    }
    at = end - 1;
  }
  for (std::size_t begin = motion_end; points > 0 && begin < place.line_end; --points) {
    if (text_.skip_spaces(begin) == place.begin) {
      const std::size_t after = text_.skip_spaces(place.name_end);
      return after >= place.line_end || code_[after] == ',' || text_.begins_word(after);
    }
    begin = next_krl_argument(code_, begin, place.line_end);
  }
  return false;
}

/// "XP2=XP1".
bool KrlStatements::is_copied(const Place& place) const {
  const std::size_t before = place.begin == 0 ? std::string_view::npos : code_.find_last_not_of(" \t", place.begin - 1);
  if (before == std::string_view::npos || before <= place.line_begin || code_[before] != '=') return false;
  constexpr std::string_view kComparisons = "=<>";
  return kComparisons.find(code_[before - 1]) == std::string_view::npos &&
         text_.skip_spaces(place.name_end) >= place.line_end;
}

}  // namespace demecal::inline kuka_abb_ur
