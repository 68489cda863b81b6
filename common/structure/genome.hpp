// Structures of an arm as genomes: sequences of elementary transforms that stand after its links (thesis, appendix B).
#pragma once

#include <compare>
#include <cstddef>
#include <vector>

#include "random/random_stream.hpp"

namespace demecal::inline structure {

/// An elementary transform whose amount is not yet known.
struct Gene {
  bool rotates = false;  ///< about the axis; otherwise it translates along it
  int axis = 0;          ///< 0 x, 1 y, 2 z, of the frame it stands in

  auto operator<=>(const Gene&) const = default;
};

using GeneSection = std::vector<Gene>;

/// Section i stands between link i and what follows it (from 0): before the own motion of joint i + 1, in the frame
/// whose z is its axis; the last section stands at the flange. The links themselves never change their order.
using Genome = std::vector<GeneSection>;

/// The longest section that crossover and mutation make, and that genomes begin with.
inline constexpr std::size_t kLongestSection = 5;

/// Sections of 0 to kLongestSection random genes each, one section per link.
Genome random_genome(int links, RandomStream& random);

/// Section by section, the first genes of one parent's and the last ones of the same section of the other's; the order
/// of the links cannot change. Both must have equally many sections.
Genome crossed(const Genome& a, const Genome& b, RandomStream& random);

/// With a gene put in, taken out or made another at a random place.
Genome mutated(Genome genome, RandomStream& random);

/// What a genome says: of consecutive equal genes all but the first are left out, since their amounts only add up.
Genome expressed(const Genome& genome);

/// How many genes it has.
std::size_t gene_count(const Genome& genome);

}  // namespace demecal::inline structure
