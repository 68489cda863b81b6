// Which effect a case gets, and how large: by what these poses could show, never by what the loop finds.
#pragma once

#include <optional>
#include <vector>

#include "case_plan.hpp"
#include "diagnosis/outcome.hpp"
#include "random/random_stream.hpp"

namespace demecal::bench {

/// An effect of `kind` at a random joint of those at which `detectable` names it: coefficients in a random direction,
/// their length 2 to 4 times its smallest detectable one. Ratios are whole numbers from 10 to 160, other joints and
/// orders are drawn. A coupling that turns with the other joint, and a formula, move their joint as widely as the
/// linear coupling that they are measured by would. Joints at which it would go more than 10 mrad (10 mm) at any
/// of `states` are passed over: no arm does. Nothing where no joint is left.
std::optional<Effect> draw_truth(const std::string& kind, const std::vector<NotFound>& detectable, const Robot& robot,
                                 const std::vector<ArmState>& states, RandomStream& random);

/// The effects of a case: one, or two of different kinds for pairs; fewer where nothing could be drawn.
std::vector<Effect> draw_truths(const std::string& kind, const std::vector<NotFound>& detectable, const Robot& robot,
                                const std::vector<ArmState>& states, RandomStream& random);

}  // namespace demecal::bench
