#include "expression/node_store.hpp"

#include <algorithm>
#include <bit>

#include "errors/check.hpp"

namespace demecal::inline expression {
namespace {

std::uint64_t mixed(std::uint64_t bits) {
  bits *= 0x9e3779b97f4a7c15;
  return bits ^ bits >> 32;
}

// What distinguishes a node from others: primitive and variable, and arguments or the constant's bits.
std::uint64_t content_of(const SharedNode& node) {
  if (node.primitive == Primitive::constant) return std::bit_cast<std::uint64_t>(node.value);
  return static_cast<std::uint64_t>(node.left) << 32 | node.right;
}
std::uint64_t label_of(const SharedNode& node) {
  return static_cast<std::uint64_t>(node.primitive) << 8 | node.variable;
}
std::uint64_t node_hash(const SharedNode& node) {
  return mixed(mixed(content_of(node)) + label_of(node));
}
bool are_equal(const SharedNode& a, const SharedNode& b) {
  return content_of(a) == content_of(b) && label_of(a) == label_of(b);
}
bool is_within_limits(int nodes, int depth) {
  return nodes <= 65535 && depth <= 255;
}
// Apart from those that are called often, which it would make long.
[[gnu::noinline]] void fail_limits(int nodes, int depth) {
  DEMECAL_CHECK(is_within_limits(nodes, depth), "nodes=" << nodes << " depth=" << depth);
}

TreeExtent extent_above(const TreeExtent& a, const TreeExtent& b) {
  const int nodes = 1 + a.nodes + b.nodes;
  const int depth = 1 + std::max(a.depth, b.depth);
  if (!is_within_limits(nodes, depth)) fail_limits(nodes, depth);
  return {static_cast<std::uint16_t>(nodes), static_cast<std::uint16_t>(a.terminals + b.terminals),
          static_cast<std::uint8_t>(depth)};
}

std::uint32_t tag_of(std::uint64_t hash) {
  return static_cast<std::uint32_t>(hash >> 32);
}

}  // namespace

NodeStore::NodeStore() : nodes_(1), slots_(1024) {}

std::size_t NodeStore::bytes() const {
  return nodes_.capacity() * sizeof(SharedNode) + slots_.capacity() * sizeof(Slot) + marked_.capacity() +
         (free_.capacity() + dropped_.capacity() + stack_.capacity()) * sizeof(NodeId);
}

NodeId NodeStore::store(const SharedNode& node, std::uint64_t hash) {
  const std::size_t mask = slots_.size() - 1;
  const std::uint32_t tag = tag_of(hash);
  std::size_t place = hash & mask;
  for (; slots_[place].id != 0; place = (place + 1) & mask)
    if (slots_[place].tag == tag && are_equal(nodes_[slots_[place].id], node)) return slots_[place].id;
  NodeId id = static_cast<NodeId>(nodes_.size());
  if (free_.empty()) {
    nodes_.push_back(node);
  } else {
    id = free_.back();
    free_.pop_back();
    nodes_[id] = node;
  }
  slots_[place] = {id, tag};
  if (node.left != 0) ++functions_made_;
  if (4 * size() > 3 * slots_.size()) grow_table();
  return id;
}

void NodeStore::enter_in_table(NodeId id) {
  const std::size_t mask = slots_.size() - 1;
  const std::uint64_t hash = node_hash(nodes_[id]);
  std::size_t place = hash & mask;
  while (slots_[place].id != 0) place = (place + 1) & mask;
  slots_[place] = {id, tag_of(hash)};
}

void NodeStore::grow_table() {
  slots_.assign(2 * slots_.size(), Slot{});
  for (NodeId id = 1; id < nodes_.size(); ++id)
    if (nodes_[id].whole.nodes > 0) enter_in_table(id);
}

NodeId NodeStore::terminal(const Node& node) {
  SharedNode shared;
  shared.primitive = node.primitive;
  shared.variable = node.variable;
  shared.value = node.value;
  shared.is_constant = node.primitive == Primitive::constant;
  shared.whole = {1, 1, 0};
  return store(shared, node_hash(shared));
}

NodeId NodeStore::function(Primitive primitive, NodeId left, NodeId right) {
  const SharedNode& a = nodes_[left];
  const SharedNode& b = nodes_[right];
  SharedNode shared;
  shared.primitive = primitive;
  shared.left = left;
  shared.right = right;
  shared.whole = extent_above(a.whole, b.whole);
  shared.of_left = a.whole;
  shared.depth_of_right = b.whole.depth;
  shared.is_constant = a.is_constant && (right == 0 || b.is_constant);
  if (shared.is_constant)
    shared.value = right == 0 ? value_of(primitive, a.value) : value_of(primitive, a.value, b.value);
  return store(shared, node_hash(shared));
}

NodeId NodeStore::enter(std::span<const Node> tree) {
  stack_.clear();
  for (std::size_t i = tree.size(); i-- > 0;) {
    const Primitive primitive = tree[i].primitive;
    if (arity(primitive) == 0) {
      stack_.push_back(terminal(tree[i]));
      continue;
    }
    const NodeId left = stack_.back();
    if (arity(primitive) == 2) stack_.pop_back();
    stack_.back() = arity(primitive) == 2 ? function(primitive, left, stack_.back()) : function(primitive, left);
  }
  return stack_.back();
}

void NodeStore::append(NodeId id, Tree& tree) const {
  std::vector<NodeId> left_to_do{id};
  while (!left_to_do.empty()) {
    const SharedNode& node = nodes_[left_to_do.back()];
    left_to_do.pop_back();
    tree.push_back({node.primitive, node.variable, node.primitive == Primitive::constant ? node.value : 0.0});
    if (node.right != 0) left_to_do.push_back(node.right);
    if (node.left != 0) left_to_do.push_back(node.left);
  }
}

Tree NodeStore::tree(NodeId id) const {
  Tree tree;
  tree.reserve(nodes_[id].whole.nodes);
  append(id, tree);
  return tree;
}

void NodeStore::mark(std::span<const NodeId> roots) {
  if (marked_.size() < nodes_.size()) marked_.resize(nodes_.size());
  std::fill(marked_.begin(), marked_.end(), std::uint8_t{0});
  stack_.assign(roots.begin(), roots.end());
  while (!stack_.empty()) {
    const NodeId id = stack_.back();
    stack_.pop_back();
    if (marked_[id] != 0) continue;
    marked_[id] = 1;
    if (nodes_[id].left != 0) stack_.push_back(nodes_[id].left);
    if (nodes_[id].right != 0) stack_.push_back(nodes_[id].right);
  }
}

std::span<const NodeId> NodeStore::collect(std::span<const NodeId> roots) {
  mark(roots);
  dropped_.clear();
  std::fill(slots_.begin(), slots_.end(), Slot{});
  for (NodeId id = 1; id < nodes_.size(); ++id) {
    if (nodes_[id].whole.nodes == 0) continue;
    if (marked_[id] != 0) {
      enter_in_table(id);
    } else {
      nodes_[id] = {};
      dropped_.push_back(id);
    }
  }
  for (std::size_t i = dropped_.size(); i-- > 0;) free_.push_back(dropped_[i]);
  return dropped_;
}

}  // namespace demecal::inline expression
