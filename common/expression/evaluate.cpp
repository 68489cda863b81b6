#include "expression/evaluate.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "expression/tree.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline expression {
namespace {

constexpr std::size_t kRowsOfEvaluation = 256;  // so that the columns of a strip stay in the first-level cache
constexpr std::size_t kStripStride =
    kRowsOfEvaluation + kLanes;  // not a power of two, so that they share no cache sets

}  // namespace

double evaluate(std::span<const Node> tree, std::span<const double> variables) {
  return fold<double>(
      tree,
      [&](const Node& node) { return node.primitive == Primitive::constant ? node.value : variables[node.variable]; },
      [](Primitive function, double argument) { return value_of(function, argument); },
      [](Primitive function, double left, double right) { return value_of(function, left, right); });
}

// The i-th operand of the stack keeps its column in the i-th strip of the scratch memory.
Operand ColumnEvaluator::make_steps(std::span<const Node> tree) {
  steps_.clear();
  Operand* next = operands_.data();
  for (std::size_t i = tree.size(); i-- > 0;) {
    const Node& node = tree[i];
    const int taken = arity(node.primitive);
    if (taken == 0) {
      *next++ = node.primitive == Primitive::constant ? Operand{nullptr, node.value, false}
                                                      : Operand{columns_.column(node.variable), 0.0, true};
      continue;
    }
    if (taken == 2) --next;
    const Operand left = *next;
    Operand& last = *(next - 1);
    double* const out = scratch_.data() + (next - 1 - operands_.data()) * static_cast<std::ptrdiff_t>(kStripStride);
    if (last.column == nullptr && (taken == 1 || left.column == nullptr)) {
      last.constant =
          taken == 1 ? value_of(node.primitive, last.constant) : value_of(node.primitive, left.constant, last.constant);
      continue;
    }
    steps_.push_back(taken == 1 ? make_step(node.primitive, last, out, false)
                                : make_step(node.primitive, left, last, out, false));
    last = {out, 0.0, false};
  }
  return operands_.front();
}

std::span<const double> ColumnEvaluator::padded_values(std::span<const Node> tree) {
  const std::size_t most_leaves = tree.size() / 2 + 1;
  if (operands_.size() < most_leaves) {
    operands_.resize(most_leaves);
    scratch_.resize(most_leaves * kStripStride);
  }
  const Operand value = make_steps(tree);
  for (std::size_t begin = 0; begin < columns_.padded_rows(); begin += kRowsOfEvaluation) {
    const std::size_t rows = std::min(kRowsOfEvaluation, columns_.padded_rows() - begin);
    double* const out = result_.data() + begin;
    run(steps_, begin, rows);
    if (value.column == nullptr) {
      std::fill_n(out, rows, value.constant);
    } else {
      std::copy_n(value.column + (value.whole ? begin : 0), rows, out);
    }
  }
  return result_;
}

namespace {

constexpr std::size_t kMostRowsAtOnce = 512;
constexpr std::size_t kRowsOfShared = 256;  // where there are more: a few strips stay in the first-level cache

}  // namespace

SharedEvaluator::SharedEvaluator(Columns columns, std::size_t budget_bytes)
    : columns_(columns),
      strip_rows_(columns_.padded_rows() > kMostRowsAtOnce ? kRowsOfShared : columns_.padded_rows()),
      kept_(columns_.padded_rows(), budget_bytes),
      strips_(strip_rows_, std::numeric_limits<std::size_t>::max()),
      constant_strip_(strip_rows_) {}

std::size_t SharedEvaluator::bytes() const {
  return kept_.bytes() + strips_.bytes() + node_columns_.capacity() * sizeof(NodeColumn) +
         steps_.capacity() * sizeof(ColumnStep);
}

void SharedEvaluator::bind(const NodeStore& store, std::span<const NodeId> roots) {
  store_ = &store;
  ++batch_;
  if (node_columns_.size() < store.end()) node_columns_.resize(store.end());
  order_.clear();
  ends_.clear();
  for (const NodeId root : roots) {
    order_below(root);
    ends_.push_back(order_.size());
  }
  evict_columns();
  steps_.clear();
  values_.clear();
  std::size_t next = 0;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    for (; next < ends_[i]; ++next)
      bind_step(order_[next], order_[next] != roots[i] || node_columns_[roots[i]].uses > 1);
    values_.push_back(use(roots[i]));
    ends_[i] = steps_.size();
  }
}

