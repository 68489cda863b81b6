#include "expression/shared_function.hpp"
#include "primitives/primitive.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "expression/text.hpp"
#include "expression/tree.hpp"

namespace demecal::inline expression {
namespace {

constexpr std::size_t kMostNames = 255;
constexpr int kMostMatchingSteps =
    10'000;  // of one match: bodies from elsewhere may have arguments in more orders than can be tried

/// Where a call's places begin in the formula that it stands in.
using Bindings = std::vector<std::optional<std::size_t>>;

/// The shortest ways to write each subtree of one formula, from the last to the first.
class Folding {
 public:
  Folding(Tree formula, std::span<const SharedFunction> functions)
      : tree_(std::move(formula)), functions_(functions), best_(tree_.size()), ends_(tree_.size()) {
    for (std::size_t i = tree_.size(); i-- > 0;) {
      ends_[i] = i + 1;
      for (int k = 0; k < arity(tree_[i].primitive); ++k) ends_[i] = ends_[ends_[i]];
      best_[i] = shortest(i);
    }
  }

  std::size_t size() const { return best_.front().size; }

  FoldedFormula written(std::size_t begin, int variables) const {
    FoldedFormula formula;
    formula.variables = variables;
    write(begin, formula);
    return formula;
  }

 private:
  struct Way {
    std::size_t size = 0;
    std::size_t function = 0;         ///< from 1; 0: none is called
    std::vector<std::size_t> places;  ///< where they begin
  };

  Way shortest(std::size_t begin) const {
    Way way{1, 0, {}};
    std::size_t argument = begin + 1;
    for (int k = 0; k < arity(tree_[begin].primitive); ++k, argument = ends_[argument])
      way.size += best_[argument].size;
    for (std::size_t i = 0; i < functions_.size(); ++i) {
      if (functions_[i].body.front().primitive != tree_[begin].primitive) continue;
      Bindings bindings(static_cast<std::size_t>(arity(functions_[i])));
      int steps = kMostMatchingSteps;
      if (!matches(functions_[i], {{0, begin}}, bindings, steps)) continue;
      Way call{1, i + 1, {}};
      for (const auto& place : bindings) {
        call.places.push_back(*place);
        call.size += best_[*place].size;
      }
      if (call.size < way.size) way = std::move(call);
    }
    return way;
  }

  std::span<const Node> subtree(std::size_t begin) const {
    return std::span(tree_).subspan(begin, ends_[begin] - begin);
  }

  bool binds(const SharedFunction& function, std::size_t place, std::size_t begin, Bindings& bindings) const {
    const bool is_coefficient = place < static_cast<std::size_t>(function.coefficients);
    if (is_coefficient && tree_[begin].primitive != Primitive::constant) return false;
    if (bindings[place]) return in_order(subtree(*bindings[place])) == in_order(subtree(begin));
    bindings[place] = begin;
    return true;
  }

  /// Parts of the body yet to be found, and where.
  using Pending = std::vector<std::pair<std::size_t, std::size_t>>;

  bool matches(const SharedFunction& function, Pending pending, Bindings& bindings, int& steps) const {
    while (!pending.empty()) {
      if (--steps < 0) return false;
      const auto [body, begin] = pending.back();
      pending.pop_back();
      const Node& node = function.body[body];
      if (node.primitive == Primitive::variable) {
        if (!binds(function, node.variable, begin, bindings)) return false;
        continue;
      }
      if (node.primitive != tree_[begin].primitive) return false;
      if (arity(node.primitive) == 1) {
        pending.emplace_back(body + 1, begin + 1);
        continue;
      }
      const std::size_t first = body + 1, second = subtree_end(function.body, first);
      const std::size_t left = begin + 1, right = ends_[left];
      if (is_commutative(node.primitive)) {
        Pending as_they_stand = pending;
        as_they_stand.insert(as_they_stand.end(), {{second, right}, {first, left}});
        Bindings trial = bindings;
        if (matches(function, std::move(as_they_stand), trial, steps)) {
          bindings = std::move(trial);
          return true;
        }
        pending.insert(pending.end(), {{second, left}, {first, right}});
      } else {
        pending.insert(pending.end(), {{second, right}, {first, left}});
      }
    }
    return true;
  }

