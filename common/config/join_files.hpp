// Several pose files of one data set: which file has which column, and which rows belong together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/read_poses.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

struct PoseFile {
  const YamlNode* node = nullptr;  ///< its item under `poses`
  CsvTable table;
  std::string found;   ///< how it is written, for people
  std::string sha256;  ///< of its bytes
  std::optional<ColumnMap> own_columns{};
  /// By what rows are joined, where the file has it.
  std::optional<ColumnName> pose{}, time{};
};

/// The columns of all files, each with the number of its table. `shared` are those of the files without columns of
/// their own. Sets each file's `pose` and `time`. Throws InputError where a column is of no file or of several.
ColumnMap combined_columns(std::vector<PoseFile>& files, const std::optional<ColumnMap>& shared,
                           const InputError::Where& where);

/// The files' tables with their rows joined as `join` of the root says; time stamps become seconds. `sentences` gets
/// how, for people.
JoinedTables join_files(const YamlNode& root, std::vector<PoseFile>& files, const ColumnMap& columns,
                        const AssumedUnits& units, const Chain& chain, std::vector<std::string>& sentences);

}  // namespace demecal::inline config
