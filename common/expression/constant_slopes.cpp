
#include <cstddef>
#include <cstdint>
#include <vector>

#include "expression/constant_model.hpp"
#include "primitives/columns.hpp"
#include "primitives/elementary.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline expression {

const double* ConstantModel::emit(Primitive primitive, const Operand& argument) {
  double* const out = take_column();
  slope_steps_.push_back(make_step(primitive, argument, out, false));
  return out;
}

const double* ConstantModel::emit(Primitive primitive, const Operand& left, const Operand& right) {
  double* const out = take_column();
  slope_steps_.push_back(make_step(primitive, left, right, out, false));
  return out;
}

const double* ConstantModel::negated(const double* column) {
  return emit(Primitive::multiply, {column, 0.0, false}, {nullptr, -1.0, false});
}

// 1 where a column is above 0, 0 where it is below.
const double* ConstantModel::step_at(const double* column) {
  const double* const sign = emit(Primitive::sign, {column, 0.0, false});
  const double* const from_zero = emit(Primitive::add, {nullptr, 1.0, false}, {sign, 0.0, false});
  return emit(Primitive::multiply, {nullptr, 0.5, false}, {from_zero, 0.0, false});
}

void ConstantModel::add_slope(std::uint32_t part, const double* slope) {
  const double*& sum = parts_[part].slope;
  sum = sum == nullptr ? slope : emit(Primitive::add, {sum, 0.0, false}, {slope, 0.0, false});
}

void ConstantModel::backpropagate() {
  slope_steps_.clear();
  parts_.back().slope = parts_.back().varies ? ones_.data() : nullptr;
  for (std::size_t i = parts_.size(); i-- > 0;)
    if (parts_[i].slope != nullptr && arity(parts_[i].primitive) > 0) backpropagate(parts_[i]);
  slopes_.resize(constants_.size());
  for (const Part& part : parts_)
    if (part.varies && arity(part.primitive) == 0)
      slopes_[part.constant] = part.slope != nullptr ? part.slope : zeros_.data();
}

// The chain rule at one part, towards those of its arguments that vary.
void ConstantModel::backpropagate(const Part& part) {
  const Operand slope{part.slope, 0.0, false};
  const Operand& left = parts_[part.left].value;
  const Operand& right = parts_[part.right].value;
  const bool to_left = parts_[part.left].varies;
  const bool to_right = arity(part.primitive) == 2 && parts_[part.right].varies;
  const auto column = [](const double* values) { return Operand{values, 0.0, false}; };
  const auto product = [&](const Operand& a, const Operand& b) { return emit(Primitive::multiply, a, b); };
  switch (part.primitive) {
    case Primitive::add:
      if (to_left) add_slope(part.left, part.slope);
      if (to_right) add_slope(part.right, part.slope);
      break;
    case Primitive::subtract:
      if (to_left) add_slope(part.left, part.slope);
      if (to_right) add_slope(part.right, negated(part.slope));
      break;
    case Primitive::multiply:
      if (to_left) add_slope(part.left, product(slope, right));
      if (to_right) add_slope(part.right, product(slope, left));
      break;
    case Primitive::divide: {
      const double* const nonzero = emit(Primitive::absolute, column(emit(Primitive::sign, right)));
      const double* const quotient = product(column(emit(Primitive::divide, slope, right)), column(nonzero));
      if (to_left) add_slope(part.left, quotient);
      if (to_right) add_slope(part.right, negated(product(column(quotient), part.value)));
      break;
    }
    case Primitive::sine:
      add_slope(part.left, product(slope, column(emit(Primitive::cosine, left))));
      break;
    case Primitive::cosine:
      add_slope(part.left, negated(product(slope, column(emit(Primitive::sine, left)))));
      break;
    case Primitive::square_root: {
      const double* const twice = emit(Primitive::add, part.value, part.value);
      const double* const size = emit(Primitive::divide, slope, column(twice));
      add_slope(part.left, product(column(size), column(emit(Primitive::sign, left))));
      break;
    }
    case Primitive::absolute:
      add_slope(part.left, product(slope, column(emit(Primitive::sign, left))));
      break;
    case Primitive::logarithm: {
      const double* const nonzero = emit(Primitive::absolute, column(emit(Primitive::sign, left)));
      add_slope(part.left, product(column(emit(Primitive::divide, slope, left)), column(nonzero)));
      break;
    }
    case Primitive::exponential: {
      const double* const size = emit(Primitive::absolute, left);
      const double* const room = emit(Primitive::subtract, {nullptr, kLargestExponent, false}, column(size));
      const double* const rate = product(column(step_at(room)), part.value);
      add_slope(part.left, product(slope, column(rate)));
      break;
    }
    case Primitive::hyperbolic_tangent: {
      const double* const squared = emit(Primitive::square, part.value);
      const double* const rate = emit(Primitive::subtract, {nullptr, 1.0, false}, column(squared));
      add_slope(part.left, product(slope, column(rate)));
      break;
    }
    case Primitive::arc_tangent: {
      const double* const squared = emit(Primitive::square, left);
      const double* const rate = emit(Primitive::add, {nullptr, 1.0, false}, column(squared));
      add_slope(part.left, emit(Primitive::divide, slope, column(rate)));
      break;
    }
    case Primitive::square: {
      const double* const twice = emit(Primitive::add, left, left);
      add_slope(part.left, product(slope, column(twice)));
      break;
    }
    case Primitive::minimum:
    case Primitive::maximum: {
      const bool least = part.primitive == Primitive::minimum;
      const double* const ahead = emit(Primitive::subtract, least ? right : left, least ? left : right);
      const double* const share = step_at(ahead);
      if (to_left) add_slope(part.left, product(slope, column(share)));
      if (to_right)
        add_slope(part.right, product(slope, column(emit(Primitive::subtract, {nullptr, 1.0, false}, column(share)))));
      break;
    }
    default:
      jumps_ = true;
  }
}

}  // namespace demecal::inline expression
