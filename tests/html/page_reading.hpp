// Reading the page back as a browser would: its tags, tables, pictures and words.
#pragma once

#include <iomanip>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace demecal {

inline std::string with_all_replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// The text that markup without tags stands for.
inline std::string unescaped(std::string text) {
  const std::vector<std::pair<std::string, std::string>> entities{
      {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}, {"&amp;", "&"}};
  for (const auto& [entity, letter] : entities) text = with_all_replaced(text, entity, letter);
  return text;
}

/// Without what stands within its scripts, which is no markup to a browser.
inline std::string without_scripts(const std::string& page) {
  std::string text;
  std::size_t at = 0;
  for (std::size_t begin = page.find("<script"); begin != std::string::npos; begin = page.find("<script", at)) {
    const std::size_t inside = page.find('>', begin), end = page.find("</script>", begin);
    if (inside == std::string::npos || end == std::string::npos) break;
    text += page.substr(at, inside + 1 - at);
    at = end;
  }
  return text + page.substr(at);
}

/// The words of markup, without its tags and scripts.
inline std::string words_of(const std::string& page) {
  const std::string markup = without_scripts(page);
  std::string text;
  bool inside = false;
  for (const char letter : markup) {
    if (letter == '<') inside = true;
    if (!inside) text += letter;
    if (letter == '>') inside = false;
  }
  return unescaped(text);
}

/// All stretches of `text` that begin after `from` and end before the next `to`.
inline std::vector<std::string> all_between(const std::string& text, const std::string& from, const std::string& to) {
  std::vector<std::string> found;
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    at += from.size();
    const std::size_t end = text.find(to, at);
    if (end == std::string::npos) break;
    found.push_back(text.substr(at, end - at));
  }
  return found;
}

/// The words of each cell of each row of the table's body; empty where the page has no such table.
inline std::vector<std::vector<std::string>> table_of(const std::string& page, const std::string& id) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& table : all_between(page, "<table id=\"" + id + "\"", "</table>")) {
    const std::string body = table.substr(table.find("<tbody>"));
    for (const std::string& row : all_between(body, "<tr", "</tr>")) {
      rows.emplace_back();
      for (const std::string& cell : all_between(with_all_replaced(row, "<th ", "<td "), "<td", "</t")) {
        rows.back().push_back(words_of(cell.substr(cell.find('>') + 1)));
      }
    }
  }
  return rows;
}

using Points = std::vector<std::pair<double, double>>;

/// The points of every line whose CSS class begins so.
inline std::vector<Points> lines_of(const std::string& page, const std::string& css_class) {
  std::vector<Points> lines;
  for (const std::string& line : all_between(page, "<polyline class=\"" + css_class, "</polyline>")) {
    std::istringstream places(all_between(line, "points=\"", "\"").at(0));
    lines.emplace_back();
    char comma = 0;
    for (double x = 0.0, y = 0.0; places >> x >> comma >> y;) lines.back().emplace_back(x, y);
  }
  return lines;
}

inline std::size_t points_in(const std::vector<Points>& lines) {
  std::size_t points = 0;
  for (const Points& line : lines) points += line.size();
  return points;
}

/// The tags that are closed wrongly or never, in words; empty in a well-formed page.
inline std::string unbalanced(const std::string& page) {
  const std::set<std::string> closed_by_themselves{"!DOCTYPE", "input", "meta"};
  std::vector<std::string> open;
  for (const std::string& tag : all_between(without_scripts(page), "<", ">")) {
    const std::string name = tag.substr(0, tag.find_first_of(" \n/", 1));
    if (closed_by_themselves.contains(name) || tag.ends_with('/')) continue;
    if (!tag.starts_with('/')) {
      open.push_back(name);
    } else if (open.empty() || "/" + open.back() != tag) {
      return tag + " closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back() + " is never closed";
}

/// As the tables write a number: so many decimals, and no sign before a zero.
inline std::string rounded(double value, int decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  const bool zero = text.str().find_first_of("123456789") == std::string::npos;
  return zero && value < 0.0 ? text.str().substr(1) : text.str();
}

}  // namespace demecal
