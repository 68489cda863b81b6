// Finds equal trees among many, so that none is made or evaluated twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "expression/tree.hpp"

namespace demecal {

/// A hash table of trees that stay where they are, compared to the bit: whether two trees are found equal never depends
/// on their hashes.
class TreeIndex {
 public:
  /// `most`: how many trees may be entered.
  explicit TreeIndex(std::size_t most) { clear(most); }

  void clear(std::size_t most);
  /// The number of an equal tree entered before; otherwise enters `tree` under `number` and returns that. An entered
  /// tree must neither move nor change until the next clear().
  std::size_t enter(const Tree& tree, std::size_t number);

 private:
  struct Slot {
    std::uint64_t hash = 0;
    const Tree* tree = nullptr;
    std::size_t number = 0;
  };
  std::vector<Slot> slots_;
};

}  // namespace demecal
