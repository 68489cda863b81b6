#include "expression/bound.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "errors/check.hpp"
#include "expression/limit.hpp"

namespace demecal {
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

double size_of(const Interval& values) {
  return std::max(std::abs(values.lower), std::abs(values.upper));
}

bool stays_within(IntervalWalk& walk, const Interval& piece, double largest, int halvings) {
  if (size_of(walk(piece)) <= largest) return true;
  if (halvings == 0) return false;
  const double middle = std::midpoint(piece.lower, piece.upper);
  return stays_within(walk, {piece.lower, middle}, largest, halvings - 1) &&
         stays_within(walk, {middle, piece.upper}, largest, halvings - 1);
}

void check_range(const Interval& range) {
  DEMECAL_CHECK(range.lower <= range.upper && std::isfinite(range.upper - range.lower),
                "range=" << range.lower << ".." << range.upper);
}

}  // namespace

Interval bound(std::span<const Node> tree, Interval range, int pieces) {
  check_range(range);
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
  return size_of(bound(tree, range, pieces));
}

bool stays_within(std::span<const Node> tree, Interval range, double largest, int halvings) {
  check_range(range);
  IntervalWalk walk(tree);
  return stays_within(walk, range, largest, halvings);
}

}  // namespace demecal
