// The tables that a data set names under `poses`: which file has which column, which rows belong together.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/data_set.hpp"
#include "data/read_poses.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "tables/layout.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline data_files {

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

struct PosesOfFiles {
  std::vector<MeasuredPose> poses;
  ColumnMap columns;  ///< of all files together
  std::string file;   ///< whose lines poses are named by
  std::string sha256;
  bool sigma_by_angles = false;         ///< uncertainties are of an instrument's range and angles
  std::vector<std::string> recognised;  ///< for people
};

/// The poses of the files under `poses`, joined as `join` says. `columns` of the root serve all files that have none of
/// their own. Throws InputError at the first fault of any of them.
PosesOfFiles read_pose_files(const YamlNode& root, const AssumedUnits& units, const Chain& chain,
                             const std::map<std::string, Eigen::Vector3d>& tools_m);

/// What stands beside a file's name: how its table is laid out.
ToldLayout read_layout(const YamlNode& node);

}  // namespace demecal::inline data_files
