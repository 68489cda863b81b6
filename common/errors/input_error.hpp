// What a user's input did wrong, said in one sentence: file, line, value and rule.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace demecal::inline errors {

/// The one exception for bad input. Thrown anywhere, caught once in each program's main (exit code 11).
/// The sentence reads "FILE:LINE: 'VALUE': RULE", leaving out what is empty or, for the line, 0.
class InputError : public std::runtime_error {
 public:
  struct Where {
    std::string file{};    ///< as the user wrote it; empty where unknown
    std::size_t line = 0;  ///< from 1; 0 where the fault belongs to no line
  };

  InputError(Where where, const std::string& value, const std::string& rule);

  const Where& where() const { return where_; }
  const std::string& value() const { return value_; }
  const std::string& rule() const { return rule_; }

 private:
  Where where_;
  std::string value_;
  std::string rule_;
};

}  // namespace demecal::inline errors
