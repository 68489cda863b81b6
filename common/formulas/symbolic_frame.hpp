// Rigid frames whose numbers are expressions.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "kinematics/elementary.hpp"
#include "symbolic/parse_expression.hpp"

namespace demecal {

using SymbolicVector = std::vector<Expression>;  ///< x, y, z

SymbolicVector constant_vector(Algebra& algebra, const Eigen::Vector3d& vector);
SymbolicVector plus(const SymbolicVector& a, const SymbolicVector& b);
SymbolicVector minus(const SymbolicVector& a, const SymbolicVector& b);
SymbolicVector scaled(Expression factor, const SymbolicVector& a);
Expression dot(const SymbolicVector& a, const SymbolicVector& b);
SymbolicVector cross(const SymbolicVector& a, const SymbolicVector& b);

/// Axes and origin in the frame that it stands in.
struct SymbolicFrame {
  std::array<SymbolicVector, 3> axes;
  SymbolicVector origin;

  explicit SymbolicFrame(Algebra& algebra);  ///< the frame it stands in itself
  SymbolicFrame(Algebra& algebra, const Eigen::Isometry3d& pose);

  Algebra& algebra() const { return origin[0].algebra(); }
  /// A direction or a point, given in this frame, in the frame it stands in.
  SymbolicVector direction(const SymbolicVector& own) const;
  SymbolicVector point(const SymbolicVector& own) const;
  /// A direction of the frame it stands in, in this frame.
  SymbolicVector own_direction(const SymbolicVector& outer) const;
  SymbolicMatrix matrix() const;
};

/// `frame` and then `next`, which stands in it.
SymbolicFrame operator*(const SymbolicFrame& frame, const SymbolicFrame& next);
/// `frame` seen from `from`; both stand in the same frame.
SymbolicFrame seen_from(const SymbolicFrame& from, const SymbolicFrame& frame);

/// `frame` moved by an elementary transform of the given value; an angle of exactly 0 or a right angle is exact.
void advance(SymbolicFrame& frame, const Elementary& transform, Expression value);

/// Six components as of SmallMotion: a shift, and then a turn by a rotation vector.
using SymbolicMotion = std::vector<Expression>;
SymbolicFrame moved(const SymbolicFrame& frame, const SymbolicMotion& motion);

}  // namespace demecal
