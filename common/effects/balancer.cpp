// What a balance spring does to the joint that it relieves, where the robot's file says how it hangs.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "effects/law_terms.hpp"
#include "effects/symbolic_state.hpp"
#include "kinematics/chain.hpp"
#include "symbolic/algebra.hpp"

namespace demecal::inline effects {
namespace {

constexpr const char *kFixedPivot = "fixed_m", *kMovingPivot = "moving_m", *kShortestAt = "shortest_rad";

/// A spring (or a gas spring, or a cylinder) between a pivot on the link before the joint and one on the link behind
/// it: of the length L(q), L^2 = f^2 + m^2 - 2 f m cos(q - q_shortest), it turns the joint by its force times dL/dq.
/// The force is what it has where it is shortest and grows in proportion with its length; the joint gives way to both
/// parts: two coefficients, each the joint's compliance times the force (preload) or the spring's rate.
class BalancerLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "balancer"; }
  std::vector<CoefficientLabel> coefficients(const Effect& /*effect*/, const Robot& /*robot*/) const override {
    return {{"preload_rad_per_m", "rad/m"}, {"rate_rad_per_m2", "rad/m^2"}};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    const SpringArm arm = spring_arm(effect, state.joints()[effect.joint]);
    append_joint_motion(robot, effect.joint, 0, -arm.lever_m, motions);
    append_joint_motion(robot, effect.joint, 1, -arm.lever_m * arm.stretched_m, motions);
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& /*evidence*/) const override {
    std::vector<Effect> effects;
    for (const Balancer& one : robot.balancers) {
      effects.push_back(
          {.kind = "balancer",
           .joint = one.joint,
           .settings = {{kFixedPivot, one.fixed_m}, {kMovingPivot, one.moving_m}, {kShortestAt, one.shortest_rad}}});
    }
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    const std::string joint = std::to_string(effect.joint + 1), lever = "dL" + joint + "/dq" + joint;
    return write_joint_equation(effect, robot, {{0, lever, -1.0}, {1, lever + " (L" + joint + " - Lmin)", -1.0}});
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    return joint_name(effect.joint) + " gives way to its balance spring: by up to " +
           motion_text(robot, effect.joint, largest_turn_rad(effect, robot)) + '.';
  }
  std::vector<std::string> settings() const override { return {kFixedPivot, kMovingPivot, kShortestAt}; }
  bool is_smooth(const Effect& /*effect*/) const override { return true; }
  void append_symbolic_motions(SymbolicWriter& writer) const override {
    const double fixed_m = writer.effect.setting(kFixedPivot), moving_m = writer.effect.setting(kMovingPivot);
    const Expression turned = writer.own_joint() - writer.constant(writer.effect.setting(kShortestAt));
    const Expression square = writer.constant(fixed_m * fixed_m + moving_m * moving_m) -
                              writer.constant(2.0 * fixed_m * moving_m) * cosine(turned);
    const Expression length = square_root(square);
    const Expression lever = -(writer.constant(fixed_m * moving_m) * sine(turned) / length);
    writer.append_joint(0, lever);
    writer.append_joint(1, lever * (length - writer.constant(std::abs(fixed_m - moving_m))));
  }

 private:
  struct SpringArm {
    double lever_m;      ///< dL/dq
    double stretched_m;  ///< beyond its shortest
  };
  static SpringArm spring_arm(const Effect& effect, double q_rad) {
    const double fixed_m = effect.setting(kFixedPivot), moving_m = effect.setting(kMovingPivot);
    const double turned_rad = q_rad - effect.setting(kShortestAt);
    const double length_m =
        std::sqrt(fixed_m * fixed_m + moving_m * moving_m - 2.0 * fixed_m * moving_m * std::cos(turned_rad));
    return {fixed_m * moving_m * std::sin(turned_rad) / length_m, length_m - std::abs(fixed_m - moving_m)};
  }
  /// Over the joint's range.
  static double largest_turn_rad(const Effect& effect, const Robot& robot) {
    constexpr int kSteps = 180;
    const Joint& joint = robot.chain.joints[static_cast<std::size_t>(effect.joint)];
    double largest_rad = 0.0;
    for (int step = 0; step <= kSteps; ++step) {
      const SpringArm arm = spring_arm(effect, std::lerp(joint.lower, joint.upper, step / static_cast<double>(kSteps)));
      largest_rad =
          std::max(largest_rad, std::abs(arm.lever_m * (effect.value(0) + arm.stretched_m * effect.value(1))));
    }
    return largest_rad;
  }
};

}  // namespace

const EffectLaw& balancer_law() {
  static const BalancerLaw law;
  return law;
}

}  // namespace demecal::inline effects
