#include "preparation/trilateration.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace demecal {
namespace {

constexpr double kFlattest = 1e-3;  // of the longest side

Eigen::Vector3d corner_b(const CordCorners& corners) {
  return {corners.b_x_m, 0.0, 0.0};
}
Eigen::Vector3d corner_c(const CordCorners& corners) {
  return {corners.c_x_m, corners.c_y_m, 0.0};
}

/// By the implicit function theorem: each sphere's gradient at the point, over its radius, is the direction of its
/// cord, so that the derivative is the inverse of the matrix of these directions.
Eigen::Matrix3d derivative_at(const CordCorners& corners, const Eigen::Vector3d& point_m) {
  Eigen::Matrix3d directions;
  directions.row(0) = point_m.normalized();
  directions.row(1) = (point_m - corner_b(corners)).normalized();
  directions.row(2) = (point_m - corner_c(corners)).normalized();
  return directions.inverse();
}

}  // namespace

std::optional<CordCorners> cord_corners(const CordTriangle& triangle) {
  const double ab = triangle.ab_m, bc = triangle.bc_m, ca = triangle.ca_m;
  const double longest = std::max({ab, bc, ca});
  if (!(ab > 0.0 && bc > 0.0 && ca > 0.0)) return std::nullopt;
  const double g = (ca * ca - bc * bc + ab * ab) / (2.0 * ab);
  const double h_squared = ca * ca - g * g;
  if (!(h_squared > kFlattest * kFlattest * longest * longest)) return std::nullopt;
  return CordCorners{ab, g, std::sqrt(h_squared)};
}

CordPoint trilaterate(const CordCorners& corners, const Eigen::Vector3d& cords_m, PlaneSide side) {
  const double l = corners.b_x_m, g = corners.c_x_m, h = corners.c_y_m;
  const Eigen::Vector3d squares = cords_m.cwiseAbs2();
  const double x = (squares[0] - squares[1] + l * l) / (2.0 * l);
  const double y = (squares[0] - squares[2] - 2.0 * g * x + g * g + h * h) / (2.0 * h);
  CordPoint found{.height_squared_m2 = squares[0] - x * x - y * y};
  if (!found.meets()) return found;
  const double z = std::sqrt(found.height_squared_m2);
  found.point_m = {x, y, side == PlaneSide::above ? z : -z};
  found.derivative = derivative_at(corners, found.point_m);
  return found;
}

Eigen::Vector3d cord_lengths(const CordCorners& corners, const Eigen::Vector3d& point_m) {
  return {point_m.norm(), (point_m - corner_b(corners)).norm(), (point_m - corner_c(corners)).norm()};
}

Eigen::Matrix3d covariance_of(const CordPoint& point, double cord_m) {
  return cord_m * cord_m * point.derivative * point.derivative.transpose();
}

}  // namespace demecal
