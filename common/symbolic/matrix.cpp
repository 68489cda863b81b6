#include "symbolic/matrix.hpp"

#include "errors/input_error.hpp"
#include "symbolic/differentiate.hpp"

namespace demecal {
namespace {

SymbolicMatrix identity(Algebra& algebra) {
  SymbolicMatrix matrix(4, std::vector<Expression>(4, algebra.constant(0.0)));
  for (std::size_t i = 0; i < 4; ++i) matrix[i][i] = algebra.constant(1.0);
  return matrix;
}

}  // namespace

SymbolicMatrix parse_matrix(Algebra& algebra, const MatrixText& text, const SymbolNames& names) {
  SymbolicMatrix matrix = identity(algebra);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      try {
        matrix[row][column] = parse_expression(algebra, text[row][column], names);
      } catch (const InputError& error) {
        throw InputError(
            error.where(), error.value(),
            "row " + std::to_string(row + 1) + ", element " + std::to_string(column + 1) + ", " + error.rule());
      }
    }
  }
  return matrix;
}

SymbolicMatrix product(const SymbolicMatrix& a, const SymbolicMatrix& b) {
  Algebra& algebra = a[0][0].algebra();
  SymbolicMatrix result = identity(algebra);
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      std::vector<Part> sum;
      for (std::size_t k = 0; k < 4; ++k) sum.emplace_back(a[row][k] * b[k][column], 1.0);
      result[row][column] = algebra.sum(sum);
    }
  }
  return result;
}

SymbolicMatrix parse_product(Algebra& algebra, const std::vector<MatrixText>& texts) {
  SymbolicMatrix result = identity(algebra);
  for (const MatrixText& text : texts) result = product(result, parse_matrix(algebra, text));
  return result;
}

SymbolicMatrix derivative(const SymbolicMatrix& matrix, const std::string& symbol) {
  SymbolicMatrix result = matrix;
  for (auto& row : result) {
    for (Expression& element : row) element = derivative(element, symbol);
  }
  return result;
}

std::vector<Expression> elements(const SymbolicMatrix& matrix) {
  std::vector<Expression> all;
  for (const auto& row : matrix) all.insert(all.end(), row.begin(), row.end());
  return all;
}

}  // namespace demecal
