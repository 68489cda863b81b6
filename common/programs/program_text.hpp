// The text of a program as its reader sees it: places in it, faults at them, and what is no code blanked out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "programs/cell.hpp"

namespace demecal {

/// Line and column (in bytes), both from 1.
struct TextPlace {
  std::size_t line = 1, column = 1;
};

/// Where strings and comments are in a language.
struct CommentStyle {
  char comment = '\0';  ///< from here to the end of its line
  char line = '\0';     ///< a line that begins with it is no code at all
};

class ProgramText {
 public:
  /// `text` must outlive this; `file` names it in errors.
  ProgramText(std::string_view text, std::string file, CommentStyle style);

  /// The text with every comment and all inside double quotes turned into spaces; bytes stand where they stood.
  std::string_view code() const { return code_; }
  std::string_view text() const { return text_; }
  const std::string& file() const { return file_; }
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

 private:
  std::string_view text_;
  std::string file_;
  std::string code_;
  std::vector<std::size_t> line_starts_{0};
};

bool is_word_letter(char letter);
bool is_digit(char letter);
/// Whether the text can be a variable or an expression rather than a number that went wrong.
bool is_expression(std::string_view text);

}  // namespace demecal
