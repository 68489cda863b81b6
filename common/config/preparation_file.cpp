#include "config/input_files.hpp"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "config/joint_log_file.hpp"
#include "data/csv.hpp"
#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "languages/controller_data.hpp"
#include "languages/languages.hpp"
#include "languages/program.hpp"
#include "languages/program_source.hpp"
#include "preparation/named_points.hpp"
#include "preparation/readings.hpp"
#include "preparation/taught_points.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {
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

Readings read_readings_at(const YamlNode& node, const std::optional<CordInstrument>& cords) {
  return read_named(node, [&](const std::filesystem::path& path) {
    std::istringstream text(with_marked_names(read_file(path), path.string()));
    return read_readings(read_csv(text, path.string()), cords);
  });
}

RobotPoints read_robot_points(const YamlNode& node, const std::string& points, const Robot& robot) {
  if (node.kind == YamlNode::Kind::scalar) return robot_points(read_points(node, robot).program, points, robot);
  if (node.kind != YamlNode::Kind::list) node.fail("", "must be a file or a list of three points [x, y, z] in mm");
  ThreePoints points_m;
  for (std::size_t i = 0; i < 3; ++i) points_m[i] = metres(1.0) * node.list(3)[i].vector3();
  return robot_points(points_m, node.file);
}

TaughtPoints read_local_frame(const YamlNode& node, const Robot& robot, const std::optional<CordInstrument>& cords) {
  node.with_keys({"robot", "points", "instrument", "tolerance_mm"});
  const YamlNode* tolerance = node.find("tolerance_mm");
  return taught_points(read_robot_points(node.at("robot"), text_at(node, "points"), robot),
                       read_readings_at(node.at("instrument"), cords),
                       metres(tolerance ? tolerance->positive() : kTolerance_mm));
}

RawSet read_set(const YamlNode& node, const Robot& robot, const std::optional<CordInstrument>& cords) {
  node.with_keys({"set", "joints", "points", "poses", "pose_points", "readings"});
  RawSet set;
  set.set = node.at("set").one_of<PoseSet>(
      {{"calibration", PoseSet::calibration}, {"validation", PoseSet::validation}, {"accept", PoseSet::accept}});
  set.joints = read_points(node.at("joints"), robot);
  set.points = text_at(node, "points");
  if (const YamlNode* poses = node.find("poses")) set.poses = read_points(*poses, robot);
  set.pose_points = text_at(node, "pose_points");
  set.readings = read_readings_at(node.at("readings"), cords);
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

}  // namespace

RawMeasurements load_preparation(const std::filesystem::path& path) {
  const YamlNode root = read_preparation(path);
  if (names_recordings(root)) root.at("log").fail("", "is of recordings, which have no measurements");
  RawMeasurements raw;
  raw.name = root.find("name") ? root.at("name").text() : path.stem().string();
  raw.file = path.string();
  raw.robot = read_named(root.at("robot"), load_robot);
  const std::optional<CordInstrument> cords = read_instrument(root.at("instrument"));
  if (const YamlNode* frame = root.find("local_frame")) raw.local_frame = read_local_frame(*frame, raw.robot, cords);
  if (const YamlNode* repeats = root.find("repeats")) {
    raw.repeats = repeats->one_of<Repeats>({{"average", Repeats::average}, {"keep", Repeats::keep}});
  }
  const YamlNode& sets = root.at("sets");
  if (sets.list().empty()) sets.fail("", "must name one set of measurements at least");
  for (const YamlNode& set : sets.children) raw.sets.push_back(read_set(set, raw.robot, cords));
  return raw;
}

std::optional<CordInstrument> read_instrument(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::scalar) {
    if (node.scalar != "points") node.fail("must be `points` or a map with the key `cords`");
    return std::nullopt;
  }
  return read_cords(node.with_keys({"cords"}).at("cords"));
}

}  // namespace demecal::inline config
