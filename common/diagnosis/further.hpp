// Which measurement would tell an effect from its rivals, and how much of it that takes.
#pragma once

#include <optional>
#include <vector>

#include "diagnosis/diagnosed_model.hpp"
#include "diagnosis/outcome.hpp"
#include "random/random_stream.hpp"

namespace demecal {

/// The measurement that tells `named` (with its values) from the rival that is hardest to tell from it, in the fewest
/// stops of the arm; among about equals the simplest. Of each kind of measurement hypothetical stops are drawn, and
/// what the model and the rival cannot imitate there of what `named` does is summed up, all that the poses at hand know
/// of their numbers being known beforehand: so many poses are asked for that these by themselves decide, one-sided at 5
/// %, with power 0.9. A rival that contains the named effect is held against it by the rest of its coefficients. Rivals
/// that 10000 poses of no kind would split off are said to be such; where there are no others, the number of poses is
/// 0. Nothing where there are no rivals, or where `named` does nothing.
std::optional<FurtherMeasurement> further_measurement(const DiagnosisData& of, const DiagnosedModel& model,
                                                      const Effect& named, const std::vector<Rival>& rivals,
                                                      RandomStream random);

/// "coupling of joint 3 (from joint 2)": an effect as a sentence speaks of it.
std::string words_for(const Effect& effect);

}  // namespace demecal
