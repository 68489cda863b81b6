// A formula as a function of its constants: its values and their exact slopes by each constant, over columns of rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "expression/evaluate.hpp"
#include "expression/node_store.hpp"
#include "primitives/columns.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline expression {

/// Takes one formula of a store at a time. Its constants are its largest subtrees without a variable, folded into
/// numbers; equal subtrees share one constant. Slopes come from one sweep backwards over the shared form (reverse
/// accumulation; Linnainmaa 1970), by the steps that compute values, so that they too have the same bits everywhere.
/// At jumps of SIGN slopes are those beside the jump; where % and SQRTp hold still because their argument is 0, they
/// are 0. Keeps its memory between formulas.
class ConstantModel {
 public:
  /// Keeps a copy of the columns.
  explicit ConstantModel(Columns columns);

  /// Whether a linear function a + b * f stands around the formula f, with a and b as constants 0 and 1, of values 0
  /// and 1. Constants that such a function makes redundant are taken off f first.
  enum class Scaling : std::uint8_t { none, linear };

  /// How large the formula is with its constants folded and the scaling around it.
  static TreeExtent extent(const NodeStore& store, NodeId root, Scaling scaling);

  /// The store must keep the formula until the next call.
  void bind(const NodeStore& store, NodeId root, Scaling scaling = Scaling::none);
  /// The values that the constants have in the formula; those that are not finite stay as they are and are not among
  /// them. Ordered by where they stand first.
  std::span<const double> constants() const { return constants_; }
  /// Whether a constant decides where a SIGN jumps.
  bool jumps() const { return jumps_; }

  /// Gives the constants other values.
  void set(std::span<const double> constants);
  /// Values in the rows from `begin` on, of which there are rows_at() in this strip; valid until the next call.
  const double* values(std::size_t begin);
  /// Computes the slopes in the rows that values() was last called for.
  void find_slopes() { run(slope_steps_, begin_, rows_at(begin_)); }
  /// d value / d constant in those rows.
  const double* slope(std::size_t constant) const { return slopes_[constant]; }

  std::size_t padded_rows() const { return columns_.padded_rows(); }
  std::size_t rows_at(std::size_t begin) const;

  /// The formula with these constants, folded, in the store that it came from.
  NodeId rebuilt(NodeStore& store, std::span<const double> constants);

 private:
  struct Part {
    NodeId id = 0;  ///< 0 where the store does not have it
    Primitive primitive = Primitive::constant;
    bool varies = false;  ///< with a constant
    std::uint32_t left = 0, right = 0;
    std::uint32_t constant = 0;  ///< its number, where it is one
    Operand value;
    const double* slope = nullptr;  ///< of the formula by this part
  };
  struct Known {
    std::uint32_t formula = 0;
    std::uint32_t part = 0;
  };

  void decompose(const NodeStore& store, NodeId root);
  void add_leaf(const SharedNode& node, NodeId id);
  std::uint32_t add_constant(NodeId id, double value);
  std::uint32_t add_function(Primitive primitive, std::uint32_t left, std::uint32_t right, NodeId id);
  double* take_column(double fill);
  double* take_column();
  void backpropagate();
  void backpropagate(const Part& part);
  void add_slope(std::uint32_t part, const double* slope);
  const double* emit(Primitive primitive, const Operand& argument);
  const double* emit(Primitive primitive, const Operand& left, const Operand& right);
  const double* negated(const double* column);
  const double* step_at(const double* column);

  PaddedColumns columns_;
  std::size_t strip_rows_;
  ColumnPool pool_;
  std::vector<double*> taken_;
  AlignedColumn ones_, zeros_;
  std::uint32_t formula_ = 0;
  std::vector<Known> known_;  ///< by node
  std::vector<NodeId> stack_;
  std::vector<Part> parts_;  ///< arguments first, the whole formula last
  std::vector<double> constants_;
  std::vector<double*> constant_columns_;
  std::vector<const double*> slopes_;
  std::vector<NodeId> rebuilt_;
  std::vector<ColumnStep> fixed_steps_, varying_steps_, slope_steps_;
  std::size_t begin_ = 0;
  bool fixed_known_ = false;    ///< whether what varies with no constant is computed for these rows
  bool varying_known_ = false;  ///< the same of the rest, at the present constants
  bool jumps_ = false;
};

}  // namespace demecal::inline expression
