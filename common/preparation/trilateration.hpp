// Three cord lengths from the corners of a triangle to the point where the cords meet (thesis A.1).
#pragma once

#include <Eigen/Core>
#include <optional>

namespace demecal {

/// The sides of the triangle of the three places where the cords come out, m.
struct CordTriangle {
  double ab_m = 0.0, bc_m = 0.0, ca_m = 0.0;
};

/// The triangle in the instrument's frame: A in the origin, B on the positive x axis, C at positive y, z = 0.
struct CordCorners {
  double b_x_m = 0.0;  ///< B = (b_x, 0, 0)
  double c_x_m = 0.0;  ///< C = (c_x, c_y, 0); the thesis's g and h
  double c_y_m = 0.0;
};

/// Nothing where the sides make no triangle, or one whose height over AB is below a thousandth of its longest side.
std::optional<CordCorners> cord_corners(const CordTriangle& triangle);

/// On which side of the triangle's plane the point is: positive or negative z.
enum class PlaneSide { above, below };

struct CordPoint {
  double height_squared_m2 = 0.0;                        ///< z^2; not positive: the cords do not meet off the plane
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();     ///< in the instrument's frame
  Eigen::Matrix3d derivative = Eigen::Matrix3d::Zero();  ///< of x, y, z (rows) by the lengths of a, b, c (columns)

  bool meets() const { return height_squared_m2 > 0.0; }
};

/// The point at distances `cords_m` from A, B and C. With (g, h) = C and l = |AB|, the three spheres (thesis A.1 to
/// A.3)
///   a^2 = x^2 + y^2 + z^2,  b^2 = (l - x)^2 + y^2 + z^2,  c^2 = (x - g)^2 + (h - y)^2 + z^2
/// give x from the first two, y from the first and the third, and z from what is left of the first. Where z^2 is not
/// positive (a point in the plane itself has no derivative), only `height_squared_m2` is set.
CordPoint trilaterate(const CordCorners& corners, const Eigen::Vector3d& cords_m, PlaneSide side);

/// The distances of a point from A, B and C, m.
Eigen::Vector3d cord_lengths(const CordCorners& corners, const Eigen::Vector3d& point_m);

/// Covariance of x, y, z, m^2, where every cord has the standard error `cord_m`, independently of the others.
Eigen::Matrix3d covariance_of(const CordPoint& point, double cord_m);

}  // namespace demecal
