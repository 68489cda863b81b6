#include "structure/genome.hpp"

#include <algorithm>

#include "errors/check.hpp"

namespace demecal::inline structure {
namespace {

Gene random_gene(RandomStream& random) {
  const bool rotates = random.chance(0.5);
  return {rotates, static_cast<int>(random.index(3))};
}

auto at(GeneSection& section, std::size_t place) {
  return section.begin() + static_cast<std::ptrdiff_t>(place);
}

}  // namespace

Genome random_genome(int links, RandomStream& random) {
  Genome genome(static_cast<std::size_t>(links));
  for (GeneSection& section : genome) {
    const std::size_t length = random.index(kLongestSection + 1);
    for (std::size_t i = 0; i < length; ++i) section.push_back(random_gene(random));
  }
  return genome;
}

Genome crossed(const Genome& a, const Genome& b, RandomStream& random) {
  DEMECAL_CHECK(a.size() == b.size(), a.size() << " and " << b.size() << " sections");
  Genome child(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool a_first = random.chance(0.5);
    const GeneSection &first = a_first ? a[i] : b[i], &last = a_first ? b[i] : a[i];
    const auto head = static_cast<std::ptrdiff_t>(random.index(first.size() + 1));
    const auto tail = static_cast<std::ptrdiff_t>(random.index(last.size() + 1));
    child[i].assign(first.begin(), first.begin() + head);
    child[i].insert(child[i].end(), last.begin() + tail, last.end());
    if (child[i].size() > kLongestSection) child[i].resize(kLongestSection);
  }
  return child;
}

Genome mutated(Genome genome, RandomStream& random) {
  GeneSection& section = genome[random.index(genome.size())];
  const std::size_t kind = random.index(3);
  const bool grows = section.empty() || (kind == 0 && section.size() < kLongestSection);
  if (grows) {
    section.insert(at(section, random.index(section.size() + 1)), random_gene(random));
  } else if (kind == 1) {
    section.erase(at(section, random.index(section.size())));
  } else {
    section[random.index(section.size())] = random_gene(random);
  }
  return genome;
}

Genome expressed(const Genome& genome) {
  Genome result = genome;
  for (GeneSection& section : result) section.erase(std::unique(section.begin(), section.end()), section.end());
  return result;
}

std::size_t gene_count(const Genome& genome) {
  std::size_t count = 0;
  for (const GeneSection& section : genome) count += section.size();
  return count;
}

}  // namespace demecal::inline structure
