// Formulas that share their equal subtrees: every different subtree is one node, known by a number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "expression/tree.hpp"
#include "primitives/columns.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline expression {

/// The number of a node in its store, from 1: the formula whose root it is.
using NodeId = std::uint32_t;
/// Set on the stack of a walk beside the number of a node whose arguments have been pushed.
inline constexpr NodeId kArgumentsPushed = NodeId{1} << 31;

/// How large a formula is as a tree.
struct TreeExtent {
  std::uint16_t nodes = 0;      ///< 0 where there is no formula
  std::uint16_t terminals = 0;  ///< those of them that are terminals
  std::uint8_t depth = 0;

  std::uint32_t functions() const { return static_cast<std::uint32_t>(nodes - terminals); }
};

/// A node with its arguments, and the extents of the formulas below it: ways down read one node a level.
struct SharedNode {
  double value = 0.0;          ///< where is_constant, of the whole formula
  NodeId left = 0, right = 0;  ///< arguments; 0 where there is none
  TreeExtent whole;            ///< of the formula whose root this is
  TreeExtent of_left;          ///< of the first argument
  std::uint8_t depth_of_right = 0;
  Primitive primitive = Primitive::constant;
  std::uint8_t variable = 0;
  bool is_constant = false;  ///< no variable below it
};
static_assert(sizeof(SharedNode) == 32);

/// Hash-consed nodes: equal formulas, to the bit, have equal numbers, whatever their hashes. Nodes stay until collect()
/// finds them out of use.
class NodeStore {
 public:
  NodeStore();

  const SharedNode& operator[](NodeId id) const { return nodes_[id]; }
  /// All numbers so far are below this one.
  std::size_t end() const { return nodes_.size(); }
  /// How many nodes are stored.
  std::size_t size() const { return nodes_.size() - 1 - free_.size(); }
  /// How many functions were stored since the store was made, those collected since then included.
  std::uint64_t functions_made() const { return functions_made_; }
  std::size_t bytes() const;

  NodeId terminal(const Node& node);
  NodeId function(Primitive primitive, NodeId argument) { return function(primitive, argument, 0); }
  /// A formula may have up to 65535 nodes and a depth up to 255.
  NodeId function(Primitive primitive, NodeId left, NodeId right);
  /// The number of a valid tree.
  NodeId enter(std::span<const Node> tree);

  /// Puts a formula in prefix order at the end of `tree`.
  void append(NodeId id, Tree& tree) const;
  Tree tree(NodeId id) const;

  /// Drops every node that is no part of the formulas `roots`. Returns the numbers dropped, which new nodes will take;
  /// valid until the next call.
  std::span<const NodeId> collect(std::span<const NodeId> roots);

 private:
  struct Slot {
    NodeId id = 0;  ///< 0 where empty
    std::uint32_t tag = 0;
  };
  NodeId store(const SharedNode& node, std::uint64_t hash);
  void grow_table();
  void enter_in_table(NodeId id);
  void mark(std::span<const NodeId> roots);

  std::vector<SharedNode, LineAligned<SharedNode>> nodes_;
  std::vector<Slot> slots_;  ///< open addressing, at most three quarters full
  std::vector<NodeId> free_, dropped_, stack_;
  std::vector<std::uint8_t> marked_;
  std::uint64_t functions_made_ = 0;
};

}  // namespace demecal::inline expression
