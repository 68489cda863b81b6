// Sentences on what a draft takes for granted of the columns of a table.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/csv.hpp"
#include "drafting/draft_data_set.hpp"

namespace demecal::inline drafting {

/// The columns in a sentence: "x, y, z", or "1, 2, 3" where they have no names.
std::string in_words(const CsvTable& table, const std::vector<std::size_t>& columns);

/// What is taken for the units of a temperature and a payload whose headings state none.
void add_assumed_circumstances(const GivenTable& given, std::vector<std::string>& assumed);

/// Names the columns that nothing is read from, some of many.
void add_unused(const GivenTable& given, std::vector<std::string>& assumed);

}  // namespace demecal::inline drafting
