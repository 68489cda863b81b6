#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "errors/check.hpp"
#include "expression/bound.hpp"
#include "expression/evaluate.hpp"
#include "expression/tree.hpp"
#include "primitives/columns.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline expression {
namespace {

double evaluated_at(std::span<const Node> tree, double x) {
  return evaluate(tree, std::span<const double>(&x, 1));
}

// The subtrees at whose zeros a formula can jump: arguments of SIGN and LOGp, and divisors.
std::vector<std::span<const Node>> switches(std::span<const Node> tree) {
  std::vector<std::span<const Node>> found;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    std::size_t begin = 0;
    if (tree[i].primitive == Primitive::sign || tree[i].primitive == Primitive::logarithm) begin = i + 1;
    if (tree[i].primitive == Primitive::divide) begin = subtree_end(tree, i + 1);
    if (begin != 0) found.push_back(tree.subspan(begin, subtree_end(tree, begin) - begin));
  }
  return found;
}

// Two points as near as doubles lie, or next to zero as near as matters, between which `subtree` leaves the sign that
// it has at `before`.
Interval bisected(std::span<const Node> subtree, double before, double after) {
  const double sign = sign_of(evaluated_at(subtree, before));
  constexpr int kMostHalvings = 200;
  for (int i = 0; i < kMostHalvings; ++i) {
    const double middle = std::midpoint(before, after);
    if (middle == before || middle == after) break;
    (sign_of(evaluated_at(subtree, middle)) == sign ? before : after) = middle;
  }
  return {before, after};
}

// Where the size of `subtree` is least between two points, by golden sections.
double least_size(std::span<const Node> subtree, double from, double to) {
  constexpr double kGolden = 1.0 / std::numbers::phi;
  const auto size = [&](double x) { return std::abs(evaluated_at(subtree, x)); };
  double left = to - kGolden * (to - from);
  double right = from + kGolden * (to - from);
  double size_left = size(left);
  double size_right = size(right);
  while (from < left && left < right && right < to) {
    if (size_left < size_right) {
      to = right;
      right = left;
      size_right = size_left;
      left = to - kGolden * (to - from);
      size_left = size(left);
    } else {
      from = left;
      left = right;
      size_left = size_right;
      right = from + kGolden * (to - from);
      size_right = size(right);
    }
  }
  return size_left < size_right ? left : right;
}

class JumpSearch {
 public:
  JumpSearch(std::span<const Node> tree, Interval range, double smallest_jump)
      : tree_(tree), range_(range), smallest_jump_(smallest_jump) {}

  void at_sign_change(std::span<const Node> subtree, double before, double after) {
    const Interval zero = bisected(subtree, before, after);
    const double nearest_zero = std::clamp(0.0, zero.lower, zero.upper);
    const double place = first_zero(subtree, {zero.lower, nearest_zero, zero.upper});
    report_if_jump(place, {below(zero.lower), zero.lower, place, zero.upper, above(zero.upper)});
  }

  // Without a change of sign the two sides may meet in a pole, too wide for neighbouring doubles to show it.
  void at_touch(std::span<const Node> subtree, double before, double after) {
    const double least = least_size(subtree, before, after);
    constexpr double kNegligible = 1e-6;
    const double beside = std::max(std::abs(evaluated_at(subtree, before)), std::abs(evaluated_at(subtree, after)));
    if (std::abs(evaluated_at(subtree, least)) > kNegligible * beside) return;
    const double place = first_zero(subtree, {below(least), above(least), std::clamp(0.0, before, after), least});
    const double reach = 1e-8 * (range_.upper - range_.lower);
    report_if_jump(place, {std::max(range_.lower, place - reach), below(place), place, above(place),
                           std::min(range_.upper, place + reach)});
  }

  std::vector<double> found() {
    std::sort(found_.begin(), found_.end());
    const double same = 1e-7 * (range_.upper - range_.lower);
    std::vector<double> apart;
    for (const double place : found_) {
      if (apart.empty() || place - apart.back() > same) apart.push_back(place);
    }
    return apart;
  }

 private:
  double below(double x) const {
    return std::max(range_.lower, std::nextafter(x, -std::numeric_limits<double>::max()));
  }
  double above(double x) const { return std::min(range_.upper, std::nextafter(x, std::numeric_limits<double>::max())); }

  // The first place where the subtree is zero, else the last.
  static double first_zero(std::span<const Node> subtree, std::initializer_list<double> places) {
    const auto zero =
        std::find_if(places.begin(), places.end(), [&](double x) { return evaluated_at(subtree, x) == 0.0; });
    return zero == places.end() ? *(zero - 1) : *zero;
  }

  void report_if_jump(double place, const std::array<double, 5>& around) {
    double least = std::numeric_limits<double>::infinity();
    double greatest = -least;
    for (const double x : around) {
      const double value = evaluated_at(tree_, x);
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
    if (greatest - least > smallest_jump_) found_.push_back(place);
  }

  std::span<const Node> tree_;
  Interval range_;
  double smallest_jump_;
  std::vector<double> found_;
};

std::vector<double> grid_points(Interval range, int count) {
  std::vector<double> points;
  for (int i = 0; i < count; ++i) points.push_back(std::lerp(range.lower, range.upper, i / (count - 1.0)));
  return points;
}

}  // namespace

std::vector<double> discontinuities(const Tree& tree, Interval range, double smallest_jump, int grid) {
  DEMECAL_CHECK(range.lower <= range.upper, "range=" << range.lower << ".." << range.upper);
  DEMECAL_CHECK(grid >= 3, "grid=" << grid);
  const std::vector<std::vector<double>> columns{grid_points(range, grid)};
  const std::vector<double>& points = columns.front();
  ColumnEvaluator evaluate_on_grid(columns);
  JumpSearch search(tree, range, smallest_jump);
  for (const std::span<const Node> subtree : switches(tree)) {
    const std::span<const double> values = evaluate_on_grid(subtree);
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (sign_of(values[i - 1]) != sign_of(values[i])) {
        search.at_sign_change(subtree, points[i - 1], points[i]);
      } else if (i + 1 < points.size() && sign_of(values[i]) == sign_of(values[i + 1]) &&
                 std::abs(values[i]) <= std::abs(values[i - 1]) && std::abs(values[i]) < std::abs(values[i + 1])) {
        search.at_touch(subtree, points[i - 1], points[i + 1]);
      }
    }
  }
  return search.found();
}

}  // namespace demecal::inline expression
