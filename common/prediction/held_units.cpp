#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "effects/effect.hpp"
#include "effects/symbolic_state.hpp"
#include "expression/bound.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "prediction/corrected_arm.hpp"
#include "symbolic/algebra.hpp"

namespace demecal::inline prediction {
namespace {

double width(const Interval& range) {
  return range.upper - range.lower;
}
double middle(const Interval& range) {
  return 0.5 * (range.lower + range.upper);
}

/// x^2 (3 - 2 x).
Expression smooth_step(Expression x) {
  return x * x * (3.0 - 2.0 * x);
}

/// One joint and the range in which the effect is known of it.
struct RangedJoint {
  int joint;
  Interval range;
  bool revolute;
  Expression value;   ///< where the arm is: by whole turns near the middle of a range of less than a turn
  Expression nearer;  ///< within the range
  Expression beyond;  ///< how far outside, else 0
};

std::vector<RangedJoint> ranged_joints(const Effect& effect, const SymbolicState& state) {
  std::vector<RangedJoint> all;
  for (const auto& [joint, range] : effect.ranges) {
    const Expression given = state.joints[static_cast<std::size_t>(joint)];
    const bool revolute = is_revolute(state.robot->chain, joint);
    const Expression value = revolute && width(range) < kTurn_rad ? wrapped_near(given, middle(range)) : given;
    const Expression beyond = larger(larger(range.lower - value, value - range.upper), state.algebra().constant(0.0));
    all.push_back({joint, range, revolute, value, held_within(value, range), beyond});
  }
  return all;
}

struct SymbolicHeldState {
  std::vector<Expression> joints;
  Expression weight;
};

/// The weight of the end farther from the joint: none where the ends are no neighbours.
Expression symbolic_weight_of_farther_end(const RangedJoint& joint) {
  const double unmeasured = kTurn_rad - width(joint.range);
  if (!joint.revolute || unmeasured <= 0.0) return joint.value.algebra().constant(0.0);
  return smooth_step((1.0 / unmeasured) * joint.beyond);
}

Expression farther_end(const RangedJoint& joint) {
  const Expression side = joint.value.algebra().function(Function::sign, {joint.value - middle(joint.range)});
  return middle(joint.range) - 0.5 * width(joint.range) * side;
}

std::vector<SymbolicHeldState> symbolic_held_states(const SymbolicState& state, const std::vector<RangedJoint>& joints,
                                                    bool fades) {
  Algebra& algebra = state.algebra();
  std::vector<SymbolicHeldState> all{{state.joints, algebra.constant(1.0)}};
  for (const RangedJoint& joint : joints) {
    const auto i = static_cast<std::size_t>(joint.joint);
    const Expression weight = fades ? algebra.constant(0.0) : symbolic_weight_of_farther_end(joint);
    const std::size_t known = all.size();
    for (std::size_t k = 0; k < known; ++k) {
      all[k].joints[i] = joint.nearer;
      if (weight.is(0.0)) continue;
      SymbolicHeldState far{all[k].joints, all[k].weight * weight};
      far.joints[i] = farther_end(joint);
      all[k].weight = all[k].weight * (1.0 - weight);
      all.push_back(std::move(far));
    }
  }
  return all;
}

}  // namespace

std::vector<SymbolicUnit> held_units(const Effect& effect, const SymbolicState& state, const std::string& name) {
  if (effect.ranges.empty()) return symbolic_units(effect, state, name);
  Algebra& algebra = state.algebra();
  const bool fades = law_of(effect).fades(effect);
  const std::vector<RangedJoint> joints = ranged_joints(effect, state);
  Expression share = algebra.constant(1.0);
  for (const RangedJoint& joint : joints) {
    if (fades) share = share * smooth_step(larger(algebra.constant(0.0), 1.0 - (1.0 / kFade) * joint.beyond));
  }
  std::vector<SymbolicUnit> all;
  for (const SymbolicHeldState& anchor : symbolic_held_states(state, joints, fades)) {
    SymbolicState held = state;
    held.joints = anchor.joints;
    for (SymbolicUnit unit : symbolic_units(effect, held, name)) {
      unit.size = share * anchor.weight * unit.size;
      all.push_back(unit);
    }
  }
  return all;
}

}  // namespace demecal::inline prediction
