#include "formulas/symbolic_frame.hpp"

#include <algorithm>

namespace demecal {
namespace {

/// Turns the frame about one of its own axes: the two that follow it mix.
void turn(SymbolicFrame& frame, int axis, Expression angle) {
  const auto first = static_cast<std::size_t>((axis + 1) % 3), second = static_cast<std::size_t>((axis + 2) % 3);
  const Expression c = cosine(angle), s = sine(angle);
  const SymbolicVector old_first = frame.axes[first], old_second = frame.axes[second];
  frame.axes[first] = plus(scaled(c, old_first), scaled(s, old_second));
  frame.axes[second] = minus(scaled(c, old_second), scaled(s, old_first));
}

/// The rotation by a vector (Rodrigues): 1 + sin t / t [v] + (1 - cos t) / t^2 [v]^2, t = |v|, whole at t = 0 too.
SymbolicFrame rotation(Algebra& algebra, const SymbolicVector& vector) {
  const Expression length = square_root(dot(vector, vector)), half = 0.5 * length;
  const Expression by_sine = algebra.function(Function::divide_or_one, {sine(length), length});
  const Expression by_half = algebra.function(Function::divide_or_one, {sine(half), half});
  const Expression by_cosine = 0.5 * by_half * by_half;
  SymbolicFrame result(algebra);
  for (SymbolicVector& axis : result.axes) {
    const SymbolicVector once = cross(vector, axis);
    axis = plus(axis, plus(scaled(by_sine, once), scaled(by_cosine, cross(vector, once))));
  }
  return result;
}

}  // namespace

SymbolicVector constant_vector(Algebra& algebra, const Eigen::Vector3d& vector) {
  return {algebra.constant(vector.x()), algebra.constant(vector.y()), algebra.constant(vector.z())};
}

SymbolicVector plus(const SymbolicVector& a, const SymbolicVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
SymbolicVector minus(const SymbolicVector& a, const SymbolicVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
SymbolicVector scaled(Expression factor, const SymbolicVector& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
Expression dot(const SymbolicVector& a, const SymbolicVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
SymbolicVector cross(const SymbolicVector& a, const SymbolicVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

SymbolicFrame::SymbolicFrame(Algebra& algebra) : SymbolicFrame(algebra, Eigen::Isometry3d::Identity()) {}

SymbolicFrame::SymbolicFrame(Algebra& algebra, const Eigen::Isometry3d& pose)
    : axes{constant_vector(algebra, pose.linear().col(0)), constant_vector(algebra, pose.linear().col(1)),
           constant_vector(algebra, pose.linear().col(2))},
      origin(constant_vector(algebra, pose.translation())) {}

SymbolicVector SymbolicFrame::direction(const SymbolicVector& own) const {
  return plus(plus(scaled(own[0], axes[0]), scaled(own[1], axes[1])), scaled(own[2], axes[2]));
}

SymbolicVector SymbolicFrame::point(const SymbolicVector& own) const {
  return plus(origin, direction(own));
}

SymbolicVector SymbolicFrame::own_direction(const SymbolicVector& outer) const {
  return {dot(axes[0], outer), dot(axes[1], outer), dot(axes[2], outer)};
}

SymbolicMatrix SymbolicFrame::matrix() const {
  SymbolicMatrix rows;
  for (std::size_t row = 0; row < 3; ++row) rows.push_back({axes[0][row], axes[1][row], axes[2][row], origin[row]});
  const Expression zero = algebra().constant(0.0);
  rows.push_back({zero, zero, zero, algebra().constant(1.0)});
  return rows;
}

SymbolicFrame operator*(const SymbolicFrame& frame, const SymbolicFrame& next) {
  SymbolicFrame result = frame;
  for (std::size_t i = 0; i < 3; ++i) result.axes[i] = frame.direction(next.axes[i]);
  result.origin = frame.point(next.origin);
  return result;
}

SymbolicFrame seen_from(const SymbolicFrame& from, const SymbolicFrame& frame) {
  SymbolicFrame result = frame;
  for (std::size_t i = 0; i < 3; ++i) result.axes[i] = from.own_direction(frame.axes[i]);
  result.origin = from.own_direction(minus(frame.origin, from.origin));
  return result;
}

void advance(SymbolicFrame& frame, const Elementary& transform, Expression value) {
  if (transform.rotates) return turn(frame, transform.axis, value);
  frame.origin = plus(frame.origin, scaled(value, frame.axes[static_cast<std::size_t>(transform.axis)]));
}

SymbolicFrame moved(const SymbolicFrame& frame, const SymbolicMotion& motion) {
  SymbolicFrame result = frame;
  result.origin = frame.point({motion[0], motion[1], motion[2]});
  const SymbolicVector vector{motion[3], motion[4], motion[5]};
  const auto turns = std::ranges::count_if(vector, [](Expression component) { return !component.is(0.0); });
  if (turns == 1) {
    for (int axis = 0; axis < 3; ++axis) turn(result, axis, vector[static_cast<std::size_t>(axis)]);
  } else if (turns > 1) {
    const SymbolicFrame by = rotation(frame.algebra(), vector);
    for (std::size_t i = 0; i < 3; ++i) result.axes[i] = frame.direction(by.axes[i]);
  }
  return result;
}

}  // namespace demecal
