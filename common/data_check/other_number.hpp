// One number of an arm's links at a time, fitted with base and tool: what a few poses can tell where all of them
// together are too many.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {

struct OtherNumber {
  bool is_zero = false;  ///< of a joint; otherwise a link's length or angle
  std::string sentence;  ///< "joint 4 a_mm differs by 10.00."
  TrialFit fit;          ///< of base, tool and that number
};

/// The numbers, each by itself, with which a trial of one tool and station is off by errors (m, of each row) that are
/// accepted: that which leaves tool and base nearest to their description first, then those that do so as well.
std::vector<OtherNumber> numbers_that_explain(const Trial& trial,
                                              const std::function<bool(const std::vector<double>&)>& accepts);

}  // namespace demecal::inline data_check
