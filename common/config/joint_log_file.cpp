#include "config/joint_log_file.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "config/contacts_file.hpp"
#include "config/input_files.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline config {
namespace {

/// Logs that follow one another have times that do.
void read_logs(const std::vector<LogRequest>& requests, Recordings& recordings) {
  std::optional<double> origin_s;
  for (const LogRequest& request : requests) {
    JointLog log = read_joint_log(request, recordings.robot, origin_s, recordings.assumed);
    const double end_s = recordings.logs.empty() ? 0.0 : recordings.logs.back().times_s.back();
    if (!recordings.logs.empty() && log.times_s.front() < end_s) {
      const double shift_s = end_s - log.times_s.front();
      for (double& time_s : log.times_s) time_s += shift_s;
      recordings.assumed.push_back(log.file + ": times begin before the log before ends: taken to follow it at once");
    }
    recordings.logs.push_back(std::move(log));
  }
}

LogRequest request_of(const YamlNode& item) {
  const bool is_map = item.kind == YamlNode::Kind::map;
  if (is_map) item.with_keys({"file", "set", "columns", "units", "delimiter", "decimal", "header_line"});
  const YamlNode& file = is_map ? item.at("file") : item;
  return read_named(file, [&](const std::filesystem::path& path) {
    return LogRequest{path, is_map ? &item : nullptr};
  });
}

std::vector<LogRequest> requests_of(const YamlNode& files) {
  if (files.kind != YamlNode::Kind::list) return {request_of(files)};
  if (files.list().empty()) files.fail("", "must name one file at least");
  std::vector<LogRequest> requests;
  for (const YamlNode& item : files.list()) requests.push_back(request_of(item));
  return requests;
}

void read_rules(const YamlNode& log, Recordings& recordings) {
  if (const YamlNode* least = log.find("still_s")) recordings.standing.least_s = least->positive();
  if (const YamlNode* fastest = log.find("still_deg_per_s"))
    recordings.standing.fastest_rad_per_s = radians(fastest->positive());
  if (const YamlNode* fastest = log.find("still_mm_per_s"))
    recordings.standing.fastest_m_per_s = metres(fastest->positive());
  if (const YamlNode* gap = log.find("gap_mm")) recordings.gap_m = metres(gap->positive());
  if (const YamlNode* names = log.find("names")) {
    for (const YamlNode& name : names->list()) {
      if (std::ranges::find(recordings.names, name.text()) != recordings.names.end())
        name.fail("is named twice: every contact needs a name of its own");
      recordings.names.push_back(name.text());
    }
    recordings.names_line = names->line;
  }
  const YamlNode* distances = log.find("distances");
  if (distances == nullptr) return;
  for (const YamlNode& one : distances->list()) {
    recordings.distances.push_back(read_known_distance(one));
    recordings.distance_lines.push_back(one.line);
  }
}

}  // namespace

YamlNode read_preparation(const std::filesystem::path& path) {
  YamlNode root = read_yaml(path);
  root.with_version("preparation", 1)
      .with_keys({"demecal_preparation", "name", "robot", "instrument", "local_frame", "repeats", "sets", "log"});
  return root;
}

bool names_recordings(const YamlNode& preparation) {
  return preparation.find("log") != nullptr;
}

Recordings load_recordings(const YamlNode& root) {
  for (const char* key : {"instrument", "local_frame", "repeats", "sets"})
    if (const YamlNode* measured = root.find(key))
      measured->fail("", "says nothing beside `log`: recordings of what the tool touched have no instrument");
  Recordings recordings;
  recordings.file = root.file;
  recordings.name = root.find("name") ? root.at("name").text() : std::filesystem::path(root.file).stem().string();
  recordings.robot = read_named(root.at("robot"), load_robot);
  const YamlNode& log = root.at("log");
  if (log.kind == YamlNode::Kind::map) {
    log.with_keys({"files", "still_s", "still_deg_per_s", "still_mm_per_s", "gap_mm", "names", "distances"});
    read_rules(log, recordings);
  }
  read_logs(requests_of(log.kind == YamlNode::Kind::map ? log.at("files") : log), recordings);
  return recordings;
}

Recordings load_recordings(const std::filesystem::path& robot, const std::vector<std::filesystem::path>& logs) {
  Recordings recordings;
  recordings.robot = load_robot(robot);
  recordings.name = logs.front().stem().string();
  std::vector<LogRequest> requests;
  for (const std::filesystem::path& log : logs) requests.push_back({log, nullptr});
  read_logs(requests, recordings);
  return recordings;
}

}  // namespace demecal::inline config
