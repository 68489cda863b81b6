#include "parameters/symbolic_radius.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "effects/symbolic_state.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "symbolic/calculus.hpp"

namespace demecal::inline parameters {
namespace {

using Point = std::array<Expression, 3>;

Point as_point(const SymbolicVector& vector) {
  return {vector[0], vector[1], vector[2]};
}

/// As Screw.
struct SymbolicScrew {
  bool rotates;
  SymbolicVector direction, origin;

  /// As twist_at(), its linear part.
  SymbolicVector moves(const SymbolicVector& point) const {
    return rotates ? cross(direction, minus(point, origin)) : direction;
  }
};

/// As walk(): every elementary transform's screw, every place before its motion, and the tool point.
struct SymbolicWalk {
  std::vector<std::array<SymbolicScrew, kLinkParameters>> screws;
  std::vector<SymbolicFrame> places;
  SymbolicFrame flange;
  SymbolicVector point;

  SymbolicWalk(Algebra& algebra, const CorrectedRobot& robot, const std::vector<Expression>& driven,
               const std::vector<SymbolicMotion>* motions)
      : flange(algebra, robot.chain.base), point(constant_vector(algebra, Eigen::Vector3d::Zero())) {
    SymbolicFrame& frame = flange;
    const SymbolicScrew none{false, point, point};
    for (std::size_t i = 0; i < driven.size(); ++i) {
      screws.push_back({none, none, none, none, none});
      for (const Elementary& transform : elementary_transforms(robot.chain.convention)) {
        if (transform.parameter == LinkParameter::theta) reach(frame, motions);
        screws.back()[static_cast<std::size_t>(transform.parameter)] = {
            transform.rotates, frame.axes[static_cast<std::size_t>(transform.axis)], frame.origin};
        advance(frame, transform, elementary_value(robot.chain.joints[i], transform.parameter, driven[i]));
      }
    }
    frame = frame * SymbolicFrame(algebra, robot.chain.flange);
    reach(frame, motions);
    point = frame.point(constant_vector(algebra, robot.tool("").translation()));
  }

  const SymbolicScrew& drive(const Chain& chain, int joint) const {
    const auto which = is_revolute(chain, joint) ? LinkParameter::theta : LinkParameter::d;
    return screws[static_cast<std::size_t>(joint)][static_cast<std::size_t>(which)];
  }

 private:
  void reach(SymbolicFrame& frame, const std::vector<SymbolicMotion>* motions) {
    const std::size_t place = places.size();
    places.push_back(frame);
    if (motions != nullptr) frame = moved(frame, (*motions)[place]);
  }
};

/// As unit_twist(), its linear part; the turn's Jacobian by the first terms of its series, since turns are small.
SymbolicVector moved_by_unit(const SymbolicFrame& frame, const SymbolicMotion& motion, int axis,
                             const SymbolicVector& point) {
  if (axis < 3) return frame.axes[static_cast<std::size_t>(axis)];
  Algebra& algebra = frame.algebra();
  const SymbolicVector turn{motion[3], motion[4], motion[5]};
  const SymbolicVector unit = constant_vector(algebra, Eigen::Vector3d::Unit(axis - 3));
  const SymbolicVector once = cross(turn, unit), twice = cross(turn, once), thrice = cross(turn, twice);
  const SymbolicVector direction =
      plus(plus(unit, scaled(algebra.constant(0.5), once)),
           plus(scaled(algebra.constant(1.0 / 6.0), twice), scaled(algebra.constant(1.0 / 24.0), thrice)));
  return cross(frame.direction(direction), minus(point, frame.point({motion[0], motion[1], motion[2]})));
}

class RadiusFormulas {
 public:
  RadiusFormulas(Algebra& algebra, const Posterior& posterior, const CorrectedRobot& robot)
      : algebra_(algebra),
        posterior_(posterior),
        robot_(robot),
        arm_(corrected_arm(algebra, robot, "", "radius_effect")),
        walk_(algebra, robot, arm_.driven, &arm_.places),
        undisplaced_(algebra, robot, arm_.driven, nullptr) {}

  void add_spread(RadiusListing& radius) const {
    for (std::size_t i = 0; i < posterior_.ids.size(); ++i) add(radius, spread_of(posterior_.ids[i]), i);
    for (std::size_t i = 0; i < posterior_.terms.size(); ++i) {
      const CorrectionTerm& term = posterior_.terms[i];
      const Expression shape = added_by(term.shape, commanded(term.joint), "term" + std::to_string(i + 1));
      const SymbolicVector moves = undisplaced_.drive(robot_.chain, term.joint).moves(undisplaced_.point);
      add(radius, scaled(shape, moves), posterior_.ids.size() + i);
    }
  }

  Point point() const { return as_point(walk_.point); }

  /// By way outside of the ranges and inside of gaps, and by the payload.
  Expression widened(const MeasuredJoints& measured) const {
    Expression factor = algebra_.constant(1.0);
    for (std::size_t joint = 0; joint < measured.ranges.size(); ++joint) {
      const Interval& range = measured.ranges[joint];
      const double each = kGrowthPerRange / std::max(range.upper - range.lower, kLeastJointRange);
      const auto which = static_cast<int>(joint);
      factor = factor + each * positive(from_centre(which, range) - 0.5 * (range.upper - range.lower));
      const auto gaps = measured.gaps.find(which);
      if (gaps == measured.gaps.end()) continue;
      for (const Interval& gap : gaps->second)
        factor = factor + each * positive(0.5 * (gap.upper - gap.lower) - from_centre(which, gap));
    }
    if (robot_.payloads_kg)
      factor = factor + outside(algebra_.symbol(kPayload), *robot_.payloads_kg, kLeastPayloadRange);
    return factor;
  }

