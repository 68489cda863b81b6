#include <algorithm>
#include <cctype>
#include <map>
#include <regex>

#include "rules.hpp"

namespace demecal::map {
namespace {

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

/// What begins where only namespaces are open, up to its brace or semicolon.
struct Head {
  std::string text;
  int line = 0;            ///< of its end
  bool opens = false;      ///< ends with a brace
  bool anonymous = false;  ///< of a namespace without a name
};

/// Follows the braces of a file.
class HeadScan {
 public:
  std::vector<Head> run(const std::string& code) {
    for (const char c : code) {
      if (c == '{') {
        open();
      } else if (c == ';') {
        add(false);
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
  enum class Scope { named, anonymous, none };

  Scope scope() const { return scopes_.empty() ? Scope::named : scopes_.back(); }

  void open() {
    static const std::regex space(R"(^\s*(?:inline\s+)?namespace\b(?:\s|::|\w)*$)");
    static const std::regex anonymous(R"(^\s*namespace\s*$)");
    if (scope() != Scope::none && std::regex_match(head_, space)) {
      const bool nameless = scope() == Scope::anonymous || std::regex_match(head_, anonymous);
      scopes_.push_back(nameless ? Scope::anonymous : Scope::named);
      return;
    }
    add(true);
    scopes_.push_back(Scope::none);
  }

  void add(bool opens) {
    if (scope() != Scope::none) found_.push_back({head_, line_, opens, scope() == Scope::anonymous});
  }

  std::vector<Scope> scopes_;  ///< those that are open; none: within something else than namespaces
  std::vector<Head> found_;
  std::string head_;
  int line_ = 1;
};

std::vector<Head> heads_of(const Source& source) {
  return HeadScan().run(without_directives(code_of(source.text)));
}

/// The name of the type that the head begins to define; empty where it does not.
std::string defined_type(const Head& head) {
  static const std::regex type(
      R"(^\s*(?:class|struct|union|enum(?:\s+(?:class|struct))?)\s+(?:\[\[[^\]]*\]\]\s*)?([\w:]+(?:\s*<[^{]*>)?)\s*(?:final\s*)?(?::[^:].*)?$)");
  std::smatch match;
  if (!head.opens) return {};
  const std::string text = without_template(head.text);
  return std::regex_match(text, match, type) ? match[1].str() : std::string();
}

/// The text without what stands between angle brackets.
std::string without_arguments(const std::string& text) {
  std::string kept;
  std::vector<std::size_t> open;  // where each began
  for (const char c : text) {
    kept += c;
    if (c == '<') open.push_back(kept.size() - 1);
    if (c != '>' || open.empty()) continue;
    kept.resize(open.back());
    open.pop_back();
  }
  return kept;
}

/// The identifier that the text ends with, arrays' brackets aside; empty where there is none, or it is a member's.
std::string last_word(std::string text) {
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  text.resize(text.find_last_not_of(" \t") + 1);
  while (text.ends_with(']')) text.resize(std::min(text.rfind('['), text.size() - 1));
  std::size_t begin = text.size();
  while (begin > 0 && is_letter(text[begin - 1])) --begin;
  return text.substr(0, begin).ends_with("::") ? std::string() : text.substr(begin);
}

/// The variables that a declaration lists, separated by commas.
std::vector<std::string> listed_variables(const std::string& head) {
  std::vector<std::string> names;
  std::string declarator;
  int open = 0;
  bool is_value = false;
  for (const char c : head + ',') {
    open += c == '(' || c == '[' ? 1 : (c == ')' || c == ']' ? -1 : 0);
    is_value = is_value || c == '=';
    if (c != ',' || open != 0) {
      if (!is_value) declarator += c;
      continue;
    }
    names.push_back(last_word(declarator));
    declarator.clear();
    is_value = false;
  }
  return names;
}

/// What an alias stands for; empty where the head declares none.
std::string aliased(const Head& head) {
  static const std::regex alias(R"(^\s*using\s+\w+\s*=\s*)");
  std::smatch match;
  return std::regex_search(head.text, match, alias) ? match.suffix().str() : std::string();
}

/// The functions, constants and types that the head declares; some may be empty.
std::vector<std::string> declared_names(const Head& head) {
  static const std::regex nothing(R"(^\s*(?:namespace|using|friend|static_assert)\b)");
  if (const std::string type = defined_type(head); !type.empty()) return {type};
  if (std::regex_search(head.text, nothing) && aliased(head).empty()) return {};
  const std::string text = without_arguments(without_template(head.text));
  const std::size_t call = text.find('(');
  if (call < text.find('=')) return {last_word(text.substr(0, call))};
  return listed_variables(text);
}

/// Where a name was first declared, and as what.
struct FirstPlace {
  std::string path;
  int line = 0;
  std::string alias;  ///< empty: no alias
};

}  // namespace

Violations check_types_once(const std::vector<Source>& sources) {
  std::map<std::string, std::string> first;  // place by name
  Violations found;
  for (const Source& source : sources) {
    for (const Head& head : heads_of(source)) {
      const std::string type = defined_type(head);
      if (type.empty()) continue;
      const auto [known, fresh] = first.try_emplace(type, source.path + ':' + std::to_string(head.line));
      if (!fresh) found.push_back({source.path, head.line, type + " is defined already at " + known->second});
    }
  }
  return found;
}

Violations check_anonymous_once(const std::vector<Source>& sources) {
  std::map<std::string, FirstPlace> first;
  Violations found;
  for (const Source& source : sources) {
    for (const Head& head : heads_of(source)) {
      if (!head.anonymous) continue;
      for (const std::string& name : declared_names(head)) {
        if (name.empty() || name == "operator") continue;
        const FirstPlace place{source.path, head.line, aliased(head)};
        const FirstPlace& before = first.try_emplace(name, place).first->second;
        const bool same = before.path == source.path || (!place.alias.empty() && before.alias == place.alias);
        if (same) continue;
        found.push_back({source.path, head.line,
                         name + " is declared already at " + before.path + ':' + std::to_string(before.line)});
      }
    }
  }
  return found;
}

}  // namespace demecal::map