// Appends the nodes to be computed for `root`, arguments first, and counts how often each node is used.
void SharedEvaluator::order_below(NodeId root) {
  stack_.assign(1, root);
  while (!stack_.empty()) {
    const NodeId id = stack_.back();
    stack_.pop_back();
    if ((id & kArgumentsPushed) != 0) {
      order_.push_back(id & ~kArgumentsPushed);
      continue;
    }
    const SharedNode& node = (*store_)[id];
    if (node.left == 0 || node.is_constant) continue;
    NodeColumn& cached = node_columns_[id];
    if (cached.batch == batch_) {
      ++cached.uses;
      continue;
    }
    cached.batch = batch_;
    cached.uses = 1;
    if (cached.kept != 0) continue;
    stack_.push_back(id | kArgumentsPushed);
    if (node.right != 0) stack_.push_back(node.right);
    stack_.push_back(node.left);
  }
}

// Where not all new columns can be kept, those of nodes that this batch does not need make way for those used most.
void SharedEvaluator::evict_columns() {
  fewest_uses_ = 1;
  if (kept_.available() >= order_.size() || kept_.most() == 0) return;
  std::erase_if(cached_nodes_, [&](NodeId id) {
    NodeColumn& cached = node_columns_[id];
    if (cached.batch == batch_) return false;
    drop(cached);
    return true;
  });
  fewest_uses_ = fewest_uses_for(kept_.available());
}

// The least number of uses that no more than `columns` of the nodes to be computed reach.
std::uint32_t SharedEvaluator::fewest_uses_for(std::size_t columns) const {
  std::array<std::size_t, 256> with_uses{};
  for (const NodeId id : order_) ++with_uses[std::min<std::size_t>(node_columns_[id].uses, with_uses.size() - 1)];
  std::size_t least = with_uses.size();
  for (std::size_t nodes = 0; least > 1; --least) {
    nodes += with_uses[least - 1];
    if (nodes > columns) break;
  }
  return static_cast<std::uint32_t>(least);
}

// A node as an argument, which it is once less from now on: after its last use, its strip may be lent again.
Operand SharedEvaluator::use(NodeId id) {
  const SharedNode& node = (*store_)[id];
  if (node.is_constant) return {nullptr, node.value, false};
  if (node.left == 0) return {columns_.column(node.variable), 0.0, true};
  NodeColumn& cached = node_columns_[id];
  --cached.uses;
  if (cached.uses == 0 && cached.kept == 0) strips_.release(cached.column);
  return {cached.column, 0.0, cached.kept != 0};
}

// An argument's strip may be lent again at once: a step may write to what it reads.
void SharedEvaluator::bind_step(NodeId id, bool is_wanted_again) {
  const SharedNode& node = (*store_)[id];
  const Operand left = use(node.left);
  const Operand right = node.right != 0 ? use(node.right) : Operand{};
  NodeColumn& cached = node_columns_[id];
  cached.column = is_wanted_again && cached.uses >= fewest_uses_ ? kept_.take() : nullptr;
  cached.kept = cached.column != nullptr ? 1 : 0;
  if (cached.kept != 0)
    cached_nodes_.push_back(id);
  else
    cached.column = strips_.take();
  steps_.push_back(node.right != 0 ? make_step(node.primitive, left, right, cached.column, cached.kept != 0)
                                   : make_step(node.primitive, left, cached.column, cached.kept != 0));
}

void SharedEvaluator::drop(NodeColumn& cached) {
  kept_.release(cached.column);
  cached.column = nullptr;
  cached.kept = 0;
}

void SharedEvaluator::run(const Receive& receive) {
  const std::span<const ColumnStep> steps(steps_);
  for (std::size_t begin = 0; begin < columns_.padded_rows(); begin += strip_rows_) {
    const std::size_t rows = std::min(strip_rows_, columns_.padded_rows() - begin);
    std::size_t done = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      demecal::run(steps.subspan(done, ends_[i] - done), begin, rows);
      done = ends_[i];
      const Operand& value = values_[i];
      if (value.column == nullptr) std::fill(constant_strip_.begin(), constant_strip_.end(), value.constant);
      receive(i, begin, value.column == nullptr ? constant_strip_.data() : value.column + (value.whole ? begin : 0),
              rows);
    }
  }
}

void SharedEvaluator::forget(std::span<const NodeId> dropped) {
  for (const NodeId id : dropped) {
    if (id >= node_columns_.size()) continue;
    if (node_columns_[id].kept != 0) drop(node_columns_[id]);
    node_columns_[id] = {};
  }
  std::erase_if(cached_nodes_, [&](NodeId id) { return node_columns_[id].kept == 0; });
}

}  // namespace demecal::inline expression
