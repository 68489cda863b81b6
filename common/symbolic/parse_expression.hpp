// Expressions read from text as people write matrices (+ - * / ^, sin cos tan sqrt abs, PI, names), and homogeneous
// matrices of them (thesis 5.2.2).
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "symbolic/algebra.hpp"

namespace demecal::inline symbolic {

/// What names in text stand for; where there are none, every name is a symbol of its own.
using SymbolNames = std::map<std::string, Expression>;

/// The expression that `text` writes. Angles are in rad; ^ takes a whole number; sin, cos, tan, sqrt, abs and PI may
/// also be written in capitals or (Pi, Sin) begin with one; any other name is one of `names`. Throws InputError naming
/// the column (from 1) and what was expected there; also where parentheses or signs nest deeper than 256, where a
/// function stands without its parenthesis, and where a constant is divided by zero.
Expression parse_expression(Algebra& algebra, std::string_view text, const SymbolNames& names = {});

/// Four rows of four; the last is 0 0 0 1.
using SymbolicMatrix = std::vector<std::vector<Expression>>;
/// The first three rows of a homogeneous matrix, each element written as parse_expression() reads it.
using MatrixText = std::array<std::array<std::string, 4>, 3>;

/// The matrix that the text writes. Throws InputError naming row, column and what is wrong there.
SymbolicMatrix parse_matrix(Algebra& algebra, const MatrixText& text, const SymbolNames& names = {});

SymbolicMatrix product(const SymbolicMatrix& a, const SymbolicMatrix& b);

/// The product of matrices in their order; the identity of none.
SymbolicMatrix parse_product(Algebra& algebra, const std::vector<MatrixText>& texts);

/// Element by element.
SymbolicMatrix derivative(const SymbolicMatrix& matrix, const std::string& symbol);

/// Its elements row by row.
std::vector<Expression> elements(const SymbolicMatrix& matrix);

}  // namespace demecal::inline symbolic
