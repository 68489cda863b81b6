// Which sign the decimals of a table have.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/csv.hpp"

namespace demecal::inline tables {

/// '.' or ',', by most numbers of the rows: those with the other sign are no numbers then. Throws InputError where both
/// are as many, and where every comma may as well separate thousands (1,234).
char decimal_sign(const std::vector<CsvRow>& rows, const std::string& file);

/// Throws InputError where rows of whole numbers between commas may be half as many numbers with decimal commas.
void refuse_split_decimals(const std::vector<CsvRow>& rows, const std::string& file);

/// Throws InputError where a heading stands for exactly two fields of every row: decimal commas between commas.
void refuse_half_headings(std::size_t headings, const CsvRow& row, const std::string& file);

}  // namespace demecal::inline tables
