#include <filesystem>
#include <regex>
#include <set>

#include "rules.hpp"

namespace demecal::map {
namespace {

constexpr int kMostLines = 300;

/// True where one of the part's words is forbidden, as in joint_helper.hpp.
bool is_forbidden(const std::string& part, bool below_common) {
  static const std::set<std::string> forbidden = {"util",    "utils",   "utility",  "utilities", "helper",
                                                  "helpers", "manager", "managers", "misc"};
  static const std::regex word("[A-Za-z]+");
  for (std::sregex_iterator match(part.begin(), part.end(), word), end; match != end; ++match) {
    if (forbidden.contains(match->str()) || (below_common && match->str() == "common")) return true;
  }
  return false;
}

}  // namespace

Violations check_pure_calls(const Source& source) {
  // check.hpp is the one place that speaks before it aborts.
  if (!source.path.starts_with("common/") || !is_pure(home_of(source))) return {};
  if (source.path == "common/errors/check.hpp") return {};
  static const std::regex call(
      R"(\b(random_device|default_random_engine|system_clock|steady_clock|high_resolution_clock)\b)"
      R"(|\bstd::(\w+_distribution|cout|cerr|clog|cin|jthread|thread|async|mutex|system|[io]?fstream)\b)"
      R"(|(^|[^\w.>])(time|clock|s?rand|getenv|fopen|f?printf|f?puts)\s*\()");
  Violations found;
  int number = 0;
  for (const std::string& line : lines_of(code_of(source.text))) {
    ++number;
    std::smatch match;
    if (std::regex_search(line, match, call)) {
      found.push_back({source.path, number, "a pure room may not use " + match.str()});
    }
  }
  return found;
}

Violations check_views(const Source& source) {
  static const std::regex view(
      R"(\bstd::(ranges::)?views::\w+|\branges::(subrange|\w+_view|view_interface)\b)"
      R"(|\branges::(stable_partition|partition|unique|remove|remove_if|rotate|search|equal_range)\b)");
  Violations found;
  int number = 0;
  for (const std::string& line : lines_of(code_of(source.text))) {
    ++number;
    std::smatch match;
    if (std::regex_search(line, match, view))
      found.push_back({source.path, number, "clang 14 cannot compile " + match.str()});
  }
  return found;
}

Violations check_shape(const Source& source) {
  Violations found;
  const std::size_t lines = lines_of(source.text).size();
  if (lines > kMostLines) found.push_back({source.path, 0, std::to_string(lines) + " lines, more than 300"});
  const bool introduced = is_header(source) || source.path.ends_with("_test.cpp");
  if (introduced && !source.text.starts_with("// ")) {
    found.push_back({source.path, 1, "the first line does not say what the file is for"});
  }
  return found;
}

Violations check_namespace(const Source& source) {
  if (!source.path.starts_with("common/")) return {};
  const std::string room = std::filesystem::path(source.path).parent_path().filename().string();
  Violations found;
  int number = 0;
  for (const std::string& line : lines_of(source.text)) {
    ++number;
    if (line.starts_with("namespace demecal") && line != "namespace demecal::inline " + room + " {")
      found.push_back({source.path, number, "not the namespace of the room " + room});
  }
  return found;
}

Violations check_names(const Source& source) {
  Violations found;
  bool below_common = false;
  for (const std::filesystem::path& part : std::filesystem::path(source.path)) {
    if (is_forbidden(part.stem().string(), below_common)) {
      found.push_back({source.path, 0, '\'' + part.string() + "' says nothing of what is inside"});
    }
    below_common = below_common || part == "common";
  }
  return found;
}

}  // namespace demecal::map
