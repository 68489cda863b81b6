// How expressions are spelt in the languages that they are handed on in.
#pragma once

#include <map>
#include <set>
#include <string>

#include "symbolic/algebra.hpp"

namespace demecal {

enum class CodeLanguage { text, c, python, matlab };

/// Expressions that have got a name of their own, by id.
using NamedTerms = std::map<std::uint32_t, std::string>;

class Spelling {
 public:
  explicit Spelling(CodeLanguage language) : language_(language) {}

  /// The expression in infix; what has a name is written by its name.
  std::string operator()(Expression expression, const NamedTerms& named = {}) const;
  /// The steps of an evolved formula in their order, of variables of the given names.
  std::string formula(const Tree& tree, const std::vector<std::string>& variables) const;
  /// The shortest digits that read back as the number.
  std::string number(double value) const;
  /// The function's name in the language; `formula` has none.
  std::string name(Function function) const;
  CodeLanguage language() const { return language_; }

 private:
  CodeLanguage language_;
};

/// Functions that the expressions call, those within evolved formulas included.
std::set<Function> functions_in(const std::vector<Expression>& expressions);

}  // namespace demecal
