// An effect that a model may lack: small motions of the arm, linear in a few coefficients, and what people call it.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "expression/bound.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline effects {

/// The joints' measured ranges within which an effect was identified: joint (from 0) and interval (rad or m).
using MeasuredRanges = std::map<int, Interval>;

/// One effect as a value: which law, where, and how much of it.
struct Effect {
  std::string kind;                          ///< a word of the catalogue
  int joint = -1;                            ///< from 0; -1: of the whole arm or of the instrument
  std::map<std::string, double> settings{};  ///< given numbers by name with unit; "from" is a joint, from 1
  std::string form{};                        ///< which form of the law, where there are several; empty: its first
  Tree formula{};                            ///< of a symbolic effect, in symbolic_variables(); of a wave: its angle
  std::vector<double> values{};              ///< coefficients, SI; empty: all zero
  std::vector<double> standard_errors{};     ///< of the coefficients, SI; empty: unknown
  MeasuredRanges ranges{};                   ///< empty: everywhere

  double setting(const std::string& name) const;  ///< must exist
  double value(std::size_t coefficient) const { return values.empty() ? 0.0 : values[coefficient]; }
  /// Whether both are the same law at the same place with the same settings, whatever the coefficients.
  bool same_law_as(const Effect& other) const;
};

/// What a unit of one coefficient does at a stop: `size` of motion along or about an axis of a place.
struct UnitMotion {
  int coefficient = 0;
  int place = 0;
  int axis = 0;       ///< of the place's frame: 0-2 translation along x, y, z (m); 3-5 rotation about them (rad)
  double size = 0.0;  ///< per unit of the coefficient
};

/// The name of a coefficient as reports and models write it, with its unit; values at borders are SI.
struct CoefficientLabel {
  std::string name;  ///< "width_rad", "cosine_rad", "rad_per_nm"
  std::string unit;  ///< "rad", "rad/Nm", "1"
};

/// What a data set must hold for an effect to be seen.
struct Needs {
  bool approach = false, torque = false, payload = false, temperature = false, time = false, masses = false;
};

/// What an effect may depend on beside joints and masses, for people.
struct CircumstanceWords {
  std::string_view name;     ///< "temperature"
  std::string_view words;    ///< "the temperature"
  std::string_view instead;  ///< what models take where it is not known
  bool Needs::*needed;
  bool (*recorded)(const MeasuredPose&);
};
std::span<const CircumstanceWords> circumstances();

/// What the data at hand hold: proposals are made within it.
struct Evidence {
  bool approach = false, payload = false, temperature = false, time = false;  ///< recorded and varied
  bool masses = false;  ///< the links' masses are known, and trusted
  /// One per joint, where drives' torques were logged and varied: what they say of gravity, see logged_weights().
  std::vector<std::map<std::string, double>> logged_weights{};
  bool orientation = false;                ///< measured
  std::vector<Interval> joint_ranges{};    ///< one per joint, rad or m
  double mean_temperature_celsius = 20.0;  ///< a reference for thermal effects
  double mean_time_s = 0.0;                ///< a reference for drift
  int highest_ratio = 200;                 ///< of the scan over gear harmonics
  std::vector<double> stated_ratios{};     ///< beyond the scan
};

/// Of what an effect is.
enum class Subject { joint, tool, instrument };

/// Without which nothing of a kind shows, whatever its form.
enum class Circumstance { none, approach, temperature, time, masses };

/// What makes a decoy impossible: a ratio that no gear has, or a circumstance dealt out anew over the poses.
enum class DecoyKind { none, wrong_ratio, shuffled_approach, shuffled_temperature };

/// What an effect may still add to its joint's motion beyond where another joint, or its own, was measured and it is
/// held: by how much it changes with that joint at most, and how far it goes at most (rad or m).
struct HeldMotion {
  int of_joint = 0;  ///< whose range it is, from 0
  double steepest = 0.0, span = 0.0;
};

struct DecoyEffect;     ///< an effect that cannot be true, tried among those that may be
struct SymbolicWriter;  ///< see effects/symbolic_state.hpp

/// A law of the catalogue. Laws know no coefficients' values unless an effect brings them.
class EffectLaw {
 public:
  virtual ~EffectLaw() = default;

