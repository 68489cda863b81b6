#include "kuka_abb_ur/rapid_statements.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "data/text.hpp"
#include "parsed_programs/compliance.hpp"

namespace demecal::inline kuka_abb_ur {
namespace {

/// The name with indices behind it, as far as they go.
std::size_t after_indices(const ProgramText& text, std::size_t end) {
  const std::string_view code = text.code();
  if (text.next(end) != '{') return end;
  return std::min(code.find('}', end), code.size() - 1) + 1;
}

/// Statements between PDispSet and PDispOff that neither branch nor call.
bool is_simple(const std::string& word) {
  constexpr std::array<std::string_view, 12> kSimple{"waittime", "waitrob", "waitdi", "waituntil", "set",     "reset",
                                                     "setdo",    "pulsedo", "confl",  "confj",     "tpwrite", "velset"};
  return targets_of_rapid_motion(word) > 0 || std::find(kSimple.begin(), kSimple.end(), word) != kSimple.end();
}

/// The PDispOff that ends the displacement set by the statement that ends at `at`; nothing where that cannot be told.
std::optional<std::size_t> end_of_displacement(const ProgramText& text, std::size_t at) {
  while (at < text.code().size()) {
    const std::size_t begin = text.skip_spaces(at + 1);
    const std::string word = text.word_at(begin);
    if (word == "pdispoff") return begin;
    if (!is_simple(word)) return std::nullopt;
    at = std::min(text.code().find(';', begin), text.code().size());
  }
  return std::nullopt;
}

}  // namespace

std::size_t targets_of_rapid_motion(std::string_view word) {
  constexpr std::array<std::string_view, 7> kOthers{"moveabsj",  "triggl",    "triggj",   "trigglios",
                                                    "triggabsj", "movejsync", "movelsync"};
  if (word == "triggc" || word == "movec" || word == "movecsync") return 2;
  if (word.starts_with("movec") && word.size() == 7) return word.ends_with('o') ? 2 : 0;  // MoveCDO, MoveCAO, MoveCGO
  const bool other = std::find(kOthers.begin(), kOthers.end(), word) != kOthers.end();
  const bool plain = word.starts_with("movej") || word.starts_with("movel");
  return other || (plain && (word.size() == 5 || (word.size() == 7 && word.ends_with('o')))) ? 1 : 0;
}

std::optional<Eigen::Vector3d> rapid_shift_m(const ProgramText& text, std::size_t begin, std::size_t end) {
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
  Eigen::Index count = 0;
  for (std::size_t at = begin; at < end; ++count) {
    const std::size_t stop = std::min(text.code().find(',', at), end);
    std::size_t first = at;
    const std::string_view number = text.trimmed(first, stop);
    const auto cell = cell_at(text.code(), first, number.size(), {});
    if (!cell || count == 3) return std::nullopt;
    shift_m[count] = 1e-3 * cell->value;
    at = stop + 1;
  }
  return count == 3 ? std::optional(shift_m) : std::nullopt;
}

std::vector<std::size_t> argument_ends(std::string_view code, std::size_t begin) {
  std::vector<std::size_t> ends;
  int depth = 0;
  for (std::size_t at = begin; at < code.size(); ++at) {
    const char letter = code[at];
    if (letter == ';') break;
    if (letter == ',' && depth == 0) ends.push_back(at);
    depth += letter == '[' || letter == '(' || letter == '{'   ? 1
             : letter == ']' || letter == ')' || letter == '}' ? -1
                                                               : 0;
  }
  ends.push_back(std::min(code.find(';', begin), code.size()));
  return ends;
}

std::vector<TextRange> displaced_by_pdisp(const ProgramText& text) {
  std::vector<TextRange> ranges;
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    const std::string word = lower_case(text.code().substr(begin, end - begin));
    if (word != "pdispset" && word != "pdispon") return;
    const auto stop = end_of_displacement(text, std::min(text.code().find(';', end), text.code().size()));
    ranges.push_back(stop ? TextRange{begin, *stop} : TextRange{0, text.code().size()});
  });
  return ranges;
}

void forget_stated_configurations(const ProgramText& text, Program& program) {
  bool off = false;
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    const std::string word = text.word_at(begin);
    if (word != "confj" && word != "confl") return;
    const std::size_t option = text.skip_spaces(end);
    off = off || (text.next(option) == '\\' && text.word_at(option + 1) == "off");
  });
  for (Target& target : program.targets) {
    if (off) target.hint = {};
  }
}

