// Expressions read from text as people write matrices: + - * / ^, sin cos tan sqrt abs, PI, names.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "symbolic/algebra.hpp"

namespace demecal {

/// What names in text stand for; where there are none, every name is a symbol of its own.
using SymbolNames = std::map<std::string, Expression>;

/// The expression that `text` writes. Angles are in rad; ^ takes a whole number; sin, cos, tan, sqrt, abs and PI may
/// also be written in capitals or (Pi, Sin) begin with one; any other name is one of `names`. Throws InputError naming
/// the column (from 1) and what was expected there; also where parentheses or signs nest deeper than 256, where a
/// function stands without its parenthesis, and where a constant is divided by zero.
Expression parse_expression(Algebra& algebra, std::string_view text, const SymbolNames& names = {});

}  // namespace demecal
