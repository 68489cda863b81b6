#include "staubli_kawasaki/val3_program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace demecal::inline staubli_kawasaki {
namespace {

/// Functions that leave these of their arguments, from 0, as they are.
bool keeps_argument(std::string_view function, std::size_t argument) {
  struct Kept {
    std::string_view function;
    std::size_t arguments;
  };
  constexpr std::array<Kept, 8> kKept{{{"appro", 2},
                                       {"compose", 3},
                                       {"here", 2},
                                       {"jointToPoint", 3},
                                       {"pointToJoint", 3},
                                       {"distance", 2},
                                       {"open", 1},
                                       {"close", 1}}};
  return std::any_of(kKept.begin(), kKept.end(),
                     [&](const Kept& kept) { return kept.function == function && argument < kept.arguments; });
}

/// How many places a motion is sent to; 0: it is none. alterMovel and the like are shifted while they run, and in
/// movelf and the like the arm gives way to forces.
std::size_t goals_of_motion(std::string_view function) {
  for (const std::string_view plain : {"movej", "movel", "movec"}) {
    const bool altered = function.starts_with("alterM") && function.substr(6) == plain.substr(1);
    const bool compliant = function.size() == plain.size() + 1 && function.starts_with(plain) && function.back() == 'f';
    if (function == plain || altered || compliant) return plain == "movec" ? 2 : 1;
  }
  return 0;
}

/// The code of the programs without comments; all else is blank.
std::string bare_code(const ProgramText& text, const std::vector<Val3Code>& programs) {
  constexpr std::string_view kOpening = "<![CDATA[", kClosing = "]]>";
  const std::string_view all = text.code();
  std::string bare(all.size(), ' ');
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] == '\n' || all[i] == '\r') bare[i] = all[i];
  }
  for (const Val3Code& program : programs) {
    for (std::size_t at = program.begin; at < program.end; ++at) {
      const std::string_view rest = all.substr(at, program.end - at);
      if (rest.starts_with("//")) {
        at = std::min(all.find('\n', at), program.end);
      } else if (rest.starts_with(kOpening)) {
        at += kOpening.size() - 1;
      } else if (rest.starts_with(kClosing)) {
        at += kClosing.size() - 1;
      } else {
        bare[at] = all[at];
      }
    }
  }
  return bare;
}

/// "pPick" of "pPick[2]".
std::string without_index(const std::string& name) {
  return name.substr(0, name.find('['));
}

}  // namespace

Val3Statements::Val3Statements(const ProgramText& text)
    : text_(text), bare_(bare_code(text, val3_programs(text)), text.source().file()), code_(bare_, {}) {
  for (const Val3Code& program : val3_programs(text)) {
    any_ = true;
    locals_ = &program.locals;
    read(program.begin, program.end, "");
  }
  locals_ = nullptr;
  for (const Val3Code& program : val3_programs(text))
    std::erase_if(calls_elsewhere_, [&](const auto& call) { return call.second == program.name; });
}

/// Reads [begin, end); `use`: the function whose argument it is, empty where names may be assigned to.
void Val3Statements::read(std::size_t begin, std::size_t end, const std::string& use) {
  constexpr int kDeepest = 20;
  if (++depth_ > kDeepest) text_.fail(begin, 1, "is nested too deeply");
  for (std::size_t at = begin; at < end;) {
    if (!code_.begins_word(at) || (at > begin && code_.code()[at - 1] == '.')) {
      ++at;
      continue;
    }
    const std::size_t open = code_.skip_spaces(code_.word_end(at));
    if (code_.code().substr(at, code_.word_end(at) - at) == "call" && open < end) {
      const std::size_t stop = std::min(code_.code().find_first_of("( \t\r\n", open), end);
      calls_elsewhere_.emplace(open, code_.code().substr(open, stop - open));
    }
    const bool call = open < end && code_.code()[open] == '(';
    if (call) note_loading(at, open, end);
    at = call ? read_call(at, open, end) : read_reference(at, end, use);
  }
  --depth_;
}