RapidStatements::RapidStatements(const ProgramText& text, Program& program)
    : text_(text), code_(text.code()), program_(program), changes_(text) {
  for (const Target& target : program.targets) {
    if (!target.name.empty()) names_.insert(lower_case(target.name.substr(0, target.name.find('{'))));
  }
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    const std::string word = lower_case(code_.substr(begin, end - begin));
    if (const std::size_t targets = targets_of_rapid_motion(word)) read_motion(end, targets);
  });
  text.for_each_word([&](std::size_t begin, std::size_t end) { read_name(begin, end); });
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    read_guidance(begin, end);
    const std::string word = text.word_at(begin);
    if (word == "tload") read_load(begin);
    if (word == "softact") note_compliance(text, begin, "SoftAct", "SoftDeact", program);
    if (word == "fcact") note_compliance(text, begin, "FCAct", "FCDeact", program);
    if (word == "cssact") note_compliance(text, begin, "CSSAct", "CSSDeactMoveL", program);
    if (word == "egmrunpose" || word == "egmrunjoint") program.joints_lost_at.push_back(begin);  // led from outside
  });
  leave_handed_on();
  changes_.mark(program.targets);
}

/// Targets that stand where they are used, in instructions that are none of the motions known: what becomes of them,
/// with which tool and in which frame, is not told.
void RapidStatements::leave_handed_on() {
  for (Target& target : program_.targets) {
    const std::size_t begin = target.begin();
    const std::size_t statement = code_.substr(0, begin).rfind(';') + 1;  // npos + 1: the text's begin
    const bool of_motion = std::ranges::any_of(
        destinations_, [&](const TextRange& range) { return begin >= range.begin && begin < range.end; });
    if (!target.name.empty() || of_motion || code_.substr(statement, begin - statement).find(":=") != std::string::npos)
      continue;
    target.not_sent_to = "it is handed to an instruction that is none of the motions known, which is not followed";
    program_.joints_lost_at.push_back(begin);
  }
}

void RapidStatements::read_motion(std::size_t end, std::size_t targets) {
  const std::vector<std::size_t> ends = argument_ends(code_, end);
  const std::size_t first = destinations_.size();
  std::size_t begin = end;
  if (code_.substr(text_.skip_spaces(begin)).starts_with('\\'))  // \Conc, before the first target
    begin = std::min(code_.find(',', begin), ends.back() - 1) + 1;
  for (const std::size_t stop : ends) {
    if (stop <= begin) continue;
    destinations_.push_back({begin, stop});
    begin = stop + 1;
    if (--targets == 0) break;
  }
  for (std::size_t i = first; i < destinations_.size(); ++i) {
    if (!holds_target(destinations_[i])) goes_elsewhere(destinations_[i]);
  }
}

void RapidStatements::read_guidance(std::size_t begin, std::size_t end) {
  const std::string word = text_.word_at(begin);
  if (word != "corr" && word != "track") return;
  const std::size_t sign = text_.option_sign(begin);
  if (sign == std::string_view::npos) return;
  const std::size_t first = code_.substr(0, begin).rfind(';') + 1;  // npos + 1: the text's begin
  const std::size_t last = std::min(code_.find(';', begin), code_.size());
  const std::string by = '\\' + std::string(code_.substr(begin, end - begin));
  for (std::size_t at = first; at < last; ++at) {
    if (!text_.begins_word(at)) continue;
    const std::size_t word_end = text_.word_end(at);
    if (names_.contains(text_.word_at(at)))
      changes_.guided(code_.substr(at, after_indices(text_, word_end) - at), begin, by);
    at = word_end - 1;
  }
  for (Target& target : program_.targets)
    if (target.begin() > first && target.begin() < last) target.not_sent_to = changes_.guided_sentence(begin, by);
  program_.joints_lost_at.push_back(begin);
}

/// It is that of the tool and what the tool carries together, while payloads are told without the tool's.
void RapidStatements::read_load(std::size_t begin) {
  if (text_.option_sign(begin) == std::string_view::npos) return;
  const std::size_t first = code_.substr(0, begin).rfind(';') + 1;  // npos + 1: the text's begin
  program_.payload_statements.push_back(
      {text_.place(begin), text_.skip_spaces(first), {}, std::min(code_.find(';', begin), code_.size())});
}

/// Whether the name or the numbers of a target stand there.
bool RapidStatements::holds_target(const TextRange& range) const {
  for (std::size_t at = range.begin; at < range.end; ++at) {
    if (code_[at] == '[') return true;
    if (text_.begins_word(at) && names_.contains(text_.word_at(at))) return true;
  }
  return false;
}

void RapidStatements::goes_elsewhere(const TextRange& range) {
  if (!elsewhere_.insert(range.begin).second) return;
  std::size_t begin = range.begin;
  std::string what(text_.trimmed(begin, range.end));
  what = what.substr(0, what.find('\\'));
  note_unknown_motion(program_, begin, {.name = "", .place = text_.place(begin)},
                      '\'' + what + "' is not given as numbers in this program");
}

