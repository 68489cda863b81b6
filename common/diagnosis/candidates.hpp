// The effects that are tried in every round: what the data can show, and decoys that cannot be true.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "diagnosis/outcome.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "parameters/declared_model.hpp"
#include "random/random_stream.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline diagnosis {

/// Joints that move less (rad or m) say nothing of a formula's shape.
inline constexpr double kLeastMotion = 0.05;

/// The evidence of `poses`. A circumstance counts where every pose has it and not all poses have the same; a joint's
/// approach where it came from both sides.
Evidence evidence_of(const DataSet& data, std::span<const std::size_t> poses);

/// The kinds of `kinds` (empty: all) that such data cannot show, each with the reason.
std::vector<UntestableKind> untestable_kinds(const Evidence& evidence, const std::vector<std::string>& kinds);

struct Candidate {
  Effect effect;
  DecoyKind decoy_kind = DecoyKind::none;
  double naming_cost_nats = 0.0;  ///< the price of naming it: log of the number of its kind and form
  bool evolved = false;           ///< a formula that a search found in the very data it is tried on
};

/// What a formula without a physical name must explain beyond an effect that has a name, nats.
inline constexpr double kOutsideCatalogue_nats = 5.0;

struct CandidateOptions {
  std::vector<std::string> kinds;  ///< words of the catalogue; empty: all
  bool formulas = true;            ///< formulas outside the catalogue compete too
  bool decoys = true;
  bool last_resort = false;  ///< the laws that are one, and no others
};

/// All proposals of the laws within the evidence, ranges of validity set, less what is declared already, and decoys:
/// gear harmonics at ratios that no gear has, backlash by shuffled approach signs, thermal offsets by shuffled
/// temperatures.
std::vector<Candidate> candidates_for(const Robot& robot, const Evidence& evidence, const DeclaredModel& declared,
                                      const CandidateOptions& options);

/// Per candidate, whether it is no decoy and of the same law as one of the effects.
std::vector<bool> candidates_among(const std::vector<Candidate>& candidates, std::span<const Effect> effects);

/// The price of an effect among candidates; 0 where it is none of them.
double naming_cost_nats(const Effect& effect, const std::vector<Candidate>& candidates);

/// The evidence's ranges of the joints on whose values the effect depends: beyond them it is not known.
void set_measured_ranges(Effect& effect, const Robot& robot, const Evidence& evidence);

/// The states that a decoy sees: `states` with approach signs or temperatures dealt out anew over the poses.
std::vector<ArmState> with_shuffled(const std::vector<ArmState>& states, DecoyKind decoy_kind, RandomStream random);

/// The states of decoys: with sides and with temperatures dealt out anew.
struct DecoyStates {
  std::vector<ArmState> sides, heat;
};

/// The candidates' effects at the states that they see, which must outlive them.
std::vector<SampledEffect> sampled_effects(const std::vector<Candidate>& candidates,
                                           const std::vector<ArmState>& states, const DecoyStates& of_decoys);

/// "gear_harmonic of joint 2 at ratio 347.3", for people.
std::string decoy_name(const Candidate& candidate);

/// What it costs to name each of them.
std::vector<double> naming_costs_nats(const std::vector<Candidate>& candidates);

/// Symbolic effects of every revolute joint: sines and cosines of m q_a + n q_b and of q_a +- q_b +- q_c, the same
/// waves with a phase that is to be found, products of joint values with each other and with sines and cosines, and
/// what the approach sign, the warming and gravity's torque multiply. Only circumstances that the evidence holds and
/// joints that move take part. What evolution finds most often where it is let loose, tried without evolving.
std::vector<Effect> formula_library(const Robot& robot, const Evidence& evidence);

}  // namespace demecal::inline diagnosis
