// Homogeneous matrices of expressions, from text and multiplied (thesis 5.2.2).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "symbolic/parse_expression.hpp"

namespace demecal {

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

}  // namespace demecal
