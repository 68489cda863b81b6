// What may be wrong with a data set as a whole: each explanation changes how the arm or its poses are read.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "data_check/finding.hpp"
#include "data_check/trial_fit.hpp"

namespace demecal {

/// One way to read the data otherwise than they are given.
struct Explanation {
  FindingKind kind = FindingKind::joint_sign;
  int joint = -1;      ///< from 0; -1: of no joint
  std::string clause;  ///< what fits: "joint 3 is taken with the other sign"
  std::function<void(Trial&)> apply;
};

/// Signs and offsets of 90 and 180 degrees of every joint, both together, pairs of joints exchanged, units of angles
/// and lengths, the other Denavit-Hartenberg convention, mirrored positions, and joints reported as sums with the one
/// before: the likelier of those that can mean the same come first.
std::vector<Explanation> whole_set_explanations(const Chain& chain);

/// An explanation (or several together) and how well the arm fits with it.
struct Explained {
  std::vector<Explanation> explanations;
  TrialFit fit;
  std::vector<Explanation> equals{};  ///< others, each by itself, that fit as well: the points cannot tell
};

/// The explanation by which the trial fits best; of equals the first. Of those that leave more than `good_m` at the
/// median, pairs of joint explanations and, one after the other, up to four are tried too. `placed`: the trial's own
/// fit of base and tools. Nothing where none lowers its median.
std::optional<Explained> best_explanation(const Trial& trial, const TrialFit& placed, double good_m);

}  // namespace demecal
