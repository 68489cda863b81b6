// What the closed loop could not find or not see, and how its controls fared, in a terminal's lines.
#pragma once

#include <string>

#include "diagnosis/outcome.hpp"

namespace demecal {

/// One line for each of a few kinds that people ask for first: "no backlash: joint 2 below 8 arcsec", or between which
/// limits where several places were searched.
std::string not_found_lines(const LoopOutcome& loop, const Robot& described);

/// One paragraph of effects that only an implausible size would show.
std::string untestable_line(const LoopOutcome& loop);

/// One paragraph of the kinds that these data cannot show, by reason.
std::string unseen_line(const LoopOutcome& loop);

/// How measurements scatter together, in one line; nothing where all poses are independent.
std::string noise_line(const LoopOutcome& loop);

/// Whether a decoy won, or explains more than noise should, in one line.
std::string decoys_line(const LoopOutcome& loop);

}  // namespace demecal
