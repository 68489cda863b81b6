#include "staubli_kawasaki/location_names.hpp"

#include <algorithm>
#include <set>

#include "data/text.hpp"

namespace demecal::inline staubli_kawasaki {
namespace {

/// The name without its indices, a bracket open where there are some: "p[" of "p[1]".
std::string array_of(const std::string& name) {
  const std::size_t open = name.find('[');
  return open == std::string::npos ? name : name.substr(0, open + 1);
}

/// Whether the indices of a name are numbers.
bool has_known_indices(const std::string& name) {
  const std::size_t open = name.find('[');
  return open == std::string::npos || name.find_first_not_of("0123456789, ]", open + 1) == std::string::npos;
}

}  // namespace

std::string location_name(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::string_view code = text.code();
  std::size_t at = begin;
  if (at < end && code[at] == '#') ++at;
  const std::size_t first = at;
  while (at < end && (is_word_letter(code[at]) || code[at] == '.')) ++at;
  if (at == first || is_digit(code[first])) return "";
  if (at < end && code[at] == '[') at = std::min(code.find(']', at), end - 1) + 1;
  return std::string(code.substr(begin, at - begin));
}

std::string location_key(std::string_view name) {
  std::string key = lower_case(name);
  std::erase_if(key, [](char letter) { return letter == ' ' || letter == '\t'; });
  return key;
}

std::vector<std::string> location_names(const ProgramText& text, std::size_t begin, std::size_t end) {
  std::vector<std::string> found;
  for (std::size_t at = begin; at < end;) {
    if (text.code()[at] == '"') {  // what is printed
      at = std::min(text.code().find('"', at + 1), end - 1) + 1;
      continue;
    }
    const std::string name = location_name(text, at, end);
    if (!name.empty()) found.push_back(name);
    at = name.empty() ? at + 1 : at + name.size();
  }
  return found;
}

void note_untold_locations(const ProgramText& text, const std::map<std::string, std::vector<TargetUse>>& uses,
                           const std::function<std::string(const std::string&)>& why, Program& program) {
  std::set<std::string> given;
  for (const Target& target : program.targets) {
    given.insert(location_key(target.name));
    given.insert(array_of(location_key(target.name)));
  }
  for (const auto& [name, motions] : uses) {
    const bool known = has_known_indices(name);
    const bool is_given = given.contains(known ? name : array_of(name));
    const std::string reason = is_given ? "" : why(name);
    for (const TargetUse& use : motions) {
      if (is_given && !known) program.joints_lost_at.push_back(use.begin);
      if (is_given) continue;
      note_unknown_motion(program, use.begin, {.name = name, .place = text.place(use.begin)},
                          reason.empty() ? "it is not given as numbers in this program" : reason);
    }
  }
}

void leave_frame(const Target& target, const std::vector<TargetUse>& motions, Program& program) {
  if (motions.empty()) return;
  skip_target(program, target, "TOOL or BASE of this program is set to it");
  for (const TargetUse& motion : motions) program.joints_lost_at.push_back(motion.begin);
}

void add_unknown_statement(const ProgramText& text, std::size_t statement, std::size_t begin, std::size_t end,
                           UnknownStatements& statements) {
  while (begin < end) {
    const std::size_t stop = end_of_argument(text.code(), begin, end);
    std::size_t first = begin;
    const std::string_view argument = text.trimmed(first, stop);
    const std::string name = location_name(text, first, first + argument.size());
    if (!name.empty() && name.size() == argument.size()) statements.emplace_back(statement, location_key(name));
    begin = stop + 1;
  }
}

void end_at_unknown_statements(const UnknownStatements& statements, Program& program) {
  std::set<std::string> given;
  for (const Target& target : program.targets) given.insert(location_key(target.name));
  for (const auto& [begin, name] : statements)
    if (given.contains(name)) program.joints_lost_at.push_back(begin);
}

std::size_t find_word(const ProgramText& text, std::size_t begin, std::size_t end, std::string_view word) {
  for (std::size_t at = begin; at < end; ++at) {
    if (!text.begins_word(at)) continue;
    if (text.word_at(at) == word) return at;
    at = std::min(text.word_end(at), end) - 1;
  }
  return end;
}

std::size_t end_of_argument(std::string_view code, std::size_t begin, std::size_t end) {
  int depth = 0;
  for (std::size_t at = begin; at < end; ++at) {
    if (code[at] == ',' && depth == 0) return at;
    depth += code[at] == '(' || code[at] == '[' ? 1 : code[at] == ')' || code[at] == ']' ? -1 : 0;
  }
  return end;
}

}  // namespace demecal::inline staubli_kawasaki
