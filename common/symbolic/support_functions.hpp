// Functions of expressions that languages do not have, as exported code defines them.
#pragma once

#include <vector>

#include "symbolic/algebra.hpp"

namespace demecal::inline symbolic {

struct SupportFunction {
  Function function;
  const char *c, *python, *matlab;
};

const std::vector<SupportFunction>& support_functions();

}  // namespace demecal::inline symbolic
