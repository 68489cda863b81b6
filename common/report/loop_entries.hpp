// What the closed loop found, as the document has it.
#pragma once

#include <optional>
#include <vector>

#include "diagnosis/outcome.hpp"
#include "report/report.hpp"

namespace demecal {

EffectEntry effect_entry(const Effect& effect, const Robot& robot);

/// The effect and its rivals at a cosine above 0.98, one of a kind and joint, the most common cause first; empty where
/// the effect has no such rival.
std::vector<ClassMember> effect_class(const EffectEntry& effect, const std::vector<RivalEntry>& rivals);

/// Sets rounds, dropped, not_found, unseen, decoys, stopped, the tests of the whole model, noise (nothing where the
/// loop did not run), candidates and permutations. `described` is the arm that the effects stand by.
void set_loop(const LoopOutcome& loop, const Robot& described, Report& report);

}  // namespace demecal
