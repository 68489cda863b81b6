#include "updating/model_amounts.hpp"

#include <vector>

#include "effects/arm_state.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline updating {
namespace {

/// How an effect moves `joint` about or along its own axis, at a state.
double own_motion(const Effect& effect, const Robot& robot, const ArmState& state, int joint) {
  constexpr int kAlongZ = 2, kAboutZ = 5;
  const int axis = is_revolute(robot.chain, joint) ? kAboutZ : kAlongZ;
  std::vector<UnitMotion> motions;
  append_unit_motions(effect, robot, state, motions);
  double sum = 0.0;
  for (const UnitMotion& one : motions)
    if (one.place == joint && one.axis == axis)
      sum += effect.value(static_cast<std::size_t>(one.coefficient)) * one.size;
  return sum;
}

/// By how much more an effect moves the joint that came from below than one of which that is not known, on average.
double motion_by_side(const Effect& effect, const DataSet& data, std::span<const std::size_t> poses, int joint) {
  double sum = 0.0;
  for (const std::size_t pose : poses) {
    Stop stop(data.poses[pose]);
    stop.approach = ApproachSigns::Zero(data.robot.chain.size());
    sum -= own_motion(effect, data.robot, arm_state(data.robot, stop), joint);
    stop.approach[joint] = 1.0;
    sum += own_motion(effect, data.robot, arm_state(data.robot, stop), joint);
  }
  return sum / static_cast<double>(poses.size());
}

}  // namespace

std::optional<double> amount_by_model(const CorrectedRobot& robot, const DataSet& data,
                                      std::span<const std::size_t> poses, const Effect& cause) {
  const EffectLaw& law = law_of(cause);
  if (law.subject() != Subject::joint || poses.empty()) return std::nullopt;
  double amount = 0.0;
  if (law.prerequisite() == Circumstance::temperature) {
    for (const Effect& effect : robot.effects)
      if (effect.kind == cause.kind && effect.joint == cause.joint) amount += effect.value(0);
    return amount;
  }
  if (law.prerequisite() != Circumstance::approach) return std::nullopt;
  Effect unit = cause;
  unit.values = {1.0};
  const double of_unit = motion_by_side(unit, data, poses, cause.joint);
  if (of_unit == 0.0) return std::nullopt;
  for (const Effect& effect : robot.effects)
    if (law_of(effect).needs(effect, data.robot).approach)
      amount += motion_by_side(effect, data, poses, cause.joint) / of_unit;
  return amount;
}

}  // namespace demecal::inline updating
