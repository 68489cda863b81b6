// The causes of an arm's errors by how common they are: what people call them, and how far they move an arm at most.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace demecal {

struct Cause {
  std::string_view kind;          ///< a word of the catalogue
  std::string_view words;         ///< for people, "of joint 2" may follow: "link geometry"
  double largest_turn_rad = 0.0;  ///< of a joint, link or mounting, anywhere among the poses; more is no arm's error
  double largest_shift_m = 0.0;
};

/// Every kind of the catalogue, the most common cause first.
std::span<const Cause> causes();
/// The cause of that kind, which must be of the catalogue.
const Cause& cause_of(std::string_view kind);
/// Its place in causes(); their number where it is none of them.
std::size_t rarity(std::string_view kind);

}  // namespace demecal
