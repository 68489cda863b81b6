#include "expression/bound.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>

#include "errors/check.hpp"
#include "primitives/elementary.hpp"

namespace demecal::inline expression {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool is_point(const Interval& x) {
  return x.lower == x.upper;
}

// One unit further out on each side, for those who compute with another rounding. Zero stays: no operation here rounds
// to zero from the other sign, and SIGN and % depend on which side of it a value lies.
double below(double x) {
  return x == 0.0 ? x : std::nextafter(x, -kInfinity);
}
double above(double x) {
  return x == 0.0 ? x : std::nextafter(x, kInfinity);
}
Interval outward(double lower, double upper) {
  return {below(lower), above(upper)};
}

Interval point_or_unbounded(double value) {
  return std::isfinite(value) ? Interval{value, value} : unbounded();
}

// 0 * inf and inf / inf arise only at corners whose neighbours already give the extremes.
double zero_if_undefined(double corner) {
  return std::isnan(corner) ? 0.0 : corner;
}

template <class Function>
Interval hull_of_corners(const Interval& a, const Interval& b, Function function) {
  const auto corners = {zero_if_undefined(function(a.lower, b.lower)), zero_if_undefined(function(a.lower, b.upper)),
                        zero_if_undefined(function(a.upper, b.lower)), zero_if_undefined(function(a.upper, b.upper))};
  const auto [least, greatest] = std::minmax(corners);
  return outward(least, greatest);
}

Interval quotient(const Interval& a, const Interval& b) {
  if (b == Interval{0.0, 0.0}) return {1.0, 1.0};
  if (holds(b, 0.0)) return a == Interval{0.0, 0.0} ? Interval{0.0, 1.0} : unbounded();
  return hull_of_corners(a, b, [](double x, double y) { return x / y; });
}

// Whether x holds phase + 2 pi k for an integer k. In doubt yes: that widens an extreme by less than rounding does.
bool holds_phase(const Interval& x, double phase) {
  constexpr double kDoubt = 1e-9;  // of a turn; far above the rounding of angles below kLargestReducedAngle
  const double first = (x.lower - phase) / (2.0 * std::numbers::pi) - kDoubt;
  const double last = (x.upper - phase) / (2.0 * std::numbers::pi) + kDoubt;
  return std::ceil(first) <= std::floor(last);
}

// The image of a sine whose crest lies at `crest`, given its values at the ends.
Interval image_of_wave(const Interval& x, double crest, double at_lower, double at_upper) {
  if (std::max(std::abs(x.lower), std::abs(x.upper)) > kLargestReducedAngle) return {-1.0, 1.0};
  constexpr double kSlack = 8.0 * std::numeric_limits<double>::epsilon();  // twice what sine() errs by
  const double least = std::min(at_lower, at_upper);
  const double greatest = std::max(at_lower, at_upper);
  return {holds_phase(x, crest + std::numbers::pi) ? -1.0 : std::max(-1.0, least - kSlack * std::abs(least)),
          holds_phase(x, crest) ? 1.0 : std::min(1.0, greatest + kSlack * std::abs(greatest))};
}

Interval image_of_size(const Interval& x) {
  return {holds(x, 0.0) ? 0.0 : std::min(std::abs(x.lower), std::abs(x.upper)),
          std::max(std::abs(x.lower), std::abs(x.upper))};
}

Interval image_of_root(const Interval& x) {
  const double at_lower = protected_square_root(x.lower);
  const double at_upper = protected_square_root(x.upper);
  return outward(holds(x, 0.0) ? 0.0 : std::min(at_lower, at_upper), std::max(at_lower, at_upper));
}

// What a rising function is between its values at the ends, each of which errs by a few units in the last place.
Interval rising(double at_lower, double at_upper) {
  constexpr double kSlack = 8.0 * std::numeric_limits<double>::epsilon();
  return {at_lower - kSlack * std::abs(at_lower), at_upper + kSlack * std::abs(at_upper)};
}

Interval image_of_logarithm(const Interval& x) {
  const Interval size = image_of_size(x);
  const double greatest = protected_logarithm(size.upper);
  if (size.lower == 0.0) return {-kInfinity, std::max(0.0, rising(greatest, greatest).upper)};
  return rising(protected_logarithm(size.lower), greatest);
}

Interval clipped(const Interval& values, double lower, double upper) {
  return {std::max(lower, values.lower), std::min(upper, values.upper)};
}

}  // namespace

Interval unbounded() {
  return {-kInfinity, kInfinity};
}

bool holds(const Interval& interval, double value) {
  return interval.lower <= value && value <= interval.upper;
}

Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

Interval image(Primitive function, const Interval& x) {
  if (is_point(x)) return point_or_unbounded(value_of(function, x.lower));
  switch (function) {
    case Primitive::sine:
      return image_of_wave(x, 0.5 * std::numbers::pi, sine(x.lower), sine(x.upper));
    case Primitive::cosine:
      return image_of_wave(x, 0.0, cosine(x.lower), cosine(x.upper));
    case Primitive::sign:
      return {sign_of(x.lower), sign_of(x.upper)};
    case Primitive::square_root:
      return image_of_root(x);
    case Primitive::absolute:
      return image_of_size(x);
    case Primitive::logarithm:
      return image_of_logarithm(x);
    case Primitive::exponential:
      return rising(bounded_exponential(x.lower), bounded_exponential(x.upper));
    case Primitive::hyperbolic_tangent:
      return clipped(rising(hyperbolic_tangent(x.lower), hyperbolic_tangent(x.upper)), -1.0, 1.0);
    case Primitive::arc_tangent:
      return rising(arc_tangent(x.lower), arc_tangent(x.upper));
    case Primitive::square:
      return image_of_twins(Primitive::multiply, x);
    default:
      return unbounded();
  }
}

