// Effects that are looked for only where all others left structure: one among so many places of a joint.
#pragma once

#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "diagnosis/candidates.hpp"
#include "effects/effect.hpp"
#include "parameters/declared_model.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline diagnosis {

/// What the search for one takes.
struct LastResort {
  const DiagnosisProblem& problem;
  const Evidence& evidence;
  const std::vector<std::string>& kinds;  ///< words of the catalogue; empty: all
  double family_error = 0.05;
  int null_draws = 999;
  DoWork do_work = demecal::do_work;
};

/// Adds to `known` of every joint the effect that explains most of what the model leaves, and of what its harmonics
/// were added for, many of which it takes to write a jump: between those of its finer proposals that explain
/// the same and most, at the price of naming it among all that were tried. Of no joint whose best proposal explains
/// less than a tenth of the sum of squares (of what many small causes leave, some jump always explains a little), nor
/// where noise alone explains as much more often than `family_error`. Whether anything is new.
bool add_last_resorts(const LastResort& search, const DiagnosedModel& model, const Linearization& linearization,
                      RandomStream random, std::vector<Candidate>& known);

}  // namespace demecal::inline diagnosis
