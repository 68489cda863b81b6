// The effects that are tried in every round, and those among them that cannot be true.
#pragma once

#include <string>
#include <vector>

#include "effects/effect.hpp"
#include "fitting/declared_model.hpp"
#include "random/random_stream.hpp"

namespace demecal {

struct Candidate {
  Effect effect;
  Disguise disguise = Disguise::none;
  double name_nats = 0.0;  ///< the price of naming it: log of the number of its kind and form
  bool evolved = false;    ///< a formula that a search found in the very data it is tried on
};

/// What a formula without a physical name must explain beyond an effect that has a name, nats.
inline constexpr double kOutsideCatalogue_nats = 5.0;

struct CandidateOptions {
  std::vector<std::string> kinds;  ///< words of the catalogue; empty: all
  bool formulas = true;            ///< formulas outside the catalogue compete too
  bool decoys = true;
};

/// All proposals of the laws within the evidence, ranges of validity set, less what is declared already, and decoys:
/// gear harmonics at ratios that no gear has, backlash by shuffled approach signs, thermal offsets by shuffled
/// temperatures.
std::vector<Candidate> candidates_for(const Robot& robot, const Evidence& evidence, const DeclaredModel& declared,
                                      const CandidateOptions& options);

/// The price of an effect among candidates; 0 where it is none of them.
double price_nats(const Effect& effect, const std::vector<Candidate>& candidates);

/// The evidence's ranges of the joints on whose values the effect depends: beyond them it is not known.
void set_measured_ranges(Effect& effect, const Robot& robot, const Evidence& evidence);

/// The states that a disguise sees: `states` with approach signs or temperatures dealt out anew over the poses.
std::vector<ArmState> disguised(const std::vector<ArmState>& states, Disguise disguise, RandomStream random);

/// "gear_harmonic of joint 2 at ratio 347.3", for people.
std::string decoy_name(const Candidate& candidate);

/// What it costs to name each of them.
std::vector<double> prices_nats(const std::vector<Candidate>& candidates);

}  // namespace demecal
