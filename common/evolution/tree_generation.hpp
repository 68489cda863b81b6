// Random trees: GROW, FULL, and the first population by RAMPED HALF & HALF (thesis 3.3.2, 3.3.3; Koza 1992).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "expression/shared_function.hpp"
#include "expression/tree.hpp"
#include "fitness/parameters.hpp"
#include "primitives/primitive.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline evolution {

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

/// A shared function with what drawing its calls takes.
struct CallableFunction {
  SharedFunction function;
  int depth = 0;             ///< of its body
  std::vector<int> deepest;  ///< by place: how deep it stands in the body, where it stands deepest
};

/// What random trees are made of: the terminal set T (each variable, and the ephemeral constant) and the function set
/// N, calls of shared functions among it.
struct NodeSet {
  std::vector<Primitive> functions;
  int variables = 1;
  double constants_lower = 0.0;
  double constants_upper = 1.0;
  std::vector<double> weights{};          ///< of the functions, then of the calls; empty: all alike
  std::vector<CallableFunction> calls{};  ///< what stands in a tree is what a call comes to
};

NodeSet node_set(const GpParameters& parameters, int variables);

/// Appends a random terminal to `tree`, each of T equally likely.
void append_terminal(RandomStream& random, const NodeSet& nodes, Tree& tree);
/// Appends a tree of at most `depth` to `tree`, every node above that depth drawn from T and N alike (fig. 3-4);
/// among functions by their weights. A call's coefficients are ephemeral constants, its arguments grown trees; where
/// its body is deeper than what is left, another function is drawn in its place. Returns the depth it came to.
int append_grown(RandomStream& random, const NodeSet& nodes, int depth, Tree& tree);
/// Appends a tree whose leaves all lie at `depth` to `tree` (fig. 3-5), but for those of calls that lie higher.
void append_full(RandomStream& random, const NodeSet& nodes, int depth, Tree& tree);

/// The trees of a first population: the neutral model once, then FULL and GROW in turn, going round the ramp of depths
/// from initial_max_tree_depth1 to initial_max_tree_depth2. A grown tree shallower than min_tree_depth is made anew,
/// and so is one that stands in the population already, up to invalid_attempts times.
std::vector<Tree> ramped_half_and_half(RandomStream& random, const GpParameters& parameters, int variables);

}  // namespace demecal::inline evolution
