// What to measure next: to tell an effect from its rivals, and to know the model better.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal::inline next_measurement {

/// An effect that these poses cannot tell from the named one, or hardly.
struct Rival {
  Effect effect;
  double cosine = 0.0;       ///< between what either would explain, beyond the model
  double nats_behind = 0.0;  ///< description length that it leaves above the named one's
};

/// The measurement that would split an effect from its rivals.
struct NextMeasurement {
  std::string sentence;  ///< what to measure, for a person
  int poses = 0;         ///< how many give power 0.9
};

/// The measurement that tells `named` (with its values) from the rival that is hardest to tell from it, in the fewest
/// stops of the arm; among about equals the simplest. Of each kind of measurement hypothetical stops are drawn, and
/// what the model and the rival cannot imitate there of what `named` does is summed up, all that the poses at hand know
/// of their numbers being known beforehand: so many poses are asked for that these by themselves decide, one-sided at 5
/// %, with power 0.9. A rival that contains the named effect is held against it by the rest of its coefficients. Rivals
/// that 10000 poses of no kind would split off are said to be such; where there are no others, the number of poses is
/// 0. Nothing where there are no rivals, or where `named` does nothing.
std::optional<NextMeasurement> find_next_measurement(const DiagnosisProblem& problem, const DiagnosedModel& model,
                                                     const Effect& named, const std::vector<Rival>& rivals,
                                                     RandomStream random);

/// "coupling of joint 3 (from joint 2)": an effect as a sentence speaks of it.
std::string to_string(const Effect& effect);

/// An effect and those that these poses cannot tell from it.
struct AmbiguousEffect {
  Effect effect;
  std::vector<Rival> rivals;
};

/// `count` feasible stops, the most telling first, picked greedily from a few thousand random ones so that the
/// determinant of what is then known of the coefficients of `ambiguous` effects and their rivals is largest
/// (D-optimality), given what the poses at hand know; where there are none, of all numbers of the model. Payloads are
/// those recorded, approaches from both sides where they were recorded; temperature and time are left open. Joints keep
/// 2 % off their limits.
std::vector<Stop> propose_poses(const DiagnosisProblem& problem, const DiagnosedModel& model,
                                const std::vector<AmbiguousEffect>& ambiguous, int count, RandomStream random);

}  // namespace demecal::inline next_measurement
