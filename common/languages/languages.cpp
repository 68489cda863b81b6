#include "languages/languages.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kuka_abb_ur/kuka_abb_ur.hpp"
#include "languages/payload_statements.hpp"
#include "staubli_kawasaki/staubli_kawasaki.hpp"

namespace demecal::inline languages {

// One row a language, defined in its own file. Words of any program may be signs of CSV, which comes last.
Language fanuc_ls_language();
Language yaskawa_jbi_language();
Language csv_language();

std::span<const Language> all_languages() {
  static const std::vector<Language> all = [] {
    std::vector<Language> rows = staubli_kawasaki_languages();
    rows.push_back(fanuc_ls_language());
    rows.push_back(yaskawa_jbi_language());
    for (const Language& language : kuka_abb_ur_languages()) rows.push_back(language);
    rows.push_back(csv_language());
    return rows;
  }();
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

/// Without blanks and the numbers of lines.
std::string squeezed(std::string_view text) {
  std::string letters(text);
  std::erase_if(letters,
                [](char letter) { return letter == ' ' || letter == '\t' || (letter >= '0' && letter <= '9'); });
  return letters;
}

/// The mark as comments are that must end with something: without what would end them early.
std::string within_comment(std::string mark, const Language& language) {
  if (language.comment_end.empty()) return mark;
  for (std::size_t i = 0; i < mark.size(); ++i) {
    const bool second_dash = mark[i] == '-' && i > 0 && mark[i - 1] == '-';
    if (second_dash || mark[i] == ';' || mark[i] == '<' || mark[i] == '>') mark[i] = ' ';
  }
  return mark;
}

/// Parts of at most `longest` letters, between words where there are any.
std::vector<std::string> parts_of_mark(std::string mark, std::size_t longest) {
  std::vector<std::string> parts;
  while (mark.size() > longest) {
    const std::size_t blank = mark.rfind(' ', longest);
    const std::size_t size = blank == std::string::npos || blank == 0 ? longest : blank;
    parts.push_back(mark.substr(0, mark.find_last_not_of(' ', size - 1) + 1));
    mark.erase(0, mark.find_first_not_of(' ', size));
  }
  parts.push_back(mark);
  return parts;
}

/// Throws InputError where one of the files is malformed by itself, whatever the one before it left open.
void require_each_readable(const Language& language, const ProgramSource& source, const Chain& arm,
                           const ControllerData& controller) {
  if (!language.of_several_files) {
    throw InputError({source.files()[1].name, 0}, "",
                     "is given as a part of another program; a program in " + std::string(language.title) +
                         " is one file: correct them one by one");
  }
  for (const ProgramFile& file : source.files()) {
    const ProgramSource alone(file.text, file.name);
    language.read({alone, arm, controller});
  }
}

/// Takes out the targets whose name stands in several files.
void leave_ambiguous_names(Program& program) {
  std::map<std::string, std::set<std::size_t>> files;
  for (const Target& target : program.targets) files[lower_case(target.name)].insert(target.place.file);
  const auto other_file = [&](const Target& target) -> const std::string* {
    if (target.name.empty()) return nullptr;
    for (const std::size_t file : files[lower_case(target.name)]) {
      if (file != target.place.file) return &program.file_name(file);
    }
    return nullptr;
  };
  std::vector<Target> kept;
  for (Target& target : program.targets) {
    if (const std::string* other = other_file(target)) {
      end_at_motions_to(target, program);
      skip_target(program, target,
                  "a target of this name stands in " + *other +
                      ", too, and which is meant where is "
                      "not followed");
    } else {
      kept.push_back(std::move(target));
    }
  }
  program.targets = std::move(kept);
}

template <typename Match>
const Language* first_of(std::span<const Language> among, const Match& match) {
  const auto found = std::find_if(among.begin(), among.end(), match);
  return found == among.end() ? nullptr : &*found;
}

/// A table of numbers, which begins with no words of a language.
bool is_table(const Language& language) {
  return language.headers.empty() && language.openings.empty();
}

void refuse_beside_positioner(const Language& language, const std::string& file) {
  throw InputError({file, 0}, "",
                   "is a program in " + std::string(language.title) +
                       ", which does not say where the arm goes on a workpiece that a positioner carries, as the model "
                       "does: only a table of all joints can be corrected");
}

/// No table of poses says where the positioner stands.
void refuse_poses(const Program& program) {
  const auto pose = std::ranges::find_if(program.targets, &Target::is_pose);
  if (pose == program.targets.end()) return;
  throw InputError({program.file, pose->place.line}, "",
                   "is a pose on the workpiece, which does not say where the positioner that carries it stands: give "
                   "all joints (q1_deg, q2_deg, ...), the positioner's first");
}

}  // namespace

const Language* find_language(std::string_view name, std::span<const Language> among) {
  return first_of(among, [&](const Language& language) { return language.name == lower_case(name); });
}

const Language* recognize_language(std::string_view text, const std::string& file, std::span<const Language> among) {
  const std::size_t point = file.rfind('.');
  const std::string ending = point == std::string::npos ? "" : lower_case(file.substr(point + 1));
  const std::string words = lower_case(text);
  const auto has_sign = [&](const Language& language) {
    return std::any_of(language.signs.begin(), language.signs.end(),
                       [&](std::string_view sign) { return words.find(sign) != std::string::npos; });
  };
  const auto has = [&](const std::vector<std::string_view>& endings) {
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
  };
  if (const Language* found = first_of(
          among, [&](const Language& language) { return has(language.other_endings) && has_sign(language); })) {
    return found;
  }
  if (const Language* found = first_of(among, [&](const Language& language) { return has(language.file_endings); })) {
    return found;
  }
  return first_of(among, has_sign);
}

std::string_view written_ending(const Language& language) {
  return language.file_endings.empty() ? language.name : language.file_endings.front();
}

Program read_program(const Language& language, const ProgramSource& source, const Chain& arm,
                     const ControllerData& controller) {
  if (arm.positioner > 0 && !is_table(language)) refuse_beside_positioner(language, source.file());
  const bool several = source.files().size() > 1;
  if (several) require_each_readable(language, source, arm, controller);
  Program program = language.read({source, arm, controller});
  program.language = language.name;
  program.file = source.file();
  if (arm.positioner > 0) refuse_poses(program);
  for (std::size_t file = 1; file < source.files().size(); ++file)
    program.further.push_back({source.files()[file].name, source.begin(file)});
  for (const PayloadStatement& one : payload_statements_of(language, source)) program.payload_statements.push_back(one);
  std::ranges::stable_sort(program.payload_statements, {}, &PayloadStatement::begin);
  if (several) leave_ambiguous_names(program);
  return program;
}

void require_program(const Language& language, const ProgramSource& source, const Program& program) {
  if (!program.targets.empty() || !program.uncorrected.empty() || !program.joints_lost_at.empty()) return;
  if (is_table(language)) return;  // its reader refuses what is none
  const std::string text = lower_case(source.text());
  std::vector<std::string> words(language.headers.begin(), language.headers.end());
  words.insert(words.end(), language.openings.begin(), language.openings.end());
  for (std::size_t begin = 0; begin < text.size(); begin = next_line(text, begin)) {
    const std::size_t first = std::min(text.find_first_not_of(" \t", begin), text.size());
    const std::string_view line = std::string_view(text).substr(first);
    if (std::ranges::any_of(words, [&](const std::string& word) { return line.starts_with(word); })) return;
  }
  words.insert(words.end(), language.signs.begin(), language.signs.end());
  if (std::ranges::any_of(language.signs, [&](std::string_view sign) { return text.find(sign) != text.npos; })) return;
  throw InputError({source.file(), 0}, "",
                   "is no program in " + std::string(language.title) +
                       ": it holds no motion, no point and no line by which such programs are known (" +
                       joined_words(words, ", ") + "); give the program, or name its language with --language");
}

Program read_program(const Language& language, std::string_view text, const std::string& file, const Chain& arm) {
  return read_program(language, ProgramSource(text, file), arm);
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
  std::string lines;
  for (const std::string& part : parts_of_mark(within_comment(mark, language), language.longest_comment))
    lines += std::string(language.comment) + ' ' + part + std::string(language.comment_end) + line_break;
  return text.substr(0, place) + (open_line ? line_break : "") + lines + text.substr(place);
}

std::optional<std::size_t> marked_line(std::string_view text, std::span<const Language> among) {
  const std::size_t at = text.find(kMark);
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  std::string_view before = text.substr(begin, at - begin);
  if (before.starts_with("\xEF\xBB\xBF")) before.remove_prefix(3);
  const auto comments = [&](const Language& language) {
    return squeezed(before).starts_with(squeezed(language.comment));
  };
  if (std::none_of(among.begin(), among.end(), comments)) return std::nullopt;
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace demecal::inline languages
