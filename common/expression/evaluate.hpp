// The value of a formula: at one point, over all rows of a table, and of many formulas that share their subtrees.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "expression/node_store.hpp"
#include "expression/tree.hpp"
#include "primitives/columns.hpp"

namespace demecal::inline expression {

/// The value at one point; `variables[i]` is the value of variable i. The tree must be valid for as many variables.
double evaluate(std::span<const Node> tree, std::span<const double> variables);

/// Evaluates formulas over the same columns one by one, keeping its scratch memory between calls. Rows get the same
/// bits as evaluate() gives.
class ColumnEvaluator {
 public:
  /// Keeps a copy of the columns.
  explicit ColumnEvaluator(Columns columns) : columns_(columns), result_(columns_.padded_rows()) {}

  /// One value per row; valid until the next call. The tree must be valid for as many variables as there are columns.
  std::span<const double> operator()(std::span<const Node> tree) { return padded_values(tree).first(columns_.rows()); }
  /// The same with the padding: the last row's value until kLanes divides their number.
  std::span<const double> padded_values(std::span<const Node> tree);

 private:
  Operand make_steps(std::span<const Node> tree);

  PaddedColumns columns_;
  AlignedColumn result_;
  std::vector<Operand> operands_;  ///< a stack, deep enough for the largest tree so far
  std::vector<ColumnStep> steps_;
  AlignedColumn scratch_;  ///< a strip of rows for each operand
};

/// Evaluates batches of formulas of one store. Within a batch every subtree is evaluated once; its column is kept for
/// later batches as long as memory allows, those first that the batch uses most often. Other columns exist strip by
/// strip, until their last use. The values have the bits of evaluate(), whatever is kept.
class SharedEvaluator {
 public:
  /// Takes one formula's values in `rows` rows from row `begin` on; `rows` is a multiple of kLanes, so that the last
  /// row may come several times.
  using Receive = std::function<void(std::size_t formula, std::size_t begin, const double* values, std::size_t rows)>;

  /// `budget_bytes` bounds the columns kept, not the strips in work: those take 2 kB for every subtree of a batch that
  /// waits for its last use.
  SharedEvaluator(Columns columns, std::size_t budget_bytes);

  /// Finds out what is to be computed for the formulas `roots`.
  void bind(const NodeStore& store, std::span<const NodeId> roots);
  /// Computes it, strip by strip of the rows; in each, the formulas' values go to `receive` in turn.
  void run(const Receive& receive);

  /// Drops what is kept for nodes that the store dropped.
  void forget(std::span<const NodeId> dropped);

  /// How many functions run() computes over all rows.
  std::size_t functions_bound() const { return steps_.size(); }
  std::size_t bytes() const;  ///< of all memory but the variables
  std::size_t kept_bytes() const { return kept_.bytes(); }

 private:
  struct NodeColumn {
    double* column = nullptr;     ///< its own where it is kept, else a strip while it is bound
    std::uint32_t batch = 0;      ///< the last that needed the node
    std::uint32_t uses : 31 = 0;  ///< in that batch; while it is bound, those to come
    std::uint32_t kept : 1 = 0;
  };

  void order_below(NodeId root);
  void evict_columns();
  std::uint32_t fewest_uses_for(std::size_t columns) const;
  void bind_step(NodeId id, bool is_wanted_again);
  Operand use(NodeId id);
  void drop(NodeColumn& cached);

  PaddedColumns columns_;
  std::size_t strip_rows_;
  ColumnPool kept_, strips_;
  const NodeStore* store_ = nullptr;
  std::vector<NodeColumn> node_columns_;  ///< by node
  std::vector<NodeId> cached_nodes_;      ///< nodes that have a column, each once
  std::uint32_t batch_ = 0;
  std::uint32_t fewest_uses_ = 1;  ///< that a node needs to get a column of its own
  std::vector<NodeId> stack_, order_;
  std::vector<std::size_t> ends_;  ///< of each formula's nodes in order_, later of its steps
  std::vector<Operand> values_;    ///< of each formula
  std::vector<ColumnStep> steps_;
  AlignedColumn constant_strip_;
};

}  // namespace demecal::inline expression
