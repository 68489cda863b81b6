#include "kuka_abb_ur/urscript_statements.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "parsed_programs/changed_names.hpp"

namespace demecal::inline kuka_abb_ur {
namespace {

/// What a statement does with a variable whose name stands at [begin, end).
enum class VariableUse { given_numbers, changed, copied, handed_on };

/// The last sign before `begin` that is no blank; a line end at the text's begin.
char previous_sign(const ProgramText& text, std::size_t begin) {
  const std::size_t before = begin == 0 ? std::string_view::npos : text.code().find_last_not_of(" \t", begin - 1);
  return before == std::string_view::npos ? '\n' : text.code()[before];
}

VariableUse use_of(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::string_view code = text.code();
  const std::size_t before = begin == 0 ? std::string_view::npos : code.find_last_not_of(" \t", begin - 1);
  const char sign = before == std::string_view::npos ? '\n' : code[before];
  std::size_t after = text.skip_spaces(end);
  const bool element = after < code.size() && code[after] == '[';
  if (element) after = text.skip_spaces(std::min(code.find(']', after), code.size() - 1) + 1);
  if (after < code.size() && code[after] == '=' && !code.substr(after).starts_with("==")) {
    const bool argument = sign == '(' || sign == ',';  // of this name
    return argument || (!element && urscript_literal(text, after + 1)) ? VariableUse::given_numbers
                                                                       : VariableUse::changed;
  }
  const std::size_t line_end = std::min(code.find('\n', begin), code.size());
  const bool behind_sign = sign == '=' && before > 0 && code[before - 1] != '=';
  return behind_sign && text.skip_spaces(end) >= line_end ? VariableUse::copied : VariableUse::handed_on;
}

}  // namespace

int urscript_targets(std::string_view word) {
  if (word == "movec") return 2;
  constexpr std::array<std::string_view, 7> kCommands{"movej",  "movel",     "movep",    "servoj",
                                                      "servoc", "optimovej", "optimovel"};
  return std::find(kCommands.begin(), kCommands.end(), word) != kCommands.end() ? 1 : 0;
}

std::optional<std::size_t> urscript_literal(const ProgramText& text, std::size_t offset) {
  const std::string_view code = text.code();
  offset = text.skip_spaces(offset);
  if (offset >= code.size()) return std::nullopt;
  const bool pose = code[offset] == 'p' && text.next(offset + 1) == '[' && text.word_end(offset) == offset + 1;
  if (!pose && code[offset] != '[') return std::nullopt;
  int depth = 0;
  std::size_t end = code.find('[', offset);
  for (; end < code.size(); ++end) {
    depth += code[end] == '[' ? 1 : code[end] == ']' ? -1 : 0;
    if (depth == 0) break;
  }
  const std::size_t behind = std::min(code.find_first_not_of(" \t\r", std::min(end + 1, code.size())), code.size());
  const bool ends = behind == code.size() || is_word_letter(code[behind]) ||
                    std::string_view(",)];\n").find(code[behind]) != std::string_view::npos;
  return ends ? std::optional(offset) : std::nullopt;
}

std::optional<std::size_t> UrScriptVariables::only_literal(const std::string& name) const {
  const auto found = literals.find(name);
  const bool only = found != literals.end() && found->second.size() == 1;
  return only && !computed.contains(name) && !parameters.contains(name) ? std::optional(found->second.front())
                                                                        : std::nullopt;
}

std::vector<std::size_t> UrScriptVariables::literals_at(const std::string& name, std::size_t motion,
                                                        const FrameFlow& way) const {
  const std::optional<std::size_t> given_last = given.at(name, motion, way);
  return given_last ? std::vector{*given_last} : literals.at(name);
}

std::optional<std::size_t> urscript_close(const ProgramText& text, std::size_t open) {
  const std::string_view code = text.code();
  int depth = 0;
  for (std::size_t at = open; at < code.size(); ++at) {
    depth += code[at] == '(' ? 1 : code[at] == ')' ? -1 : 0;
    if (depth == 0) return at;
  }
  return std::nullopt;
}

UrScriptVariables urscript_variables(const ProgramText& text) {
  const std::string_view code = text.code();
  UrScriptVariables variables;
  std::size_t header_end = 0;  // of the function whose header is being read
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    const std::string name(code.substr(begin, end - begin));
    if (name == "def" || name == "thread" || name == "sec") {
      const std::size_t open = text.skip_spaces(text.word_end(text.skip_spaces(end)));
      if (open < code.size() && code[open] == '(') header_end = urscript_close(text, open).value_or(open);
      return;
    }
    const char before = previous_sign(text, begin);
    if (begin < header_end) {
      if (before == '(' || before == ',') variables.parameters.insert(name);
      return;
    }
    if (before == '(' || before == ',') return;  // an argument, by name or not
    std::size_t sign = text.skip_spaces(end);
    const bool part = sign < code.size() && (code[sign] == '[' || code[sign] == '.');
    while (sign < code.size() && (code[sign] == '[' || code[sign] == '.'))
      sign = text.skip_spaces(code[sign] == '[' ? std::min(code.find(']', sign), code.size() - 1) + 1
                                                : text.word_end(text.skip_spaces(sign + 1)));
    if (sign >= code.size() || code[sign] != '=' || code.substr(sign).starts_with("==")) return;
    const auto literal = part ? std::nullopt : urscript_literal(text, sign + 1);
    if (!literal) return void(variables.computed.insert(name));
    variables.literals[name].push_back(*literal);
    variables.given.give(name, *literal);
  });
  return variables;
}

std::size_t urscript_argument(const ProgramText& text, std::size_t offset) {
  const std::size_t begin = text.skip_spaces(offset), end = text.word_end(begin);
  if (end == begin || text.next(end) != '=') return offset;
  const std::size_t sign = text.skip_spaces(end);
  return text.code().substr(sign).starts_with("==") ? offset : sign + 1;
}

std::size_t urscript_argument_end(const ProgramText& text, std::size_t offset) {
  const std::string_view code = text.code();
  int depth = 0;
  for (; offset < code.size(); ++offset) {
    const char letter = code[offset];
    if (depth == 0 && (letter == ',' || letter == ')')) return offset;
    depth += letter == '(' || letter == '[' ? 1 : letter == ')' || letter == ']' ? -1 : 0;
  }
  return offset;
}

void mark_changed(const ProgramText& text, const std::set<std::size_t>& plain, std::vector<Target>& targets) {
  std::set<std::string> names;
  for (const Target& target : targets) names.insert(target.name);
  ChangedNames changes(text);
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    const std::string name(text.code().substr(begin, end - begin));
    if (!names.contains(name) || plain.contains(begin)) return;
    const VariableUse use = use_of(text, begin, end);
    if (use == VariableUse::changed) changes.changed(name, begin);
    if (use == VariableUse::handed_on) changes.used(name, begin);
  });
  changes.mark(targets);
}

std::string longer_than_a_turn(const Target& target) {
  constexpr double kLongest_rad = 2.0 * std::numbers::pi + 0.3;
  const std::vector<double> turn_rad = inside(target.orientation);
  const double length_rad = Eigen::Vector3d(turn_rad[0], turn_rad[1], turn_rad[2]).norm();
  if (length_rad <= kLongest_rad) return "";
  const std::string tenths = std::to_string(std::lround(10.0 * length_rad));
  return "its rotation vector is " + tenths.substr(0, tenths.size() - 1) + '.' + tenths.back() +
         " rad long, more than a turn; URScript counts in rad, not in degrees";
}

}  // namespace demecal::inline kuka_abb_ur
