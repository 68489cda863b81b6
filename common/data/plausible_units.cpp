#include "data/plausible_units.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "errors/input_error.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

using Tools = std::map<std::string, Eigen::Vector3d>;

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
constexpr std::size_t kMostMoves = 500;
constexpr std::size_t kFewestMoves = 5;

/// How far the tool point came from one pose to the next: no frame, known or not, changes that.
struct Move {
  double measured_m;
  double nominal_m;
};

JointVector reread(const JointVector& joints, const Chain& chain, UnitConversion angle) {
  JointVector changed = joints;
  for (int i = 0; i < chain.size(); ++i) {
    const bool revolute = chain.joints[static_cast<std::size_t>(i)].type == JointType::revolute;
    if (revolute && angle != nullptr) changed[i] = angle(changed[i]);
  }
  return changed;
}

Eigen::Vector3d nominal_point(const MeasuredPose& pose, const Chain& chain, const Tools& tools_m,
                              UnitConversion angle) {
  const Eigen::Vector3d& tool_m = pose.target.empty() ? chain.tool_m : tools_m.at(pose.target);
  return forward(chain, reread(pose.joints, chain, angle)) * tool_m;
}

/// The first moves between neighbouring rows; `angle` reads the joints in another unit first.
std::vector<Move> moves(std::span<const MeasuredPose> poses, const Chain& chain, const Tools& tools_m,
                        UnitConversion angle = nullptr) {
  std::vector<Move> found;
  for (std::size_t i = 1; i < poses.size() && found.size() < kMostMoves; ++i) {
    if (!poses[i].position_m || !poses[i - 1].position_m || poses[i].target != poses[i - 1].target) continue;
    found.push_back(
        {(*poses[i].position_m - *poses[i - 1].position_m).norm(),
         (nominal_point(poses[i], chain, tools_m, angle) - nominal_point(poses[i - 1], chain, tools_m, angle)).norm()});
  }
  return found;
}

double misfit_m(const std::vector<Move>& moved) {
  double sum = 0.0;
  for (const Move& move : moved) sum += std::abs(move.measured_m - move.nominal_m);
  return sum;
}

/// Whether a range of angles, taken as degrees, is wider than arms move by accident but as wide as radians are.
bool spreads_like_radians(std::span<const MeasuredPose> poses, const Chain& chain) {
  for (int i = 0; i < chain.size(); ++i) {
    if (chain.joints[static_cast<std::size_t>(i)].type != JointType::revolute) continue;
    const auto [lowest, highest] = std::minmax_element(
        poses.begin(), poses.end(), [&](const auto& a, const auto& b) { return a.joints[i] < b.joints[i]; });
    if (degrees(highest->joints[i] - lowest->joints[i]) > 1.0) return true;
  }
  return false;
}

bool degrees_look_like_radians(std::span<const MeasuredPose> poses, const Chain& chain, const Tools& tools_m) {
  for (const MeasuredPose& pose : poses) {
    for (int i = 0; i < chain.size(); ++i) {
      const bool revolute = chain.joints[static_cast<std::size_t>(i)].type == JointType::revolute;
      if (revolute && std::abs(degrees(pose.joints[i])) > kTurn_rad + 0.02) return false;
    }
  }
  const auto as_headed = moves(poses, chain, tools_m);
  if (as_headed.empty()) return spreads_like_radians(poses, chain);
  return misfit_m(moves(poses, chain, tools_m, degrees)) < 0.5 * misfit_m(as_headed);
}

void check_headed_radians(std::span<const MeasuredPose> poses, std::size_t index, const Joint& joint,
                          const std::string& column, const std::string& file) {
  const double widest = std::max({2.0 * kTurn_rad, std::abs(joint.lower), std::abs(joint.upper)});
  for (const MeasuredPose& pose : poses) {
    const double value = pose.joints[static_cast<Eigen::Index>(index)];
    if (std::abs(value) <= widest) continue;
    throw InputError({file, pose.line}, number_text(value),
                     "column " + column + " is in radians, but this looks like degrees: it is more than two turns");
  }
}

}  // namespace

void check_joint_units(std::span<const MeasuredPose> poses, const ColumnMap& columns, const AssumedUnits& units,
                       const Chain& chain, const Tools& tools_m, const CsvTable& table) {
  bool any_degrees = false;
  bool any_radians = false;
  std::string first_column;
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    if (chain.joints[i].type != JointType::revolute) continue;
    const bool headed_degrees = unit_of(columns.joints[i], Quantity::angle, units).name == "deg";
    (headed_degrees ? any_degrees : any_radians) = true;
    if (first_column.empty()) first_column = columns.joints[i].name;
    if (!headed_degrees) check_headed_radians(poses, i, chain.joints[i], columns.joints[i].name, table.file);
  }
  if (any_degrees && !any_radians && degrees_look_like_radians(poses, chain, tools_m)) {
    throw InputError(
        {table.file, table.header_line}, first_column,
        "this column and the other joints are in degrees, but their values look like radians: none is beyond "
        "6.3 and they move the arm too little");
  }
}

void check_position_units(std::span<const MeasuredPose> poses, const ColumnMap& columns, const AssumedUnits& units,
                          const Chain& chain, const Tools& tools_m, const CsvTable& table) {
  if (columns.position.empty()) return;
  std::size_t counted = 0, thousandfold = 0, thousandth = 0;
  for (const Move& move : moves(poses, chain, tools_m)) {
    if (move.nominal_m < 1e-3) continue;  // repeats and small moves say nothing about scale
    const double ratio = move.measured_m / move.nominal_m;
    ++counted;
    if (ratio > 700.0 && ratio < 1400.0) ++thousandfold;
    if (ratio > 0.7e-3 && ratio < 1.4e-3) ++thousandth;
  }
  const ColumnName& column = columns.position.front();
  const bool headed_mm = unit_of(column, Quantity::length, units).name == "mm";
  if (counted < kFewestMoves || std::max(thousandfold, thousandth) * 10 < counted * 9) return;
  if (headed_mm != (thousandth > 0)) return;  // a scale that no mistaken unit explains
  throw InputError({table.file, table.header_line}, column.name,
                   headed_mm
                       ? "positions are in millimetres, but they look like metres: the arm moved 1000 times as far"
                       : "positions are in metres, but they look like millimetres: the arm moved a thousandth");
}

}  // namespace demecal