  void write(std::size_t begin, FoldedFormula& formula) const {
    const Way& way = best_[begin];
    const std::size_t name = static_cast<std::size_t>(formula.variables) + formula.calls.size();
    if (way.function != 0 && name < kMostNames) {
      FoldedCall call{way.function - 1, {}};
      for (const std::size_t place : way.places) call.places.push_back(written(place, formula.variables));
      formula.outline.push_back({Primitive::variable, static_cast<std::uint8_t>(name), 0.0});
      formula.calls.push_back(std::move(call));
      return;
    }
    formula.outline.push_back(tree_[begin]);
    std::size_t argument = begin + 1;
    for (int k = 0; k < arity(tree_[begin].primitive); ++k, argument = ends_[argument]) write(argument, formula);
  }

  Tree tree_;
  std::span<const SharedFunction> functions_;
  std::vector<Way> best_;
  std::vector<std::size_t> ends_;
};

/// Functions may subtract a constant or add its negative.
Folding shortest_folding(std::span<const Node> tree, std::span<const SharedFunction> functions) {
  if (depth(tree) > kDeepestFolded) functions = {};
  Folding as_it_is(Tree(tree.begin(), tree.end()), functions);
  if (functions.empty()) return as_it_is;
  Tree added = with_negatives_added(tree);
  if (std::ranges::equal(added, tree)) return as_it_is;
  Folding sums(std::move(added), functions);
  return sums.size() < as_it_is.size() ? sums : as_it_is;
}

bool is_call(const FoldedFormula& formula, const Node& node) {
  return node.primitive == Primitive::variable && node.variable >= formula.variables;
}

const FoldedCall& call_of(const FoldedFormula& formula, const Node& node) {
  return formula.calls[static_cast<std::size_t>(node.variable - formula.variables)];
}

void gather_called(const FoldedFormula& formula, std::set<std::size_t>& called) {
  for (const FoldedCall& call : formula.calls) {
    called.insert(call.function);
    for (const FoldedFormula& place : call.places) gather_called(place, called);
  }
}

std::string call_text(const FoldedCall& call, const VariableNames& names) {
  std::string text = name_of_function(call.function) + "(";
  for (std::size_t i = 0; i < call.places.size(); ++i) text += (i == 0 ? "" : ", ") + to_string(call.places[i], names);
  return text + ")";
}

}  // namespace

FoldedFormula folded(std::span<const Node> tree, std::span<const SharedFunction> functions, int variables) {
  const Folding folding = shortest_folding(tree, functions);
  if (folding.size() == tree.size()) return {Tree(tree.begin(), tree.end()), variables, {}};
  return folding.written(0, variables);
}

std::size_t folded_size(std::span<const Node> tree, std::span<const SharedFunction> functions) {
  return shortest_folding(tree, functions).size();
}

std::size_t size(const FoldedFormula& formula) {
  std::size_t nodes = formula.outline.size();
  for (const FoldedCall& call : formula.calls)
    for (const FoldedFormula& place : call.places) nodes += size(place);
  return nodes;
}

std::vector<std::size_t> functions_called(const FoldedFormula& formula) {
  std::set<std::size_t> called;
  gather_called(formula, called);
  return {called.begin(), called.end()};
}

Tree expanded(const FoldedFormula& formula, std::span<const SharedFunction> functions) {
  Tree tree;
  for (const Node& node : formula.outline) {
    if (!is_call(formula, node)) {
      tree.push_back(node);
      continue;
    }
    const FoldedCall& call = call_of(formula, node);
    std::vector<Tree> places;
    for (const FoldedFormula& place : call.places) places.push_back(expanded(place, functions));
    const Tree written_out = expanded(functions[call.function], places);
    tree.insert(tree.end(), written_out.begin(), written_out.end());
  }
  return tree;
}

std::string to_string(const FoldedFormula& formula, const VariableNames& names) {
  VariableNames with_calls(names.begin(), names.begin() + formula.variables);
  for (const FoldedCall& call : formula.calls) with_calls.push_back(call_text(call, names));
  return to_string(formula.outline, with_calls);
}

}  // namespace demecal::inline expression
