// Expressions as code and text: how each language writes them, and the steps that compute once what they share.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "expression/tree.hpp"
#include "symbolic/algebra.hpp"

namespace demecal::inline symbolic {

enum class CodeLanguage { text, c, python, matlab };

/// Expressions that have got a name of their own, by id.
using NamedTerms = std::map<std::uint32_t, std::string>;

class ExpressionPrinter {
 public:
  explicit ExpressionPrinter(CodeLanguage language) : language_(language) {}

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

/// Steps towards the expressions: the names t1, t2 ... (with `stem` t) of parts they share, in the order to compute
/// them.
struct Steps {
  NamedTerms names;
  std::vector<std::pair<std::string, std::string>> assignments;  ///< name and what it is
  std::vector<std::string> results;                              ///< one per expression
};
Steps plan_steps(const std::vector<Expression>& expressions, const ExpressionPrinter& printer,
                 const std::string& stem = "t");

}  // namespace demecal::inline symbolic
