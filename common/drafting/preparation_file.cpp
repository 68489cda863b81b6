#include "drafting/preparation_file.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/instrument_file.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "languages/languages.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"
#include "preparation/named_points.hpp"
#include "preparation/readings.hpp"
#include "preparation/taught_points.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline drafting {
namespace {

constexpr double kTolerance_mm =
    5.0;  // above what robots are off by over a local frame, below what mixed-up points are

std::string text_at(const YamlNode& node, std::string_view key) {
  const YamlNode* found = node.find(key);
  return found ? found->text() : "";
}

PointFile read_points(const YamlNode& node, const Robot& robot) {
  return read_named(node, [&](const std::filesystem::path& path) {
    PointFile file{read_file(path), {}};
    const Language* const language = recognize_language(file.text, path.string());
    if (language == nullptr)
      node.fail(path.string(), "is a program in no language that can be told (VAL II, CSV, ...)");
    file.program = read_program(*language, ProgramSource(file.text, path.string()), robot.chain,
                                {.pulses_per_deg = robot.pulses_per_deg});
    return file;
  });
}

/// What is read of the files that a preparation names.
struct ReadingFiles {
  const Robot& robot;
  std::optional<CordInstrument> cords;
  std::vector<std::string> assumed{};  ///< a sentence each
};

Readings read_readings_at(const YamlNode& node, ReadingFiles& files) {
  return read_named(
      node, [&](const std::filesystem::path& path) { return read_instrument_file(path, files.cords, files.assumed); });
}

RobotPoints read_robot_points(const YamlNode& node, const std::string& points, const Robot& robot) {
  if (node.kind == YamlNode::Kind::scalar) return robot_points(read_points(node, robot).program, points, robot);
  if (node.kind != YamlNode::Kind::list) node.fail("", "must be a file or a list of three points [x, y, z] in mm");
  ThreePoints points_m;
  for (std::size_t i = 0; i < 3; ++i) points_m[i] = metres(1.0) * node.list(3)[i].vector3();
  return robot_points(points_m, node.file);
}

TaughtPoints read_local_frame(const YamlNode& node, ReadingFiles& files) {
  node.with_keys({"robot", "points", "instrument", "tolerance_mm"});
  const YamlNode* tolerance = node.find("tolerance_mm");
  return taught_points(read_robot_points(node.at("robot"), text_at(node, "points"), files.robot),
                       read_readings_at(node.at("instrument"), files),
                       metres(tolerance ? tolerance->positive() : kTolerance_mm));
}

RawSet read_set(const YamlNode& node, ReadingFiles& files) {
  node.with_keys({"set", "joints", "points", "poses", "pose_points", "readings"});
  RawSet set;
  set.set = node.at("set").one_of<PoseSet>(
      {{"calibration", PoseSet::calibration}, {"validation", PoseSet::validation}, {"accept", PoseSet::accept}});
  set.joints = read_points(node.at("joints"), files.robot);
  set.points = text_at(node, "points");
  if (const YamlNode* poses = node.find("poses")) set.poses = read_points(*poses, files.robot);
  set.pose_points = text_at(node, "pose_points");
  set.readings = read_readings_at(node.at("readings"), files);
  return set;
}

Eigen::Vector3d non_negative3(const YamlNode& node) {
  const Eigen::Vector3d values = node.vector3();
  for (const YamlNode& value : node.children) value.non_negative();
  return values;
}

Eigen::Vector3d positive3(const YamlNode& node) {
  const Eigen::Vector3d values = node.vector3();
  for (const YamlNode& value : node.children) value.positive();
  return values;
}

CordCorners read_triangle(const YamlNode& node) {
  node.with_keys({"ab", "bc", "ca"});
  const CordTriangle triangle{metres(node.at("ab").positive()), metres(node.at("bc").positive()),
                              metres(node.at("ca").positive())};
  const auto corners = cord_corners(triangle);
  if (!corners) {
    node.fail(
        node.at("ab").scalar + ", " + node.at("bc").scalar + ", " + node.at("ca").scalar,
        "must be the sides of a triangle that is not as flat as a line: each shorter than the other two together");
  }
  return *corners;
}

void read_encoders(const YamlNode& node, CordInstrument& cords) {
  node.with_keys({"bar_mm", "bar_counts", "counts_per_mm", "zero_counts"});
  const YamlNode* direct = node.find("counts_per_mm");
  const YamlNode* bar = node.find("bar_mm");
  if ((direct != nullptr) == (bar != nullptr)) {
    node.fail("", "must give either bar_mm and bar_counts or counts_per_mm");
  }
  if (direct != nullptr) {
    if (const YamlNode* counts = node.find("bar_counts")) counts->fail("", "belongs to bar_mm, which is not given");
    cords.counts_per_m = 1e3 * positive3(*direct);
  } else {
    cords.counts_per_m = positive3(node.at("bar_counts")) / metres(bar->positive());
  }
  if (const YamlNode* zero = node.find("zero_counts")) cords.zero_counts = zero->vector3();
}

CordInstrument read_cords(const YamlNode& node) {
  node.with_keys({"triangle_mm", "top_cords_mm", "encoders", "side", "standard_error_mm"});
  CordInstrument cords;
  cords.corners = read_triangle(node.at("triangle_mm"));
  if (const YamlNode* top = node.find("top_cords_mm")) cords.top_cords_m = metres(1.0) * non_negative3(*top);
  if (const YamlNode* encoders = node.find("encoders")) read_encoders(*encoders, cords);
  if (const YamlNode* error = node.find("standard_error_mm")) cords.standard_error_m = metres(error->positive());
  cords.side = node.at("side").one_of<PlaneSide>({{"above", PlaneSide::above}, {"below", PlaneSide::below}});
  return cords;
}

/// Three cords, or nothing where it is the word `points`, an instrument that reads coordinates.
std::optional<CordInstrument> read_instrument(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::scalar) {
    if (node.scalar != "points") node.fail("must be `points` or a map with the key `cords`");
    return std::nullopt;
  }
  return read_cords(node.with_keys({"cords"}).at("cords"));
}

}  // namespace

