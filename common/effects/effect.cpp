#include "effects/effect.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "effects/catalogue.hpp"
#include "errors/check.hpp"
#include "kinematics/angles.hpp"

namespace demecal::inline effects {
namespace {

/// The form that an effect is of: an empty one stands for its law's first.
std::string form_of(const Effect& effect) {
  if (!effect.form.empty()) return effect.form;
  const EffectLaw* law = find_law(effect.kind);
  const std::vector<std::string> forms = law == nullptr ? std::vector<std::string>{} : law->forms();
  return forms.empty() ? std::string() : forms.front();
}

/// 1 within the range, 0 from kFade beyond it, with a continuous slope between.
double share_within(const Interval& range, double value) {
  const double beyond = std::max({range.lower - value, value - range.upper, 0.0});
  const double x = std::max(0.0, 1.0 - beyond / kFade);
  return x * x * (3.0 - 2.0 * x);
}

/// By whole turns near the range's middle; beside a range of a turn and more every turn is a place of its own.
double nearest_turn(const Chain& chain, int joint, const Interval& range, double value) {
  const bool wraps = is_revolute(chain, joint) && range.upper - range.lower < kTurn_rad;
  return wraps ? wrap_near(value, 0.5 * (range.lower + range.upper)) : value;
}

bool is_within(const Effect& effect, const JointVector& joints) {
  return std::ranges::all_of(effect.ranges, [&](const auto& entry) {
    return joints[entry.first] >= entry.second.lower && joints[entry.first] <= entry.second.upper;
  });
}

/// Joints where the effect is known, and how much of what it is there holds.
struct HeldState {
  JointVector joints;
  double weight = 1.0;
};

/// Of the end of `range` that is farther from `value`, which lies beyond it: a revolute joint's two ends are neighbours
/// across the turns that were not measured, and half the way from one to the other each counts as much.
double weight_of_farther_end(const Chain& chain, int joint, const Interval& range, double value) {
  const double unmeasured = kTurn_rad - (range.upper - range.lower);
  if (!is_revolute(chain, joint) || unmeasured <= 0) return 0.0;
  const double x = std::max(range.lower - value, value - range.upper) / unmeasured;
  return x * x * (3.0 - 2.0 * x);
}

std::vector<HeldState> held_states(const Effect& effect, bool fades, const Chain& chain, const JointVector& joints) {
  std::vector<HeldState> all{{joints, 1.0}};
  for (const auto& [joint, range] : effect.ranges) {
    const double value = nearest_turn(chain, joint, range, joints[joint]);
    const double nearer = std::clamp(value, range.lower, range.upper);
    const double farther = nearer == range.lower ? range.upper : range.lower;
    const double weight = fades || nearer == value ? 0.0 : weight_of_farther_end(chain, joint, range, value);
    const std::size_t known = all.size();
    for (std::size_t i = 0; i < known; ++i) {
      all[i].joints[joint] = nearer;
      if (weight == 0.0) continue;
      all.push_back({all[i].joints, all[i].weight * weight});
      all.back().joints[joint] = farther;
      all[i].weight *= 1.0 - weight;
    }
  }
  return all;
}

}  // namespace

double Effect::setting(const std::string& name) const {
  const auto found = settings.find(name);
  DEMECAL_CHECK(found != settings.end(), kind << " has no setting '" << name << "'");
  return found->second;
}

std::span<const CircumstanceWords> circumstances() {
  static constexpr std::array<CircumstanceWords, 5> kAll{
      {{"approach", "the side from which joints come", "no side", &Needs::approach,
        [](const MeasuredPose& pose) { return pose.approach.has_value(); }},
       {"torque", "the drives' torques", "the weight that they told of while it was calibrated", &Needs::torque,
        [](const MeasuredPose& pose) { return pose.torque.has_value(); }},
       {"payload", "the payload", "an empty hand", &Needs::payload,
        [](const MeasuredPose& pose) { return pose.payload_kg.has_value(); }},
       {"temperature", "the temperature", "the effect's reference", &Needs::temperature,
        [](const MeasuredPose& pose) { return pose.temperature_celsius.has_value(); }},
       {"time", "the time", "the effect's reference", &Needs::time,
        [](const MeasuredPose& pose) { return pose.time_s.has_value(); }}}};
  return kAll;
}

std::optional<DecoyEffect> EffectLaw::decoy(const Effect& /*effect*/, const Evidence& /*evidence*/) const {
  return std::nullopt;
}

bool Effect::same_law_as(const Effect& other) const {
  return kind == other.kind && joint == other.joint && settings == other.settings && formula == other.formula &&
         form_of(*this) == form_of(other);
}

double known_share(const Effect& effect, const Chain& chain, const JointVector& joints) {
  double share = 1.0;
  for (const auto& [joint, range] : effect.ranges) {
    share *= share_within(range, nearest_turn(chain, joint, range, joints[joint]));
  }
  return share;
}

void append_unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                         std::vector<UnitMotion>& motions) {
  const EffectLaw& law = law_of(effect);
  if (is_within(effect, state.joints())) return law.unit_motions(effect, robot, state, motions);
  const bool fades = law.fades(effect);
  const double share = fades ? known_share(effect, robot.chain, state.joints()) : 1.0;
  if (share == 0.0) return;
  ArmState held = state;
  for (const HeldState& anchor : held_states(effect, fades, robot.chain, state.joints())) {
    held.stop.joints = anchor.joints;
    const std::size_t before = motions.size();
    law.unit_motions(effect, robot, held, motions);
    for (std::size_t i = before; i < motions.size(); ++i) motions[i].size *= share * anchor.weight;
  }
}

}  // namespace demecal::inline effects