Interval image(Primitive function, const Interval& left, const Interval& right) {
  if (is_point(left) && is_point(right)) return point_or_unbounded(value_of(function, left.lower, right.lower));
  switch (function) {
    case Primitive::add:
      return outward(left.lower + right.lower, left.upper + right.upper);
    case Primitive::subtract:
      return outward(left.lower - right.upper, left.upper - right.lower);
    case Primitive::multiply:
      return hull_of_corners(left, right, [](double x, double y) { return x * y; });
    case Primitive::divide:
      return quotient(left, right);
    case Primitive::minimum:
      return {std::min(left.lower, right.lower), std::min(left.upper, right.upper)};
    case Primitive::maximum:
      return {std::max(left.lower, right.lower), std::max(left.upper, right.upper)};
    default:
      return unbounded();
  }
}

Interval image_of_twins(Primitive function, const Interval& x) {
  switch (function) {
    case Primitive::subtract:
      return {0.0, 0.0};
    case Primitive::divide:
      return {1.0, 1.0};
    case Primitive::multiply: {
      const Interval size = image_of_size(x);
      return image(Primitive::multiply, size, size);
    }
    case Primitive::minimum:
    case Primitive::maximum:
      return x;
    default:
      return image(function, x, x);
  }
}

namespace {

// For each node whether it is a function of two equal subtrees.
std::vector<std::uint8_t> find_twins(std::span<const Node> tree) {
  std::vector<std::uint8_t> twins(tree.size(), 0);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (arity(tree[i].primitive) != 2) continue;
    const std::size_t middle = subtree_end(tree, i + 1);
    const std::size_t end = subtree_end(tree, middle);
    twins[i] = std::equal(
        tree.begin() + static_cast<std::ptrdiff_t>(i) + 1, tree.begin() + static_cast<std::ptrdiff_t>(middle),
        tree.begin() + static_cast<std::ptrdiff_t>(middle), tree.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return twins;
}

class IntervalWalk {
 public:
  explicit IntervalWalk(std::span<const Node> tree) : tree_(tree), twins_(find_twins(tree)) {}

  Interval operator()(const Interval& variable) {
    stack_.clear();
    for (std::size_t i = tree_.size(); i-- > 0;) {
      const Node& node = tree_[i];
      switch (arity(node.primitive)) {
        case 0:
          stack_.push_back(node.primitive == Primitive::constant ? Interval{node.value, node.value} : variable);
          break;
        case 1:
          stack_.back() = image(node.primitive, stack_.back());
          break;
        default: {
          const Interval left = stack_.back();
          stack_.pop_back();
          stack_.back() = twins_[i] ? image_of_twins(node.primitive, left) : image(node.primitive, left, stack_.back());
        }
      }
    }
    return stack_.back();
  }

 private:
  std::span<const Node> tree_;
  std::vector<std::uint8_t> twins_;
  std::vector<Interval> stack_;
};

double magnitude(const Interval& values) {
  return std::max(std::abs(values.lower), std::abs(values.upper));
}

bool stays_within(IntervalWalk& walk, const Interval& piece, double largest, int halvings) {
  if (magnitude(walk(piece)) <= largest) return true;
  if (halvings == 0) return false;
  const double middle = std::midpoint(piece.lower, piece.upper);
  return stays_within(walk, {piece.lower, middle}, largest, halvings - 1) &&
         stays_within(walk, {middle, piece.upper}, largest, halvings - 1);
}

void check_finite_range(const Interval& range) {
  DEMECAL_CHECK(range.lower <= range.upper && std::isfinite(range.upper - range.lower),
                "range=" << range.lower << ".." << range.upper);
}

}  // namespace

Interval bound(std::span<const Node> tree, Interval range, int pieces) {
  check_finite_range(range);
  DEMECAL_CHECK(pieces >= 1, "pieces=" << pieces);
  IntervalWalk walk(tree);
  const auto end_of = [&](int piece) {
    return piece == pieces ? range.upper : std::lerp(range.lower, range.upper, static_cast<double>(piece) / pieces);
  };
  Interval all = walk({range.lower, end_of(1)});
  for (int piece = 1; piece < pieces; ++piece) all = hull(all, walk({end_of(piece), end_of(piece + 1)}));
  return all;
}

double magnitude_bound(std::span<const Node> tree, Interval range, int pieces) {
  return magnitude(bound(tree, range, pieces));
}

bool stays_within(std::span<const Node> tree, Interval range, double largest, int halvings) {
  check_finite_range(range);
  IntervalWalk walk(tree);
  return stays_within(walk, range, largest, halvings);
}

}  // namespace demecal::inline expression
