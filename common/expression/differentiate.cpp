
#include <cstdint>
#include <vector>

#include "expression/simplify.hpp"
#include "primitives/elementary.hpp"
#include "primitives/primitive.hpp"

#include "expression/tree.hpp"

namespace demecal::inline expression {
namespace {

// Formulas without terms and factors that change no finite value. A function of constants is one constant, unless it
// overflows.

Tree sum_of(const Tree& a, const Tree& b) {
  if (is_constant(a, 0.0)) return b;
  if (is_constant(b, 0.0)) return a;
  return apply_folded(Primitive::add, a, b);
}

Tree difference_of(const Tree& a, const Tree& b) {
  if (a == b) return constant_tree(0.0);
  if (is_constant(b, 0.0)) return a;
  return apply_folded(Primitive::subtract, a, b);
}

Tree product_of(const Tree& a, const Tree& b) {
  if (is_constant(a, 0.0) || is_constant(b, 0.0)) return constant_tree(0.0);
  if (is_constant(a, 1.0)) return b;
  if (is_constant(b, 1.0)) return a;
  return apply_folded(Primitive::multiply, a, b);
}

Tree quotient_of(const Tree& a, const Tree& b) {
  if (a == b || is_constant(b, 0.0)) return constant_tree(1.0);
  if (is_constant(b, 1.0)) return a;
  return apply_folded(Primitive::divide, a, b);
}

// A formula and its derivative.
struct DualTree {
  Tree value;
  Tree slope;
};

Tree slope_of_quotient(const DualTree& f, const DualTree& g, const Tree& value) {
  const Tree rise = difference_of(f.slope, product_of(value, g.slope));
  if (is_constant(rise, 0.0)) return rise;
  if (is_constant(g.value)) return quotient_of(rise, g.value);
  const Tree sign = apply_folded(Primitive::sign, g.value);
  return product_of(sign, quotient_of(rise, product_of(sign, g.value)));
}

Tree slope_of_root(const DualTree& x, const Tree& value) {
  return product_of(apply_folded(Primitive::sign, x.value), quotient_of(x.slope, sum_of(value, value)));
}

// The Heaviside step: 1 where a tree is above 0, 0 where it is below.
Tree step_at(const Tree& tree) {
  return product_of(constant_tree(0.5), sum_of(constant_tree(1.0), apply_folded(Primitive::sign, tree)));
}

DualTree dual_extreme(Primitive function, const DualTree& f, const DualTree& g) {
  if (f.value == g.value) return f;
  const Tree ahead = function == Primitive::minimum ? difference_of(g.value, f.value) : difference_of(f.value, g.value);
  const Tree share = step_at(ahead);
  return {apply_folded(function, f.value, g.value),
          sum_of(product_of(share, f.slope), product_of(difference_of(constant_tree(1.0), share), g.slope))};
}

DualTree dual_unary(Primitive function, const DualTree& x) {
  const Tree value = apply_folded(function, x.value);
  if (is_constant(value) || is_constant(x.slope, 0.0)) return {value, constant_tree(0.0)};
  switch (function) {
    case Primitive::sine:
      return {value, product_of(apply_folded(Primitive::cosine, x.value), x.slope)};
    case Primitive::cosine:
      return {value, product_of(product_of(constant_tree(-1.0), apply_folded(Primitive::sine, x.value)), x.slope)};
    case Primitive::square_root:
      return {value, slope_of_root(x, value)};
    case Primitive::absolute:
      return {value, product_of(apply_folded(Primitive::sign, x.value), x.slope)};
    case Primitive::logarithm: {
      const Tree sign = apply_folded(Primitive::sign, x.value);
      return {value, product_of(sign, quotient_of(x.slope, product_of(sign, x.value)))};
    }
    case Primitive::exponential: {
      const Tree room = difference_of(constant_tree(kLargestExponent), apply_folded(Primitive::absolute, x.value));
      return {value, product_of(product_of(step_at(room), value), x.slope)};
    }
    case Primitive::hyperbolic_tangent:
      return {value, product_of(difference_of(constant_tree(1.0), apply_folded(Primitive::square, value)), x.slope)};
    case Primitive::arc_tangent:
      return {value, quotient_of(x.slope, sum_of(constant_tree(1.0), apply_folded(Primitive::square, x.value)))};
    case Primitive::square:
      return {value, product_of(product_of(constant_tree(2.0), x.value), x.slope)};
    default:
      return {value, constant_tree(0.0)};
  }
}

DualTree dual_binary(Primitive function, const DualTree& f, const DualTree& g) {
  switch (function) {
    case Primitive::add:
      return {sum_of(f.value, g.value), sum_of(f.slope, g.slope)};
    case Primitive::subtract:
      return {difference_of(f.value, g.value), difference_of(f.slope, g.slope)};
    case Primitive::multiply:
      return {product_of(f.value, g.value), sum_of(product_of(f.slope, g.value), product_of(f.value, g.slope))};
    case Primitive::minimum:
    case Primitive::maximum:
      return dual_extreme(function, f, g);
    default: {
      const Tree value = quotient_of(f.value, g.value);
      if (is_constant(value)) return {value, constant_tree(0.0)};
      return {value, slope_of_quotient(f, g, value)};
    }
  }
}

}  // namespace

Tree derivative(const Tree& tree, std::uint8_t variable) {
  return fold<DualTree>(
             tree,
             [variable](const Node& node) {
               const bool varies = node.primitive == Primitive::variable && node.variable == variable;
               return DualTree{{node}, constant_tree(varies ? 1.0 : 0.0)};
             },
             dual_unary, dual_binary)
      .slope;
}

}  // namespace demecal::inline expression