std::size_t RapidStatements::after_parts(std::size_t end) const {
  while (true) {
    end = after_indices(text_, end);
    const std::size_t point = text_.skip_spaces(end);
    if (point >= code_.size() || code_[point] != '.') return end;
    end = text_.word_end(text_.skip_spaces(point + 1));
  }
}

void RapidStatements::read_name(std::size_t begin, std::size_t end) {
  const std::string word = lower_case(code_.substr(begin, end - begin));
  if (!names_.contains(word)) return;
  const std::size_t before = begin == 0 ? std::string_view::npos : code_.find_last_not_of(" \t\r\n", begin - 1);
  const char sign = before == std::string_view::npos ? '\0' : code_[before];
  if (sign == '\\' || sign == '.') return;
  if (is_word_letter(sign) && before < begin) {
    std::size_t type = before;
    while (type > 0 && is_word_letter(code_[type - 1])) --type;
    const std::string type_word = text_.word_at(type);
    if (type_word == "robtarget" || type_word == "jointtarget") {
      if (!declared_.insert(word).second) changes_.used(word, begin);  // which of them is meant where is not followed
      return;
    }
  }
  const std::size_t name_end = after_indices(text_, end), after = after_parts(end);
  const std::string name(code_.substr(begin, name_end - begin));
  if (code_.substr(text_.skip_spaces(after)).starts_with(":=")) return changes_.changed(name, begin);
  for (const TextRange& range : destinations_) {
    if (begin < range.begin || begin >= range.end) continue;
    const std::size_t option = std::min(code_.substr(0, range.end).find('\\', begin), range.end);
    if (is_plain(range.begin, option, begin, name_end)) return;
    changes_.used(name, begin);
    return goes_elsewhere(range);
  }
  if (may_move_to(begin, after == name_end)) program_.joints_lost_at.push_back(begin);
  const std::size_t equals = code_.substr(0, begin).rfind(":="), statement = code_.substr(0, begin).rfind(';');
  const bool copied = equals != std::string_view::npos && (statement == std::string_view::npos || equals > statement);
  const std::size_t stop = std::min(code_.find(';', begin), code_.size());
  if (!copied || !is_plain(equals + 2, stop, begin, name_end)) changes_.used(name, begin);
}

/// Whether the name at `begin` (`whole`: not a part of it) is handed to an instruction that is none of those known,
/// such as SearchL, ArcL or a procedure of another file: the arm is then anywhere near it.
bool RapidStatements::may_move_to(std::size_t begin, bool whole) const {
  const std::size_t before = code_.substr(0, begin).rfind(';');
  const std::string_view statement = code_.substr(before + 1, begin - before - 1);  // npos + 1: the text's begin
  const auto opened = std::ranges::count(statement, '(') - std::ranges::count(statement, ')');
  const std::string word = text_.word_at(text_.skip_spaces(before + 1));
  return whole && opened == 0 && statement.find(":=") == std::string_view::npos && word != "return" && !is_simple(word);
}

bool RapidStatements::is_plain(std::size_t begin, std::size_t end, std::size_t name_begin, std::size_t name_end) {
  begin = text_.skip_spaces(begin);
  if (begin == name_begin) return text_.skip_spaces(name_end) >= end;
  const std::string word = text_.word_at(begin);
  const std::size_t open = text_.skip_spaces(text_.word_end(begin));
  if ((word != "offs" && word != "reltool") || open >= end || code_[open] != '(') return false;
  if (text_.skip_spaces(open + 1) != name_begin || text_.next(name_end) != ',') return false;
  std::size_t close = open;
  for (int depth = 0; close < end; ++close) {
    depth += code_[close] == '(' ? 1 : code_[close] == ')' ? -1 : 0;
    if (depth == 0) break;
  }
  if (text_.skip_spaces(std::min(close + 1, end)) < end) return false;
  judge_offset(text_.skip_spaces(name_end) + 1, close, code_.substr(name_begin, name_end - name_begin));
  return true;
}

/// What stands behind the name in Offs(name, x, y, z) or RelTool(name, x, y, z \Rx:=..).
void RapidStatements::judge_offset(std::size_t begin, std::size_t end, std::string_view name) {
  const auto shift_m = rapid_shift_m(text_, begin, end);
  note_offset(program_, text_.place(begin), std::string(name),
              shift_m ? std::optional(1e3 * shift_m->norm()) : std::nullopt);
}

}  // namespace demecal::inline kuka_abb_ur
