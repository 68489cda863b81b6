// The causes of an arm's errors: what people call them, how common they are, and how far they move an arm at most.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "effects/effect.hpp"

namespace demecal::inline effects {

/// What engineers count as one cause, however many effects it takes to describe it; of each joint, or of the whole arm.
enum class CauseGroup {
  transmission,
  encoder,
  lost_motion,
  elasticity,
  balance_spring,
  bearing,
  link_geometry,
  zero,
  tool,
  heat,
  instrument,
  formula
};

struct Cause {
  std::string_view kind;          ///< a word of the catalogue
  std::string_view words;         ///< for people, "of joint 2" may follow: "link geometry"
  double largest_turn_rad = 0.0;  ///< of a joint, link or mounting, anywhere among the poses; more is no arm's error
  double largest_shift_m = 0.0;
  CauseGroup group = CauseGroup::formula;
  int place_among_limits = 0;  ///< in lists of what was not found: what an engineer asks for first
};

/// Every kind of the catalogue, the most common cause first.
std::span<const Cause> causes();
/// The cause of that kind, which must be of the catalogue.
const Cause& cause_of(std::string_view kind);
/// Its place in causes(); their number where it is none of them.
std::size_t rarity(std::string_view kind);
/// Cause::place_among_limits, the last for other kinds.
int place_among_limits(std::string_view kind);
/// Whether the kind's effects are harmonics of a joint's turn, of which a model may hold many.
bool is_harmonic(std::string_view kind);

}  // namespace demecal::inline effects
