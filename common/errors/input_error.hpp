// What a user's input did wrong, said in one sentence: file, line, value and rule.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace demecal::inline errors {

/// The one exception for bad input. Thrown anywhere, caught once in each program's main (exit code 11).
/// The sentence reads "FILE:LINE: 'VALUE': RULE", leaving out what is empty or, for the line, 0.
class InputError : public std::runtime_error {
 public:
  struct Where {
    std::string file{};    ///< as the user wrote it; empty where unknown
    std::size_t line = 0;  ///< from 1; 0 where the fault belongs to no line
  };

  InputError(Where where, const std::string& value, const std::string& rule)
      : std::runtime_error(sentence(where, value, rule)), where_(std::move(where)), value_(value), rule_(rule) {}

  const Where& where() const { return where_; }
  const std::string& value() const { return value_; }
  const std::string& rule() const { return rule_; }

 private:
  static std::string sentence(const Where& where, const std::string& value, const std::string& rule) {
    std::string text = where.file;
    if (where.line > 0) text += (text.empty() ? "line " : ":") + std::to_string(where.line);
    if (!text.empty()) text += ": ";
    if (!value.empty()) text += "'" + value + "': ";
    return text + rule;
  }

  Where where_;
  std::string value_;
  std::string rule_;
};

/// What the system says of one of its error numbers (errno).
inline std::string system_reason(int number) {
  return std::generic_category().message(number);
}

}  // namespace demecal::inline errors
