#include "preparation/named_points.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline preparation {
namespace {

/// In small letters, without the mark of a precision point.
std::string normalized(std::string_view name) {
  if (name.starts_with('#')) name.remove_prefix(1);
  return lower_case(name);
}

NamedPoint point_of(const Target& target, std::size_t index, std::size_t ordinal) {
  const std::string name = normalized(target.name);
  NamedPoint point{.target = index, .name = target.name, .array = name, .key = name};
  const std::size_t bracket = name.find('[');
  if (bracket != std::string::npos && name.ends_with(']')) {
    point.array = name.substr(0, bracket);
    point.key = name.substr(bracket + 1, name.size() - bracket - 2);
  } else if (name.empty()) {
    point.name = point.key = std::to_string(ordinal);
  }
  return point;
}

bool same_numbers(const std::vector<Cell>& one, const std::vector<Cell>& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const Cell& a, const Cell& b) { return a.inside() == b.inside(); });
}

bool same_numbers(const Target& one, const Target& other) {
  return same_numbers(one.joints, other.joints) && same_numbers(one.position, other.position);
}

[[noreturn]] void throw_no_points(const Program& program, PointKind kind, const std::string& points) {
  std::vector<std::string> arrays;
  for (const Target& target : program.targets) {
    if (target.is_pose() == (kind == PointKind::poses)) arrays.push_back(point_of(target, 0, 0).array);
  }
  std::string rule = kind == PointKind::joints ? "has no points of joints" : "has no points of poses";
  if (!points.empty()) rule += " of that name";
  if (!points.empty() && !arrays.empty()) rule += "; the nearest is '" + nearest_name(points, arrays) + "'";
  throw InputError({program.file, 0}, points, rule);
}

}  // namespace

std::vector<NamedPoint> named_points(const Program& program, PointKind kind, const std::string& points) {
  std::vector<NamedPoint> found;
  std::map<std::string, std::size_t> seen;
  for (std::size_t i = 0; i < program.targets.size(); ++i) {
    const Target& target = program.targets[i];
    if (target.is_pose() != (kind == PointKind::poses)) continue;
    NamedPoint point = point_of(target, i, found.size() + 1);
    if (!points.empty() && point.array != normalized(points)) continue;
    const auto [before, is_new] = seen.emplace(normalized(point.name), i);
    if (is_new) {
      found.push_back(std::move(point));
    } else if (!same_numbers(target, program.targets[before->second])) {
      throw InputError(
          {program.file, target.place.line}, point.name,
          "stands with other numbers in line " + std::to_string(program.targets[before->second].place.line));
    }
  }
  if (found.empty()) throw_no_points(program, kind, points);
  return found;
}

void require_kept_numbers(const Program& program, std::size_t target) {
  const Target& point = program.targets[target];
  if (point.not_sent_to.empty() || point.only_recorded) return;
  throw InputError({program.file_name(point.place.file), point.place.line}, point.name,
                   point.not_sent_to +
                       ": its numbers need not be those at which it was measured; name points that the program leaves "
                       "alone, or give the numbers that held as a file of their own");
}

Eigen::Vector3d point_in_base(const Program& program, std::size_t target) {
  const Target& point = program.targets[target];
  if (point.frames.unknown_frame.empty()) return stated_point(point);
  throw InputError({program.file_name(point.place.file), point.place.line}, point.name,
                   point.frames.unknown_frame +
                       ": where the point is in the base frame is not known; give it in the "
                       "base frame, or in one that the program states as numbers");
}

std::vector<std::vector<std::size_t>> rows_of_points(const Readings& readings, const std::vector<NamedPoint>& points,
                                                     const std::string& of_file) {
  std::vector<std::vector<std::size_t>> rows(points.size());
  if (!readings.named) {
    if (readings.rows.size() != points.size()) {
      throw InputError({readings.file, 0}, "",
                       "has " + counted(readings.rows.size(), "reading") + ", but " + of_file + " has " +
                           counted(points.size(), "point") +
                           "; without a column `pose` every point needs one reading, in their order");
    }
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = {i};
    return rows;
  }
  std::map<std::string, std::size_t> by_name, by_key;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < points.size(); ++i) {
    by_name.emplace(normalized(points[i].name), i);
    if (!by_key.emplace(points[i].key, i).second) by_key[points[i].key] = points.size();  // of several arrays
    names.push_back(points[i].name);
  }
  for (std::size_t row = 0; row < readings.rows.size(); ++row) {
    const std::string pose = normalized(readings.rows[row].pose);
    const auto named = by_name.find(pose), keyed = by_key.find(pose);
    const std::size_t point = named != by_name.end() ? named->second : keyed != by_key.end() ? keyed->second : ~0ul;
    if (point < points.size()) {
      rows[point].push_back(row);
      continue;
    }
    throw InputError({readings.file, readings.rows[row].line}, readings.rows[row].pose,
                     point == points.size() ? "is the number of several points of " + of_file + "; give the whole name"
                                            : "is no point of " + of_file + "; the nearest is '" +
                                                  nearest_name(readings.rows[row].pose, names) + "'");
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].empty())
      throw InputError({readings.file, 0}, points[i].name, "is a point of " + of_file + " without a reading");
  }
  return rows;
}

}  // namespace demecal::inline preparation