/// libLoad(...), and the program that taskCreate starts: they may do what a program that is called does.
void Val3Statements::note_loading(std::size_t begin, std::size_t open, std::size_t end) {
  const std::string_view code = code_.code();
  const std::string_view word = code.substr(begin, code_.word_end(begin) - begin);
  if (word.ends_with("libLoad"))
    calls_elsewhere_.emplace(begin, text_.text().substr(begin, close_of(open, end) + 1 - begin));
  const std::size_t line = code.rfind('\n', begin) + 1, start = code_.skip_spaces(line);
  const bool starts_task = start < begin && code_.word_at(start).starts_with("taskcreate");
  if (starts_task && code_.word_end(start) < begin && depth_ == 1) calls_elsewhere_.emplace(begin, word);
}

/// Takes a name that no motion is given: as changed, unless `use` is "kept". Returns where to go on.
std::size_t Val3Statements::read_reference(std::size_t begin, std::size_t end, const std::string& use) {
  const Reference found = reference(begin, end);
  const std::size_t next = code_.skip_spaces(found.end);
  const bool assigned = use.empty() && code_.next(next) == '=' && !code_.code().substr(next).starts_with("==");
  if (!found.name.empty() && use != "kept") {
    const std::string why = assigned      ? "the program changes it"
                            : use.empty() ? "the program computes with it"
                                          : "the program uses it in " + use + "(), which is not followed";
    changed_.try_emplace(found.name, why);
  }
  const std::size_t index = code_.code().find('[', begin);
  if (index < found.end) read(index + 1, found.end, "an index");
  return std::max(found.end, begin + 1);
}

std::size_t Val3Statements::read_call(std::size_t begin, std::size_t open, std::size_t end) {
  const std::string function(code_.code().substr(begin, code_.word_end(begin) - begin));
  const std::size_t close = close_of(open, end);
  const std::vector<Argument> given = arguments(open, close);
  if (goals_of_motion(function) > 0) {
    read_motion(function, begin, given);
  } else {
    for (std::size_t i = 0; i < given.size(); ++i)
      read(given[i].begin, given[i].end, keeps_argument(function, i) ? "kept" : function);
  }
  return close + 1;
}

void Val3Statements::read_motion(const std::string& word, std::size_t begin, const std::vector<Argument>& given) {
  const std::size_t goals = goals_of_motion(word);
  const bool plain = word.starts_with("move") && word.size() == 5;
  Val3Motion motion{begin, word == "movej" ? Motion::joints : Motion::line, ""};
  if (given.size() > goals) motion.tool = only_reference(given[goals]).name;
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (i < goals) {
      if (!plain) read(given[i].begin, given[i].end, word);
      read_goal(given[i], motion);
    } else if (i > goals || motion.tool.empty()) {
      read(given[i].begin, given[i].end, "kept");
    }
  }
}

/// A goal is a value of the data, or near one: appro(pPick, ...).
void Val3Statements::read_goal(const Argument& argument, const Val3Motion& motion) {
  Reference goal = only_reference(argument);
  const std::size_t begin = code_.skip_spaces(argument.begin);
  if (goal.name.empty() && begin < argument.end) {
    read(argument.begin, argument.end, "kept");
    if (read_nearby({begin, argument.end}, motion)) return;
    computed_.emplace(begin, text_.text().substr(begin, std::min<std::size_t>(argument.end - begin, 40)));
    return;
  }
  if (goal.name.empty()) return;
  motions_[goal.name].push_back(motion);
}

/// Whether the goal is appro(...) or compose(...) of a value and nothing else.
bool Val3Statements::read_nearby(const Argument& argument, const Val3Motion& motion) {
  const std::size_t word_end = std::min(code_.word_end(argument.begin), argument.end);
  const std::string_view function = code_.code().substr(argument.begin, word_end - argument.begin);
  const std::size_t open = code_.skip_spaces(word_end), needed = function == "compose" ? 3 : 2;
  if ((function != "appro" && function != "compose") || open >= argument.end || code_.code()[open] != '(') return false;
  const std::size_t close = close_of(open, argument.end);
  const std::vector<Argument> given = arguments(open, close);
  if (given.size() != needed || code_.skip_spaces(close + 1) < argument.end) return false;
  const std::string name = only_reference(given.front()).name;
  if (name.empty()) return false;
  motions_[name].push_back(motion);
  nearby_.push_back(
      {motion.begin, name, written_shift_m(given.back()), only_reference(given.back()).name, function == "appro"});
  return true;
}