  /// The square of what corrections and effects that are held outside of what was measured may be off by, m^2.
  Expression held_square_m2(const MeasuredJoints& measured) const {
    Expression square = algebra_.constant(0.0);
    for (std::size_t joint = 0; joint < measured.ranges.size(); ++joint) {
      const Interval& range = measured.ranges[joint];
      const auto which = static_cast<int>(joint);
      const Expression outside = positive(from_centre(which, range) - 0.5 * (range.upper - range.lower));
      for (const HeldPart& held : held_parts(robot_, which)) {
        Expression off_by = held.steepest * outside;
        if (std::isfinite(held.span)) off_by = smaller(off_by, algebra_.constant(held.span));
        const SymbolicVector moves = undisplaced_.drive(robot_.chain, held.joint).moves(undisplaced_.point);
        for (const Expression& along : as_point(moves)) square = square + (off_by * along) * (off_by * along);
      }
    }
    return square;
  }

  Expression widened_by_warming(double reference_celsius) const {
    if (!robot_.temperatures_celsius) return algebra_.constant(0.0);
    return outside(algebra_.symbol(kWarming) + reference_celsius, *robot_.temperatures_celsius, kLeastTemperatureRange);
  }

 private:
  Expression commanded(int joint) const { return algebra_.symbol(commanded_joint(joint + 1)); }
  Expression positive(Expression value) const { return larger(value, algebra_.constant(0.0)); }

  Expression outside(Expression value, const Interval& range, double least) const {
    return (kGrowthPerRange / std::max(range.upper - range.lower, least)) *
           positive(larger(value - range.upper, range.lower - value));
  }

  Expression from_centre(int joint, const Interval& range) const {
    const double centre = 0.5 * (range.lower + range.upper);
    const bool turns = is_revolute(robot_.chain, joint);
    const Expression value = turns ? wrapped_near(commanded(joint), centre) : commanded(joint);
    return algebra_.function(Function::absolute, {value - centre});
  }

  SymbolicVector spread_of(const ParameterId& id) const {
    if (id.kind == ParameterId::Kind::link)
      return walk_.screws[static_cast<std::size_t>(id.index)][static_cast<std::size_t>(id.link)].moves(walk_.point);
    if (id.kind == ParameterId::Kind::tool_translation && id.target.empty())
      return walk_.flange.axes[static_cast<std::size_t>(id.index)];
    SymbolicVector sum = constant_vector(algebra_, Eigen::Vector3d::Zero());
    if (id.kind != ParameterId::Kind::effect) return sum;
    for (const SymbolicEffectUnit& one : arm_.units) {
      if (static_cast<int>(one.effect) != id.index || one.unit.coefficient != id.coefficient) continue;
      if (one.unit.place == kSensorPlace) continue;
      const auto place = static_cast<std::size_t>(one.unit.place);
      const SymbolicVector moves =
          is_joint_motion(robot_.chain, {one.unit.coefficient, one.unit.place, one.unit.axis})
              ? walk_.drive(robot_.chain, one.unit.place).moves(walk_.point)
              : moved_by_unit(walk_.places[place], arm_.places[place], one.unit.axis, walk_.point);
      sum = plus(sum, scaled(one.unit.size, moves));
    }
    return sum;
  }

  void add(RadiusListing& radius, const SymbolicVector& spread, std::size_t number) const {
    const auto row = posterior_.factor.row(static_cast<Eigen::Index>(number));
    std::vector<double> factor(row.begin(), row.end());
    while (!factor.empty() && factor.back() == 0.0) factor.pop_back();
    const bool moves = std::ranges::any_of(spread, [](Expression one) { return !one.is(0.0); });
    if (!moves || factor.empty()) return;
    radius.spread.push_back(as_point(spread));
    radius.factor.push_back(std::move(factor));
  }

  Algebra& algebra_;
  const Posterior& posterior_;
  const CorrectedRobot& robot_;
  const CorrectedArm arm_;
  const SymbolicWalk walk_, undisplaced_;
};

}  // namespace

RadiusListing symbolic_radius(Algebra& algebra, const PredictionInterval& interval, const Posterior& posterior,
                              const CorrectedRobot& robot, const MeasuredJoints& measured, double reference_celsius) {
  const RadiusFormulas formulas(algebra, posterior, robot);
  RadiusListing radius{.spread = {},
                       .factor = {},
                       .square_m2 = 3.0 * std::pow(interval.model_error_m, 2),
                       .quantile = real_quantile(),
                       .widened = formulas.widened(measured),
                       .widened_by_warming = formulas.widened_by_warming(reference_celsius),
                       .held_square_m2 = formulas.held_square_m2(measured),
                       .point = formulas.point()};
  formulas.add_spread(radius);
  const std::vector<Expression> point(radius.point.begin(), radius.point.end());
  const bool warms = std::ranges::any_of(
      terms_of(point), [](Expression term) { return term->kind == ExpressionKind::symbol && term->name == kWarming; });
  if (warms && robot.temperatures_celsius)
    radius.warming = {robot.temperatures_celsius->lower - reference_celsius,
                      robot.temperatures_celsius->upper - reference_celsius};
  return radius;
}

}  // namespace demecal::inline parameters
