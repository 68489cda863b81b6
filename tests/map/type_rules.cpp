#include <map>
#include <regex>

#include "rules.hpp"

namespace demecal::map {
namespace {

/// A class, struct, union or enumeration defined at namespace scope, an anonymous one too; its name without namespaces.
struct TypeDefinition {
  std::string name;
  int line = 0;
};

/// Preprocessor lines blanked out, with those that go on after a backslash.
std::string without_directives(const std::string& code) {
  std::string text;
  bool goes_on = false;
  for (const std::string& line : lines_of(code)) {
    const std::size_t first = line.find_first_not_of(" \t");
    const bool directive = goes_on || (first != std::string::npos && line[first] == '#');
    goes_on = directive && line.ends_with('\\');
    text += (directive ? "" : line) + '\n';
  }
  return text;
}

/// The text without its leading `template <...>`.
std::string without_template(const std::string& head) {
  static const std::regex beginning(R"(^\s*template\s*<)");
  std::smatch match;
  if (!std::regex_search(head, match, beginning)) return head;
  int open = 1;
  std::size_t at = static_cast<std::size_t>(match.length());
  for (; at < head.size() && open > 0; ++at) open += head[at] == '<' ? 1 : (head[at] == '>' ? -1 : 0);
  return without_template(head.substr(at));
}

/// Follows the braces of a file and remembers what is defined where only namespaces are open.
class TypeScan {
 public:
  std::vector<TypeDefinition> run(const std::string& code) {
    for (const char c : code) {
      if (c == '{') {
        open();
      } else if (c == '}' && !scopes_.empty()) {
        scopes_.pop_back();
      }
      const bool ends = c == '{' || c == '}' || c == ';';
      head_ = ends ? "" : head_ + (c == '\n' ? ' ' : c);
      line_ += c == '\n' ? 1 : 0;
    }
    return std::move(found_);
  }

 private:
  void open() {
    static const std::regex space(R"(^\s*(?:inline\s+)?namespace\b(?:\s|::|\w)*$)");
    static const std::regex type(
        R"(^\s*(?:class|struct|union|enum(?:\s+(?:class|struct))?)\s+(?:\[\[[^\]]*\]\]\s*)?([\w:]+(?:\s*<[^{]*>)?)\s*(?:final\s*)?(?::[^:].*)?$)");
    const bool within_namespaces = scopes_.empty() || scopes_.back();
    std::smatch match;
    if (std::regex_match(head_, space)) {
      scopes_.push_back(within_namespaces);
      return;
    }
    const std::string head = without_template(head_);
    if (within_namespaces && std::regex_match(head, match, type)) found_.push_back({match[1].str(), line_});
    scopes_.push_back(false);
  }

  std::vector<bool> scopes_;  ///< whether each that is open is a namespace within namespaces
  std::vector<TypeDefinition> found_;
  std::string head_;
  int line_ = 1;
};

}  // namespace

Violations check_types_once(const std::vector<Source>& sources) {
  std::map<std::string, std::string> first;  // place by name
  Violations found;
  for (const Source& source : sources) {
    for (const TypeDefinition& type : TypeScan().run(without_directives(code_of(source.text)))) {
      const auto [known, fresh] = first.try_emplace(type.name, source.path + ':' + std::to_string(type.line));
      if (!fresh) found.push_back({source.path, type.line, type.name + " is defined already at " + known->second});
    }
  }
  return found;
}

}  // namespace demecal::map
