// The benchmark's figures as a table for people and as JSON lines for programs.
#pragma once

#include <iosfwd>

#include "summary.hpp"

namespace demecal::bench {

/// The table, and below it the totals beside the bounds they are held to.
void write_table(std::ostream& out, const std::vector<Summary>& rows);

/// One object a row; named and in_class are shares, named of the cases that can be told apart.
void write_json(std::ostream& out, const std::vector<Summary>& rows);

/// One object: the case's truth, what was found first and how surely, and its figures.
void write_case(std::ostream& out, const CaseFigures& figures, const Robot& robot);

}  // namespace demecal::bench
