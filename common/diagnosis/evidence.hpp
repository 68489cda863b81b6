// What a data set can show: which circumstances were recorded and varied, and how widely the joints moved.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "diagnosis/outcome.hpp"

namespace demecal {

/// The evidence of `poses`. A circumstance counts where every pose has it and not all poses have the same; a joint's
/// approach where it came from both sides.
Evidence evidence_of(const DataSet& data, std::span<const std::size_t> poses);

/// The kinds of `kinds` (empty: all) that such data cannot show, each with the reason.
std::vector<Unseen> unseen_kinds(const Evidence& evidence, const std::vector<std::string>& kinds);

}  // namespace demecal