/// Of "{x, y, z, rx, ry, rz}" that is all numbers and does not turn.
std::optional<Eigen::Vector3d> Val3Statements::written_shift_m(const Argument& offset) const {
  const std::string_view code = code_.code();
  const std::size_t open = code_.skip_spaces(offset.begin), close = code.find('}', open);
  if (open >= offset.end || code[open] != '{' || close >= offset.end || code_.skip_spaces(close + 1) < offset.end)
    return std::nullopt;
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
  Eigen::Index count = 0;
  for (std::size_t at = open + 1; at <= close; ++count) {
    const std::size_t stop = std::min(code.find(',', at), close);
    std::size_t first = at;
    const std::string_view number = code_.trimmed(first, stop);
    const auto cell = cell_at(code, first, number.size(), {});
    if (!cell || (count >= 3 && cell->value != 0.0)) return std::nullopt;
    if (count < 3) shift_m[count] = 1e-3 * cell->value;
    at = stop + 1;
  }
  return count == 6 ? std::optional(shift_m) : std::nullopt;
}

/// NAME, NAME[index], and what is taken of it; no name where it is one of the program's own or a number.
Val3Statements::Reference Val3Statements::reference(std::size_t begin, std::size_t end) const {
  const std::string_view code = code_.code();
  Reference found{"", std::min(code_.word_end(begin), end), true};
  const std::string name(code.substr(begin, found.end - begin));
  std::string index = "[0]";
  std::size_t next = code_.skip_spaces(found.end);
  if (next < end && code[next] == '[') {
    const std::size_t close = std::min(code.find(']', next), end);
    std::string inside(text_.text().substr(next + 1, close - std::min(close, next + 1)));
    std::erase_if(inside, [](char letter) { return letter == ' ' || letter == '\t'; });
    const bool quoted = inside.size() > 1 && inside.front() == '"' && inside.back() == '"';
    const bool number = !inside.empty() && std::all_of(inside.begin(), inside.end(), is_digit);
    index = quoted ? '[' + inside.substr(1, inside.size() - 2) + ']' : number ? '[' + inside + ']' : "";
    found.end = std::min(close + 1, end);
    next = code_.skip_spaces(found.end);
  }
  while (next < end && code[next] == '.') {
    found.whole = false;
    found.end = std::max(std::min(code_.word_end(code_.skip_spaces(next + 1)), end), next + 1);
    next = code_.skip_spaces(found.end);
  }
  if (locals_ == nullptr || !locals_->contains(name)) found.name = name + index;
  return found;
}

Val3Statements::Reference Val3Statements::only_reference(const Argument& argument) const {
  const std::size_t begin = code_.skip_spaces(argument.begin);
  if (begin >= argument.end || !code_.begins_word(begin)) return {};
  Reference found = reference(begin, argument.end);
  if (code_.skip_spaces(found.end) < argument.end || !found.whole) return {};
  return found;
}

std::vector<Val3Statements::Argument> Val3Statements::arguments(std::size_t open, std::size_t close) const {
  std::vector<Argument> found;
  int depth = 0;
  std::size_t begin = open + 1;
  for (std::size_t at = open + 1; at < close; ++at) {
    const char letter = code_.code()[at];
    depth += letter == '(' || letter == '[' || letter == '{'   ? 1
             : letter == ')' || letter == ']' || letter == '}' ? -1
                                                               : 0;
    if (letter != ',' || depth != 0) continue;
    found.push_back({begin, at});
    begin = at + 1;
  }
  if (code_.skip_spaces(begin) < close || !found.empty()) found.push_back({begin, std::max(begin, close)});
  return found;
}

/// The parenthesis that closes what opens at `open`, or `end`.
std::size_t Val3Statements::close_of(std::size_t open, std::size_t end) const {
  int depth = 0;
  for (std::size_t at = open; at < end; ++at) {
    const char letter = code_.code()[at];
    depth += letter == '(' ? 1 : letter == ')' ? -1 : 0;
    if (depth == 0) return at;
  }
  return end;
}

std::vector<Val3Motion> Val3Statements::motions(const std::string& name) const {
  std::vector<Val3Motion> found;
  for (const std::string& key : {name, without_index(name)}) {
    if (const auto motions = motions_.find(key); motions != motions_.end())
      found.insert(found.end(), motions->second.begin(), motions->second.end());
  }
  return found;
}

std::string Val3Statements::changed(const std::string& name) const {
  for (const std::string& key : {name, without_index(name)}) {
    if (const auto found = changed_.find(key); found != changed_.end()) return found->second;
  }
  return "";
}

}  // namespace demecal::inline staubli_kawasaki
