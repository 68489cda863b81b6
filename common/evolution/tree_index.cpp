#include "evolution/tree_index.hpp"

#include <bit>

namespace demecal {
namespace {

std::uint64_t hash_of(const Tree& tree) {
  std::uint64_t hash = tree.size();
  for (const Node& node : tree) {
    const auto label = static_cast<std::uint64_t>(node.primitive) << 8 | node.variable;
    hash = (hash ^ std::bit_cast<std::uint64_t>(node.value) ^ label << 40) * 0x9E3779B97F4A7C15ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

}  // namespace

void TreeIndex::clear(std::size_t most) {
  slots_.assign(std::bit_ceil(2 * most + 2), Slot{});
}

std::size_t TreeIndex::enter(const Tree& tree, std::size_t number) {
  const std::uint64_t hash = hash_of(tree);
  const std::size_t mask = slots_.size() - 1;
  std::size_t place = hash & mask;
  for (; slots_[place].tree != nullptr; place = (place + 1) & mask)
    if (slots_[place].hash == hash && *slots_[place].tree == tree) return slots_[place].number;
  slots_[place] = {hash, &tree, number};
  return number;
}

}  // namespace demecal
