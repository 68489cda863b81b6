// Changes that fit poses in a base's own frame alike: which of them the description of tool and base speaks for.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trials/explanations.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {

/// One of several changes that fit alike.
struct AlikeReading {
  Explanation change;
  double distance_m = 0.0;  ///< of tool and base from their description
};

/// `alike` by how far tool and base then stand from their description, as `distance_m` says (infinity of what does not
/// fit, which is left out); those within `same_m` of the nearest stay in their order. Where the nearest stands where it
/// is described, those that stand clearly farther are left out: they turn the base to make up for what they change.
std::vector<AlikeReading> nearest_to_description(const std::vector<Explanation>& alike,
                                                 const std::function<double(const Explanation&)>& distance_m,
                                                 double same_m);

/// "As well, and these poses cannot tell which, it fits if ...": of all but the first, with where tool and base stand
/// if it is farther from their description than by the first.
std::vector<std::string> as_well_sentences(const std::vector<AlikeReading>& readings, double same_m);

}  // namespace demecal::inline data_check
