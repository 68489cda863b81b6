// The clocks by which rows of several files are joined: times as seconds of one kind.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data_files/pose_files.hpp"
#include "tables/join.hpp"
#include "tables/time_stamp.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline data_files {

/// The column of a file that rows are joined by; throws InputError where it has none.
const ColumnName& key_column(const PoseFile& file, const std::optional<ColumnName>& column, const char* key,
                             const YamlNode& by);

/// A column of times in seconds; what is to be said of it is appended.
TimeColumn times_as_seconds(CsvTable& table, const ColumnName& name, std::optional<double>& origin_s,
                            std::vector<std::string>& sentences);

/// The times of all files; of clocks without dates on the days on which they meet those of file `lead`. Throws
/// InputError where the rule has an offset of clocks and these are not of one kind.
std::vector<JoinKeys> times_of(std::vector<PoseFile>& files, std::size_t lead, const YamlNode& by,
                               const AssumedUnits& units, const JoinRule& rule, std::vector<std::string>& sentences);

}  // namespace demecal::inline data_files
