// The files of a program as one text, and that text as its reader sees it: places in it, faults at them, numbers, lists
// in brackets, and what is no code blanked out.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace demecal::inline parsed_programs {

struct ProgramFile {
  std::string name;  ///< as named to the user
  std::string text;
};

/// One file after the other, each beginning a line of its own.
class ProgramSource {
 public:
  ProgramSource(std::string_view text, std::string file);
  /// At least one file.
  explicit ProgramSource(std::vector<ProgramFile> files);

  const std::string& text() const { return text_; }
  const std::vector<ProgramFile>& files() const { return files_; }
  /// The name of the first.
  const std::string& file() const { return files_.front().name; }
  /// Where the text of a file begins, its byte order mark (blanks here, unless it is the first) included.
  std::size_t begin(std::size_t file) const { return begins_[file]; }
  /// The file that a byte of the text is of; the line break between two is of the first.
  std::size_t file_at(std::size_t offset) const;

 private:
  std::vector<ProgramFile> files_;
  std::vector<std::size_t> begins_;
  std::string text_;
};

/// Decimals that keep 0.001 mm and 0.0001 degrees; fewer are never written, unless the file counts in whole steps.
inline constexpr int kDecimalsMm = 3, kDecimalsM = 6, kDecimalsDeg = 4, kDecimalsRad = 6, kDecimalsQuaternion = 7;

struct Cell {
  std::size_t begin = 0, size = 0;  ///< its bytes
  double value = 0.0;               ///< as written, in the file's own unit
  double unit = 1.0;                ///< the file's unit in SI units or rad
  int decimals = 0;                 ///< that another number is written with here

  double inside() const { return value * unit; }
};

/// The unit a cell is in, and the fewest decimals it is written with.
struct CellUnit {
  double size = 1.0;
  int least_decimals = 0;
};

/// The number that stands at [begin, begin + size) of `text`; it keeps its own decimals where these are more. Nothing
/// where no finite number stands there.
std::optional<Cell> cell_at(std::string_view text, std::size_t begin, std::size_t size, const CellUnit& unit);

/// The text that `inside` (SI or rad) has in the cell. Nothing where, with the cell's decimals, it is what stands
/// there: then its bytes stay.
std::optional<std::string> rewritten(const Cell& cell, double inside);

/// Line and column (in bytes), both from 1, in one of the program's files, from 0.
struct TextPlace {
  std::size_t line = 1, column = 1;
  std::size_t file = 0;
};

/// Where strings and comments are in a language.
struct CommentStyle {
  char comment = '\0';  ///< from here to the end of its line
  char line = '\0';     ///< a line that begins with it is no code at all
  bool strings = true;  ///< whether what stands in double quotes is no code
};

class ProgramText {
 public:
  /// `source` must outlive this.
  ProgramText(const ProgramSource& source, CommentStyle style);

  /// The text with every comment and all inside strings turned into spaces; bytes stand where they stood.
  std::string_view code() const { return code_; }
  std::string_view text() const { return source_.text(); }
  const ProgramSource& source() const { return source_; }
  TextPlace place(std::size_t offset) const;

  /// Throws InputError with file, line and column of the bytes.
  [[noreturn]] void fail(std::size_t begin, std::size_t size, const std::string& rule) const;
  /// The number at the bytes; throws InputError where there is none.
  Cell number(std::size_t begin, std::size_t size, const CellUnit& unit) const;

  // of the code
  /// The first offset at or after `offset` that holds no white space, or the end.
  std::size_t skip_spaces(std::size_t offset) const;
  /// The end of the word (letters, digits, _ $) that begins at `offset`.
  std::size_t word_end(std::size_t offset) const;
  /// Whether a word begins at `offset`, and none goes on there.
  bool begins_word(std::size_t offset) const;
  /// [begin, end) without the white space at either end.
  std::string_view trimmed(std::size_t& begin, std::size_t end) const;
  /// The first byte at or after `offset` that is no white space; 0 at the end.
  char next(std::size_t offset) const;
  /// Where the backslash stands that makes an option of the word at `begin` (RAPID), white space between them or not;
  /// npos: it is none.
  std::size_t option_sign(std::size_t begin) const;
  /// The word at or after `offset`, in small letters; empty where something else comes next.
  std::string word_at(std::size_t offset) const;

  /// Calls visit(begin, end) with the place of every word.
  template <typename Visit>
  void for_each_word(const Visit& visit) const {
    for (std::size_t begin = 0; begin < code_.size(); ++begin) {
      if (!begins_word(begin)) continue;
      const std::size_t end = word_end(begin);
      visit(begin, end);
      begin = end - 1;
    }
  }

 private:
  const ProgramSource& source_;
  std::string code_;
  std::vector<std::size_t> line_starts_{0};
};

bool is_word_letter(char letter);
bool is_digit(char letter);
/// Whether the text can be a variable or an expression rather than a number that went wrong.
bool is_expression(std::string_view text);

struct BracketItem {
  std::size_t begin = 0, size = 0;  ///< without the white space around; of a list, its brackets included
  bool is_list = false;
  std::vector<BracketItem> items{};  ///< of a list
};

/// The list that opens at `begin` with `opening`, '[' or '{'. Commas inside parentheses separate nothing. Throws
/// InputError where it is never closed, or is nested more than 20 deep.
BracketItem read_list(const ProgramText& text, std::size_t begin, char opening);

/// The values of a list of `size` numbers; nothing where it is none.
std::optional<std::vector<double>> list_numbers(const ProgramText& text, const BracketItem& list, std::size_t size);

}  // namespace demecal::inline parsed_programs
