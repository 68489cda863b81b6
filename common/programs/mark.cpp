#include "programs/mark.hpp"

#include <algorithm>
#include <string_view>

#include "data/lower_case.hpp"

namespace demecal {
namespace {

constexpr std::string_view kMark = "corrected by demecal";

char comment_of(Language language) {
  switch (language) {
    case Language::val2:
    case Language::krl:
      return ';';
    case Language::rapid:
      return '!';
    case Language::urscript:
    case Language::csv:
      break;
  }
  return '#';
}

/// Whether a line (small letters, nothing before it) opens what comments may stand in.
bool is_header(std::string_view line, Language language) {
  const auto starts = [&](std::string_view word) { return line.starts_with(word); };
  switch (language) {
    case Language::val2:
      return starts(".program") || starts(".locations");
    case Language::krl:
      return starts("def ") || starts("defdat") || starts("deffct") || starts("global def");
    case Language::rapid:
      return starts("module");
    case Language::urscript:
    case Language::csv:
      break;
  }
  return false;
}

/// Past the line break of the line at `begin`.
std::size_t next_line(std::string_view text, std::size_t begin) {
  const std::size_t end = text.find('\n', begin);
  return end == std::string_view::npos ? text.size() : end + 1;
}

/// Where the comment goes: behind the first header or, without one, behind lines that are no code.
std::size_t place_of_mark(std::string_view text, Language language) {
  const std::size_t first = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  std::size_t behind_lines = first;
  for (std::size_t begin = first; begin < text.size(); begin = next_line(text, begin)) {
    const std::string_view line = text.substr(begin, next_line(text, begin) - begin);
    if (line.starts_with('&') && behind_lines == begin) behind_lines = next_line(text, begin);
    const std::size_t word = std::min(line.find_first_not_of(" \t"), line.size());
    if (is_header(lower_case(line.substr(word)), language)) return next_line(text, begin);
  }
  return behind_lines;
}

}  // namespace

std::string mark_of(const std::string& version, const std::string& job, const std::string& data_sha256) {
  constexpr std::size_t kShown = 12;
  std::string mark = std::string(kMark) + ' ' + version + " with the model of " + job;
  if (!data_sha256.empty()) mark += " (data " + data_sha256.substr(0, kShown) + ')';
  std::replace_if(
      mark.begin(), mark.end(), [](char letter) { return static_cast<unsigned char>(letter) < 0x20; }, ' ');
  return mark;
}

std::string with_mark(const std::string& text, Language language, const std::string& mark) {
  const std::size_t break_at = text.find('\n');
  const std::string line_break =
      break_at != std::string::npos && break_at > 0 && text[break_at - 1] == '\r' ? "\r\n" : "\n";
  const std::size_t place = place_of_mark(text, language);
  const bool open_line = place > 0 && place == text.size() && text.back() != '\n';
  const std::string line = std::string(1, comment_of(language)) + ' ' + mark + line_break;
  return text.substr(0, place) + (open_line ? line_break : "") + line + text.substr(place);
}

std::optional<std::size_t> marked_line(std::string_view text) {
  const std::size_t at = text.find(kMark);
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  constexpr std::string_view kComments = ";!#";
  const std::string_view before = text.substr(begin, at - begin);
  const std::size_t first = std::min(before.find_first_not_of("\xEF\xBB\xBF \t"), before.size());
  if (first == before.size() || kComments.find(before[first]) == std::string_view::npos) return std::nullopt;
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace demecal