RawMeasurements load_preparation(const std::filesystem::path& path) {
  const YamlNode root = read_preparation(path);
  if (names_recordings(root)) root.at("log").fail("", "is of recordings, which have no measurements");
  RawMeasurements raw;
  raw.name = root.find("name") ? root.at("name").text() : path.stem().string();
  raw.file = path.string();
  raw.robot = read_named(root.at("robot"), load_robot);
  ReadingFiles files{raw.robot, read_instrument(root.at("instrument"))};
  if (const YamlNode* frame = root.find("local_frame")) raw.local_frame = read_local_frame(*frame, files);
  if (const YamlNode* repeats = root.find("repeats")) {
    raw.repeats = repeats->one_of<Repeats>({{"average", Repeats::average}, {"keep", Repeats::keep}});
  }
  const YamlNode& sets = root.at("sets");
  if (sets.list().empty()) sets.fail("", "must name one set of measurements at least");
  for (const YamlNode& set : sets.children) raw.sets.push_back(read_set(set, files));
  raw.assumed = std::move(files.assumed);
  return raw;
}

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

LogRequest log_request(const YamlNode& item) {
  const bool is_map = item.kind == YamlNode::Kind::map;
  if (is_map) item.with_keys({"file", "set", "columns", "units", "delimiter", "decimal", "header_line"});
  const YamlNode& file = is_map ? item.at("file") : item;
  return read_named(file, [&](const std::filesystem::path& path) {
    return LogRequest{path, is_map ? &item : nullptr};
  });
}

std::vector<LogRequest> requests_of(const YamlNode& files) {
  if (files.kind != YamlNode::Kind::list) return {log_request(files)};
  if (files.list().empty()) files.fail("", "must name one file at least");
  std::vector<LogRequest> requests;
  for (const YamlNode& item : files.list()) requests.push_back(log_request(item));
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

}  // namespace demecal::inline drafting
