// The tables that a data set names under `poses`, read and joined.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "data/columns.hpp"
#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "tables/layout.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

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

}  // namespace demecal::inline config
