#include "expression/constant_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "errors/check.hpp"

namespace demecal::inline expression {
namespace {

constexpr std::size_t kRowsOfModel = 128;  // the columns of a formula's parts and their slopes stay in the near caches

bool is_number(const SharedNode& node) {
  return node.is_constant && std::isfinite(node.value);
}

// What is left of a formula once terms and factors that are constant are taken off its root.
NodeId core_of(const NodeStore& store, NodeId root) {
  for (;;) {
    const SharedNode& node = store[root];
    const bool linear = node.primitive == Primitive::add || node.primitive == Primitive::subtract ||
                        node.primitive == Primitive::multiply;
    if (node.is_constant || node.right == 0) return root;
    if (linear && is_number(store[node.left])) {
      root = node.right;
    } else if ((linear || node.primitive == Primitive::divide) && is_number(store[node.right])) {
      root = node.left;
    } else {
      return root;
    }
  }
}

ColumnStep step_for(Primitive primitive, const Operand& left, const Operand& right, double* out) {
  return arity(primitive) == 1 ? make_step(primitive, left, out, false) : make_step(primitive, left, right, out, false);
}

}  // namespace

ConstantModel::ConstantModel(Columns columns)
    : columns_(columns),
      strip_rows_(std::min(kRowsOfModel, columns_.padded_rows())),
      pool_(strip_rows_, std::numeric_limits<std::size_t>::max()),
      ones_(strip_rows_, 1.0),
      zeros_(strip_rows_, 0.0) {}

std::size_t ConstantModel::rows_at(std::size_t begin) const {
  return std::min(strip_rows_, columns_.padded_rows() - begin);
}

TreeExtent ConstantModel::extent(const NodeStore& store, NodeId root, Scaling scaling) {
  TreeExtent extent = store[scaling == Scaling::linear ? core_of(store, root) : root].whole;
  if (scaling == Scaling::none) return extent;
  extent.nodes = static_cast<std::uint16_t>(extent.nodes + 4);
  extent.terminals = static_cast<std::uint16_t>(extent.terminals + 2);
  extent.depth = static_cast<std::uint8_t>(extent.depth + 2);
  return extent;
}

double* ConstantModel::take_column() {
  double* const column = pool_.take();
  taken_.push_back(column);
  return column;
}

double* ConstantModel::take_column(double fill) {
  double* const column = take_column();
  std::fill_n(column, strip_rows_, fill);
  return column;
}

void ConstantModel::bind(const NodeStore& store, NodeId root, Scaling scaling) {
  for (std::size_t i = taken_.size(); i-- > 0;) pool_.release(taken_[i]);
  taken_.clear();
  parts_.clear();
  constants_.clear();
  constant_columns_.clear();
  fixed_steps_.clear();
  varying_steps_.clear();
  jumps_ = fixed_known_ = varying_known_ = false;
  if (scaling == Scaling::none) {
    decompose(store, root);
  } else {
    const std::uint32_t offset = add_constant(0, 0.0), factor = add_constant(0, 1.0);
    decompose(store, core_of(store, root));
    const auto core = static_cast<std::uint32_t>(parts_.size() - 1);
    add_function(Primitive::add, offset, add_function(Primitive::multiply, factor, core, 0), 0);
  }
  backpropagate();
}

void ConstantModel::decompose(const NodeStore& store, NodeId root) {
  if (known_.size() < store.end()) known_.resize(store.end());
  ++formula_;
  stack_.assign(1, root);
  while (!stack_.empty()) {
    const NodeId id = stack_.back() & ~kArgumentsPushed;
    const bool expanded = stack_.back() != id;
    stack_.pop_back();
    const SharedNode& node = store[id];
    if (expanded) {
      known_[id] = {formula_, static_cast<std::uint32_t>(parts_.size())};
      add_function(node.primitive, known_[node.left].part, node.right != 0 ? known_[node.right].part : 0, id);
    } else if (known_[id].formula == formula_) {
      continue;
    } else if (node.is_constant || node.left == 0) {
      known_[id] = {formula_, static_cast<std::uint32_t>(parts_.size())};
      add_leaf(node, id);
    } else {
      stack_.push_back(id | kArgumentsPushed);
      if (node.right != 0) stack_.push_back(node.right);
      stack_.push_back(node.left);
    }
  }
}

void ConstantModel::add_leaf(const SharedNode& node, NodeId id) {
  if (is_number(node)) {
    add_constant(id, node.value);
    return;
  }
  Part part;
  part.id = id;
  part.primitive = node.primitive;
  part.value = node.is_constant ? Operand{take_column(node.value), 0.0, false}
                                : Operand{columns_.column(node.variable), 0.0, true};
  parts_.push_back(part);
}

std::uint32_t ConstantModel::add_constant(NodeId id, double value) {
  Part part;
  part.id = id;
  part.varies = true;
  part.constant = static_cast<std::uint32_t>(constants_.size());
  double* const column = take_column(value);
  part.value = {column, 0.0, false};
  constants_.push_back(value);
  constant_columns_.push_back(column);
  parts_.push_back(part);
  return static_cast<std::uint32_t>(parts_.size() - 1);
}

std::uint32_t ConstantModel::add_function(Primitive primitive, std::uint32_t left, std::uint32_t right, NodeId id) {
  Part part;
  part.id = id;
  part.primitive = primitive;
  part.left = left;
  part.right = right;
  part.varies = parts_[left].varies || (arity(primitive) == 2 && parts_[right].varies);
  double* const out = take_column();
  part.value = {out, 0.0, false};
  (part.varies ? varying_steps_ : fixed_steps_)
      .push_back(step_for(primitive, parts_[left].value, parts_[right].value, out));
  parts_.push_back(part);
  return static_cast<std::uint32_t>(parts_.size() - 1);
}

void ConstantModel::set(std::span<const double> constants) {
  DEMECAL_CHECK(constants.size() == constants_.size(), constants.size() << " of " << constants_.size());
  for (std::size_t i = 0; i < constants.size(); ++i) std::fill_n(constant_columns_[i], strip_rows_, constants[i]);
  varying_known_ = false;
}

const double* ConstantModel::values(std::size_t begin) {
  const std::size_t rows = rows_at(begin);
  const bool same_rows = begin == begin_;
  if (!fixed_known_ || !same_rows) run(fixed_steps_, begin, rows);
  if (!varying_known_ || !same_rows) run(varying_steps_, begin, rows);
  begin_ = begin;
  fixed_known_ = varying_known_ = true;
  const Operand& value = parts_.back().value;
  return value.column + (value.whole ? begin : 0);
}

NodeId ConstantModel::rebuilt(NodeStore& store, std::span<const double> constants) {
  rebuilt_.clear();
  for (const Part& part : parts_) {
    if (!part.varies)
      rebuilt_.push_back(part.id);
    else if (arity(part.primitive) == 0)
      rebuilt_.push_back(store.terminal({Primitive::constant, 0, constants[part.constant]}));
    else if (arity(part.primitive) == 1)
      rebuilt_.push_back(store.function(part.primitive, rebuilt_[part.left]));
    else
      rebuilt_.push_back(store.function(part.primitive, rebuilt_[part.left], rebuilt_[part.right]));
  }
  return rebuilt_.back();
}

}  // namespace demecal::inline expression
