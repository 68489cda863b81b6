// One number of an arm's links at a time, fitted with base and tool: what a few poses can tell where all of them
// together are too many.
#pragma once

#include <string>
#include <vector>

#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {

struct OtherNumber {
  bool is_zero = false;  ///< of a joint; otherwise a link's length or angle
  std::string sentence;  ///< "joint 4 a_mm differs by 10.00."
  TrialFit fit;          ///< of base, tool and that number
};

/// The numbers, each by itself, with which no point of a trial of one tool and station is off by more than `most_m`:
/// that which leaves tool and base nearest to their description first, then those that do so as well.
std::vector<OtherNumber> numbers_that_explain(const Trial& trial, double most_m);

}  // namespace demecal::inline data_check
