// PREPARATION.yaml: raw measurements, and recordings of joints while the tool touched something, which may also be
// given by themselves.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "preparation/joint_log.hpp"
#include "preparation/prepared.hpp"
#include "preparation/recorded_contacts.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline drafting {

/// What is said of one log.
struct LogRequest {
  std::filesystem::path path;
  const YamlNode* node = nullptr;  ///< a map with `set`, `columns`, `units` and the layout; null: nothing is said
};

/// A log as its logger wrote it: columns by name or by their headings, times in any form. They count from `origin_s`,
/// which becomes the first of the log where it is nothing yet. `assumed` gets what was taken for granted, for people.
/// Throws InputError with file, line, value and rule at the first fault.
JointLog read_joint_log(const LogRequest& request, const Robot& robot, std::optional<double>& origin_s,
                        std::vector<std::string>& assumed);

/// The root of a PREPARATION.yaml, its keys and version checked.
YamlNode read_preparation(const std::filesystem::path& path);

/// Everything that a PREPARATION.yaml names, read; the files are taken relative to it. Throws InputError with file,
/// line, value and rule at the first fault in any of them.
RawMeasurements load_preparation(const std::filesystem::path& path);

/// Whether the contacts of recordings are asked for, in place of what an instrument measured.
bool names_recordings(const YamlNode& preparation);

/// Everything that stands under `log`, and the files it names, read. Columns that are not named are found by their
/// headings. Throws InputError with file, line, value and rule at the first fault in any of them.
Recordings load_recordings(const YamlNode& preparation);

/// The same of files alone.
Recordings load_recordings(const std::filesystem::path& robot, const std::vector<std::filesystem::path>& logs);

}  // namespace demecal::inline drafting
