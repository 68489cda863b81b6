// Which parts of expressions are worth a name, because they are needed more than once.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "symbolic/spelling.hpp"

namespace demecal {

/// Steps towards the expressions: the names t1, t2 ... (with `stem` t) of parts they share, in the order to compute
/// them.
struct Steps {
  NamedTerms names;
  std::vector<std::pair<std::string, std::string>> assignments;  ///< name and what it is
  std::vector<std::string> results;                              ///< one per expression
};
Steps steps_to(const std::vector<Expression>& expressions, const Spelling& spelling, const std::string& stem = "t");

}  // namespace demecal
