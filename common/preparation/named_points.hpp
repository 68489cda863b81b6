// The points of a program that were measured, and which reading is of which point.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "parsed_programs/program.hpp"
#include "preparation/readings.hpp"

namespace demecal::inline preparation {

/// A file of points, and its bytes.
struct PointFile {
  std::string text;
  Program program;
};

/// A point of a program as readings name it.
struct NamedPoint {
  std::size_t target = 0;  ///< in Program::targets
  std::string name;        ///< as written, "#cp[3]"; "3" for the third of a file that names none
  std::string array;       ///< "cp" in small letters; the whole name where there are no brackets
  std::string key;         ///< "3": what joints, programmed poses and readings of one point share
};

enum class PointKind { joints, poses };

/// The points of that kind, in the order of the file, those of the array `points` alone where that is not empty. A
/// point that stands twice with the same numbers counts once. Throws InputError where there are none, or where one
/// stands twice with different numbers.
std::vector<NamedPoint> named_points(const Program& program, PointKind kind, const std::string& points);

/// Throws InputError where the program changes the target or hands it on, so that its numbers need not be those at
/// which it was measured; one in which it records where the arm stands has those.
void require_kept_numbers(const Program& program, std::size_t target);

/// Where a target of a pose has the tool point, base frame. Throws InputError where its frame is not known.
Eigen::Vector3d point_in_base(const Program& program, std::size_t target);

/// For every point, the rows of `readings` that are of it: those that name it ("#cp[3]", "cp[3]" or "3"), or where the
/// readings name none the row in its place. `of_file` is where the points stand. Throws InputError where a point has no
/// reading, a reading no point, or, without names, where their numbers differ.
std::vector<std::vector<std::size_t>> rows_of_points(const Readings& readings, const std::vector<NamedPoint>& points,
                                                     const std::string& of_file);

}  // namespace demecal::inline preparation
