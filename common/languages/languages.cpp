#include "languages/languages.hpp"

#include <algorithm>

#include "data/text.hpp"

namespace demecal::inline languages {

// One row a language, defined in its own file. Signs of CSV are words of any program: it comes last.
Language val2_language();
Language rapid_language();
Language krl_language();
Language urscript_language();
Language csv_language();

std::span<const Language> all_languages() {
  static const std::vector<Language> all{val2_language(), rapid_language(), krl_language(), urscript_language(),
                                         csv_language()};
  return all;
}

namespace {

constexpr std::string_view kMark = "corrected by demecal";

/// Whether a line (small letters, nothing before it) opens what comments may stand in.
bool is_header(std::string_view line, const Language& language) {
  return std::any_of(language.headers.begin(), language.headers.end(),
                     [&](std::string_view header) { return line.starts_with(header); });
}

/// Past the line break of the line at `begin`.
std::size_t next_line(std::string_view text, std::size_t begin) {
  const std::size_t end = text.find('\n', begin);
  return end == std::string_view::npos ? text.size() : end + 1;
}

/// Where the comment goes: behind the first header or, without one, behind lines that are no code.
std::size_t place_of_mark(std::string_view text, const Language& language) {
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

template <typename Match>
const Language* first_of(std::span<const Language> among, const Match& match) {
  const auto found = std::find_if(among.begin(), among.end(), match);
  return found == among.end() ? nullptr : &*found;
}

}  // namespace

const Language* find_language(std::string_view name, std::span<const Language> among) {
  return first_of(among, [&](const Language& language) { return language.name == lower_case(name); });
}

const Language* recognize_language(std::string_view text, const std::string& file, std::span<const Language> among) {
  const std::size_t point = file.rfind('.');
  const std::string ending = point == std::string::npos ? "" : lower_case(file.substr(point + 1));
  const Language* const by_ending = first_of(among, [&](const Language& language) {
    return std::find(language.file_endings.begin(), language.file_endings.end(), ending) != language.file_endings.end();
  });
  if (by_ending != nullptr) return by_ending;
  const std::string words = lower_case(text);
  return first_of(among, [&](const Language& language) {
    return std::any_of(language.signs.begin(), language.signs.end(),
                       [&](std::string_view sign) { return words.find(sign) != std::string::npos; });
  });
}

std::string_view written_ending(const Language& language) {
  return language.file_endings.empty() ? language.name : language.file_endings.front();
}

Program read_program(const Language& language, std::string_view text, const std::string& file, const Chain& arm) {
  Program program = language.read(text, file, arm);
  program.language = language.name;
  return program;
}

std::string correction_mark(const std::string& version, const std::string& job, const std::string& data_sha256) {
  constexpr std::size_t kShown = 12;
  std::string mark = std::string(kMark) + ' ' + version + " with the model of " + job;
  if (!data_sha256.empty()) mark += " (data " + data_sha256.substr(0, kShown) + ')';
  std::replace_if(
      mark.begin(), mark.end(), [](char letter) { return static_cast<unsigned char>(letter) < 0x20; }, ' ');
  return mark;
}

std::string with_mark(const std::string& text, const Language& language, const std::string& mark) {
  const std::size_t break_at = text.find('\n');
  const std::string line_break =
      break_at != std::string::npos && break_at > 0 && text[break_at - 1] == '\r' ? "\r\n" : "\n";
  const std::size_t place = place_of_mark(text, language);
  const bool open_line = place > 0 && place == text.size() && text.back() != '\n';
  const std::string line = std::string(1, language.comment) + ' ' + mark + line_break;
  return text.substr(0, place) + (open_line ? line_break : "") + line + text.substr(place);
}

std::optional<std::size_t> marked_line(std::string_view text, std::span<const Language> among) {
  const std::size_t at = text.find(kMark);
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  const std::string_view before = text.substr(begin, at - begin);
  const std::size_t first = std::min(before.find_first_not_of("\xEF\xBB\xBF \t"), before.size());
  const auto comments = [&](const Language& language) { return before[first] == language.comment; };
  if (first == before.size() || std::none_of(among.begin(), among.end(), comments)) return std::nullopt;
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace demecal::inline languages
