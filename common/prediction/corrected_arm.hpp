// A model as formulas of its joints alone: where each joint really goes, and where that puts the tool, with effects
// held within the ranges they were measured in.
#pragma once

#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "effects/effect.hpp"
#include "effects/symbolic_state.hpp"
#include "expression/bound.hpp"
#include "kinematics/units.hpp"
#include "prediction/corrected_robot.hpp"
#include "symbolic/algebra.hpp"
#include "symbolic/code.hpp"
#include "symbolic/parse_expression.hpp"

namespace demecal::inline prediction {
/// What a unit of one of the model's coefficients does, as EffectMotion.
struct SymbolicEffectUnit {
  std::size_t effect = 0;  ///< of the model's, from 0
  SymbolicUnit unit;
};

/// The formulas, and what the model knows beyond them.
struct CorrectedArm {
  std::vector<Expression> actual;  ///< q + g(q) of each joint, of the symbol q1 .. qn
  SymbolicMatrix pose;  ///< of the tool in the measurements' frame, of q1 .. qn, actual1 .. actualn and circumstances
  std::vector<std::string> notes;           ///< sentences: effects that are left out, or not held as they were measured
  double reference_celsius = 20.0;          ///< above which kWarming counts: that of the model's first effect of warmth
  std::vector<Expression> driven{};         ///< where couplings and effects turn the joints
  std::vector<SymbolicMotion> places{};     ///< how effects move the places of the arm
  std::vector<SymbolicEffectUnit> units{};  ///< what these motions are made of
  std::vector<MovingAxis> axes{};           ///< where `pose` has them
};

/// The model's prediction at any stop, of which neither the time nor the drives' torques are known: circumstances are
/// the symbols of Listing. The expressions live in `algebra`. The robot must have the target.
/// Formulas of effects are called `effects` and a number.
CorrectedArm corrected_arm(Algebra& algebra, const CorrectedRobot& robot, const std::string& target,
                           const std::string& effects = "effect");

/// Whose frame poses stand in: of a model whose base was not fitted, as from contacts, that of the arm's own base.
enum class PoseFrame { measurements, own_base };

/// The listing of the formulas with the remarks that a reader needs: what it is, units, frames, and the notes.
Listing listing_of(const CorrectedArm& arm, const CorrectedRobot& robot, const std::string& title,
                   PoseFrame frame = PoseFrame::measurements);

/// The listing of the arm as `robot.described` has it, in the base of `robot` and with a tool of its own: what
/// inverse_in_c() corrects for.
Listing described_listing(Algebra& algebra, const CorrectedRobot& robot, const Eigen::Isometry3d& tool);

/// What the correction adds to a joint that is commanded so: a formula of that name.
Expression added_by(const JointCorrection& correction, Expression commanded, const std::string& name);

/// As wrap_near().
inline Expression wrapped_near(Expression angle, double centre_rad) {
  const Expression turns = (1.0 / kTurn_rad) * (angle - centre_rad);
  return angle - kTurn_rad * angle.algebra().function(Function::round, {turns});
}

/// The nearest value of the range.
inline Expression held_within(Expression value, const Interval& range) {
  Algebra& algebra = value.algebra();
  return smaller(larger(value, algebra.constant(range.lower)), algebra.constant(range.upper));
}

/// As symbolic_units(), with the effect held, and faded, beyond the ranges it was measured in, as append_unit_motions()
/// does it.
std::vector<SymbolicUnit> held_units(const Effect& effect, const SymbolicState& state, const std::string& name);

}  // namespace demecal::inline prediction
