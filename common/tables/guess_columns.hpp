// Which columns of a table hold what, by the names that instruments and loggers give them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/columns.hpp"
#include "data/csv.hpp"

namespace demecal::inline tables {

/// Indices of columns; empty, or nothing, where the table has none of the kind.
using GuessedColumns = PoseColumns<std::size_t>;

/// By their headings: joints q1 or j1, joint_1, axis1, A1 ... in a row of `joints`, or `joint_names` themselves, or E1
/// ... for the first `rails` of them before a row of the others; x y z; qw qx qy qz; sx sy sz; torque1 or tau1 ...; a
/// name or point; a time. In a table without headings: three columns of numbers are a position, as many as there are
/// joints are joints, both together are both, and a first column of words is the name.
GuessedColumns guess_columns(const CsvTable& table, std::size_t joints, const std::vector<std::string>& joint_names,
                             std::size_t rails = 0);

/// "rad" or "deg", "m" or "mm": that of a column of angles or lengths whose largest value this is. No arm turns a joint
/// much beyond one turn, or measures beyond 20 m.
std::string_view likely_unit(Quantity quantity, double largest);

/// How many joints the table seems to have, by columns of numbered names; 0 where it has none.
std::size_t count_joint_columns(const CsvTable& table);

}  // namespace demecal::inline tables
