#include "kuka_abb_ur/urscript_statements.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "parsed_programs/changed_names.hpp"

namespace demecal::inline kuka_abb_ur {
namespace {

/// What a statement does with a variable whose name stands at [begin, end).
enum class VariableUse { given_numbers, changed, copied, handed_on };

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

std::optional<std::size_t> urscript_literal(const ProgramText& text, std::size_t offset) {
  const std::string_view code = text.code();
  offset = text.skip_spaces(offset);
  if (offset >= code.size()) return std::nullopt;
  const bool pose = code[offset] == 'p' && text.next(offset + 1) == '[' && text.word_end(offset) == offset + 1;
  return pose || code[offset] == '[' ? std::optional(offset) : std::nullopt;
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