  /// The catalogue's word.
  virtual std::string_view kind() const = 0;
  /// The coefficients of this effect, in order.
  virtual std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const = 0;
  /// Appends what a unit of each coefficient does at `state`.
  virtual void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                            std::vector<UnitMotion>& motions) const = 0;
  /// The effects of this kind that are worth trying on such data, coefficients unknown.
  virtual std::vector<Effect> proposals(const Robot& robot, const Evidence& evidence) const = 0;
  /// Further ones close to one of these, which it may be found among; none of laws whose proposals are all there is.
  virtual std::vector<Effect> finer_proposals(const Effect& /*effect*/, const Evidence& /*evidence*/) const {
    return {};
  }
  /// The effect that stands for the finer proposals from one to another, which data do not tell apart.
  virtual Effect between(const Effect& first, const Effect& /*last*/) const { return first; }
  /// Whether its effects are tried only where all others left structure: so many are proposed, and so seldom one is.
  virtual bool is_last_resort() const { return false; }
  /// What data must hold for it to be seen.
  virtual Needs needs(const Effect& effect, const Robot& robot) const = 0;
  /// "dq2 = -0.00025 rad s2": value, law and unit in one line.
  virtual std::string formula(const Effect& effect, const Robot& robot) const = 0;
  /// For a person: what is the matter, how much of it, and where.
  virtual std::string diagnosis(const Effect& effect, const Robot& robot) const = 0;
  /// Names of the settings this law has.
  virtual std::vector<std::string> settings() const { return {}; }
  /// Whether the effect cannot be without one of these.
  virtual bool requires_setting(const Effect& /*effect*/, const std::string& /*name*/) const { return true; }
  /// Names of the forms this law has; empty: one form only.
  virtual std::vector<std::string> forms() const { return {}; }
  /// Of what its effects are; those of a joint have one.
  virtual Subject subject() const { return Subject::joint; }
  /// Without which no data show any of its effects.
  virtual Circumstance prerequisite() const { return Circumstance::none; }
  /// Whether its effects are what formulas say (Effect::formula), and their names tell nothing.
  virtual bool takes_formula() const { return false; }
  /// Whether proposals are a scan over periods a turn.
  virtual bool is_harmonic() const { return false; }
  /// Whether it is a smooth function of its own joint alone, which a correction of the joint holds as well.
  virtual bool is_smooth(const Effect& /*effect*/) const { return false; }
  /// The joint (from 0) in proportion to whose value it moves its own; -1: none.
  virtual int proportional_to(const Effect& /*effect*/) const { return -1; }
  /// Whether what the arm carries changes it, though it is not of the payload alone.
  virtual bool bears_payload(const Effect& effect, const Robot& robot) const { return needs(effect, robot).masses; }
  /// Why no real arm has these coefficients, whatever motions they make; empty where one may.
  virtual std::string implausibility(const Effect& /*effect*/) const { return {}; }
  /// What to do about it, where that is something else than about its cause's other effects (CauseGroup); else empty.
  virtual std::string_view advice(const Effect& /*effect*/) const { return {}; }
  /// What to look at where its coefficients have a sign that an arm's hardly have; empty where they have not.
  virtual std::string_view reversal(const Effect& /*effect*/) const { return {}; }
  /// The same effect as it cannot be, to be tried as a control; none where there is no such thing.
  virtual std::optional<DecoyEffect> decoy(const Effect& effect, const Evidence& evidence) const;
  /// Whether it is nothing beyond the measured range, on average: a ripple. Others go on from what they are at its end.
  virtual bool fades(const Effect& /*effect*/) const { return false; }
  /// Of a motion of its joint by one joint's value alone; nothing of others.
  virtual std::optional<HeldMotion> held_motion(const Effect& /*effect*/) const { return std::nullopt; }
  /// By how much what it adds to its own joint's motion may be off with the joint there, since the poses did not tell
  /// where it changes; rad or m.
  virtual double unsure_motion(const Effect& /*effect*/, double /*joint*/) const { return 0.0; }
  /// The joints whose value it depends on and beyond whose measured range it is not known.
  virtual std::vector<int> ranged_joints(const Effect& /*effect*/, const Robot& /*robot*/) const { return {}; }
  /// Appends the unit motions as expressions of the joints (effects/symbolic_state.hpp); nothing where the effect
  /// depends on more than the joints.
  virtual void append_symbolic_motions(SymbolicWriter& /*motions*/) const {}
};

struct DecoyEffect {
  Effect effect;
  DecoyKind kind = DecoyKind::none;
};

/// Over which a ripple fades out beyond the joints it was measured at, rad or m.
inline constexpr double kFade = 0.1;

/// All laws, in the catalogue's order.
const std::vector<const EffectLaw*>& catalogue();
/// The law of a kind; null where there is none.
const EffectLaw* find_law(std::string_view kind);
/// The law of an effect, which must be of the catalogue.
const EffectLaw& law_of(const Effect& effect);

/// The kind of effects outside the catalogue's names, which formulas describe.
std::string_view symbolic_kind();
bool is_symbolic(const Effect& effect);
/// One of a joint, its formula still to be set.
Effect symbolic_effect(int joint, const std::string& form = {});
/// What the formula of a symbolic effect may speak of: q1 .. qn (rad or m), and of its own joint tau (Nm or N, of
/// gravity), s (approach sign) and T (K above the setting reference_celsius).
VariableNames symbolic_variables(const Chain& chain);

/// What a unit of each coefficient does at `state`. Outside the ranges the effect was measured in it is what it is at
/// their nearer end, and of a revolute joint goes over to what it is at the other end, across the part of the turn that
/// was not measured, without a jump; a ripple fades to nothing within 0.1 rad (or m).
void append_unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                         std::vector<UnitMotion>& motions);

/// 1 inside the ranges, 0 beyond 0.1 rad (m) from them, smooth between. Whole turns of revolute joints do not count.
double known_share(const Effect& effect, const Chain& chain, const JointVector& joints);

}  // namespace demecal::inline effects
