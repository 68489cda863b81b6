// What the files of jobs hold: uploaded ones may name files that were uploaded beside them and nothing else of the
// machine; reports of finished jobs state their errors, which are shown beside each other.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "yaml/yaml_node.hpp"

namespace demecal::inline serving {

/// Whether a file is read as YAML, by its ending.
bool is_yaml_name(const std::string& name);

/// Throws InputError with file, line and value where a text of the file would lead elsewhere as a path (absolute, or
/// with `..`), or names one of `uploaded` that is not called .yaml in a place where YAML is read: what such a file
/// names would be seen by nobody.
void check_named_files(const YamlNode& file, const std::set<std::string>& uploaded);

/// The files that a run is told.
struct JobFiles {
  std::string job;
  std::vector<std::string> data;  ///< as the job names them
};

/// Of the YAML files by their names, the one that is a job. Throws InputError where there is none, or more than one.
JobFiles find_job(const std::map<std::string, YamlNode>& files);

/// One JSON document with a row for each job, from its name and the text of its report.json: method, seed and errors
/// with the base fitted, before the closed loop and after it, set by set. A report that cannot be read gives a row that
/// says so.
std::string comparison_text(const std::vector<std::pair<std::string, std::string>>& reports);

}  // namespace demecal::inline serving
