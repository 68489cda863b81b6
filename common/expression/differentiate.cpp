#include "expression/differentiate.hpp"

#include <cmath>

#include "expression/fold.hpp"

namespace demecal {
namespace {

bool is_constant(const Tree& tree) {
  return tree.front().primitive == Primitive::constant;
}
bool is(const Tree& tree, double constant) {
  return is_constant(tree) && tree.front().value == constant;
}

// Formulas without terms and factors that change no finite value. A function of constants is one constant, unless it
// overflows.

Tree folded(Primitive function, const Tree& a, const Tree& b) {
  if (is_constant(a) && is_constant(b)) {
    const double value = value_of(function, a.front().value, b.front().value);
    if (std::isfinite(value)) return constant_tree(value);
  }
  return apply(function, a, b);
}

Tree sum(const Tree& a, const Tree& b) {
  if (is(a, 0.0)) return b;
  if (is(b, 0.0)) return a;
  return folded(Primitive::add, a, b);
}

Tree difference(const Tree& a, const Tree& b) {
  if (a == b) return constant_tree(0.0);
  if (is(b, 0.0)) return a;
  return folded(Primitive::subtract, a, b);
}

Tree product(const Tree& a, const Tree& b) {
  if (is(a, 0.0) || is(b, 0.0)) return constant_tree(0.0);
  if (is(a, 1.0)) return b;
  if (is(b, 1.0)) return a;
  return folded(Primitive::multiply, a, b);
}

Tree quotient(const Tree& a, const Tree& b) {
  if (a == b || is(b, 0.0)) return constant_tree(1.0);
  if (is(b, 1.0)) return a;
  return folded(Primitive::divide, a, b);
}

Tree call(Primitive function, const Tree& argument) {
  if (is_constant(argument)) {
    const double value = value_of(function, argument.front().value);
    if (std::isfinite(value)) return constant_tree(value);
  }
  return apply(function, argument);
}

struct Piece {
  Tree value;
  Tree slope;
};

Tree slope_of_quotient(const Piece& f, const Piece& g, const Tree& value) {
  const Tree rise = difference(f.slope, product(value, g.slope));
  if (is(rise, 0.0)) return rise;
  if (is_constant(g.value)) return quotient(rise, g.value);
  const Tree sign = call(Primitive::sign, g.value);
  return product(sign, quotient(rise, product(sign, g.value)));
}

Tree slope_of_root(const Piece& x, const Tree& value) {
  return product(call(Primitive::sign, x.value), quotient(x.slope, sum(value, value)));
}

// 1 where a tree is above 0, 0 where it is below.
Tree share_of(const Tree& tree) {
  return product(constant_tree(0.5), sum(constant_tree(1.0), call(Primitive::sign, tree)));
}

Piece lesser(Primitive function, const Piece& f, const Piece& g) {
  if (f.value == g.value) return f;
  const Tree ahead = function == Primitive::minimum ? difference(g.value, f.value) : difference(f.value, g.value);
  const Tree share = share_of(ahead);
  return {folded(function, f.value, g.value),
          sum(product(share, f.slope), product(difference(constant_tree(1.0), share), g.slope))};
}

Piece called(Primitive function, const Piece& x) {
  const Tree value = call(function, x.value);
  if (is_constant(value) || is(x.slope, 0.0)) return {value, constant_tree(0.0)};
  switch (function) {
    case Primitive::sine:
      return {value, product(call(Primitive::cosine, x.value), x.slope)};
    case Primitive::cosine:
      return {value, product(product(constant_tree(-1.0), call(Primitive::sine, x.value)), x.slope)};
    case Primitive::square_root:
      return {value, slope_of_root(x, value)};
    case Primitive::absolute:
      return {value, product(call(Primitive::sign, x.value), x.slope)};
    case Primitive::logarithm: {
      const Tree sign = call(Primitive::sign, x.value);
      return {value, product(sign, quotient(x.slope, product(sign, x.value)))};
    }
    case Primitive::exponential: {
      const Tree room = difference(constant_tree(kLargestExponent), call(Primitive::absolute, x.value));
      return {value, product(product(share_of(room), value), x.slope)};
    }
    case Primitive::hyperbolic_tangent:
      return {value, product(difference(constant_tree(1.0), call(Primitive::square, value)), x.slope)};
    case Primitive::arc_tangent:
      return {value, quotient(x.slope, sum(constant_tree(1.0), call(Primitive::square, x.value)))};
    case Primitive::square:
      return {value, product(product(constant_tree(2.0), x.value), x.slope)};
    default:
      return {value, constant_tree(0.0)};
  }
}

Piece joined_pieces(Primitive function, const Piece& f, const Piece& g) {
  switch (function) {
    case Primitive::add:
      return {sum(f.value, g.value), sum(f.slope, g.slope)};
    case Primitive::subtract:
      return {difference(f.value, g.value), difference(f.slope, g.slope)};
    case Primitive::multiply:
      return {product(f.value, g.value), sum(product(f.slope, g.value), product(f.value, g.slope))};
    case Primitive::minimum:
    case Primitive::maximum:
      return lesser(function, f, g);
    default: {
      const Tree value = quotient(f.value, g.value);
      if (is_constant(value)) return {value, constant_tree(0.0)};
      return {value, slope_of_quotient(f, g, value)};
    }
  }
}

}  // namespace

Tree derivative(const Tree& tree, std::uint8_t variable) {
  return fold<Piece>(
             tree,
             [variable](const Node& node) {
               const bool varies = node.primitive == Primitive::variable && node.variable == variable;
               return Piece{{node}, constant_tree(varies ? 1.0 : 0.0)};
             },
             called, joined_pieces)
      .slope;
}

}  // namespace demecal
