#include "evolution/building_blocks.hpp"
#include "primitives/primitive.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "expression/shared_function.hpp"
#include "expression/tree.hpp"

namespace demecal::inline evolution {
namespace {

constexpr std::size_t kMostStructures = 200;  // structures of a search that are looked at closely
constexpr int kMostArguments = 2;             // what takes more says little of what it stands for
constexpr std::size_t kLeastFunctions = 3;    // smaller structures save little, and evolution makes them anew with ease

// In structures, before their places are numbered.
const Node kCoefficient{Primitive::constant, 0, 0.0};
const Node kArgument{Primitive::variable, 0, 0.0};

/// The form with a different number for each constant, since none is known to equal another.
Tree with_numbered_constants(Tree form) {
  double number = 0.0;
  for (Node& node : form) {
    if (node.primitive != Primitive::variable) continue;
    if (node.variable == 0)
      node = {Primitive::constant, 0, ++number};
    else
      --node.variable;
  }
  return in_order(form);
}

std::size_t functions_of(const Tree& structure) {
  return static_cast<std::size_t>(
      std::ranges::count_if(structure, [](const Node& node) { return arity(node.primitive) > 0; }));
}

/// By how many functions they have.
using Structures = std::array<std::vector<Tree>, kLargestStructure + 1>;

/// All structures that stand at the root of the subtree that begins at `position`, which is moved behind it; `each` is
/// told of these and of those of every subtree below.
Structures structures_at(const Tree& form, std::size_t& position, const std::function<void(const Structures&)>& each) {
  const Node& node = form[position++];
  Structures all;
  all[0] = {node.primitive == Primitive::constant ? Tree{kCoefficient} : Tree{kArgument}};
  if (arity(node.primitive) == 0) return all;
  const Structures lefts = structures_at(form, position, each);
  const Structures rights = arity(node.primitive) == 2 ? structures_at(form, position, each) : Structures{};
  for (std::size_t i = 0; i < kLargestStructure; ++i) {
    for (const Tree& left : lefts[i]) {
      if (arity(node.primitive) == 1) all[i + 1].push_back(apply(node.primitive, left));
      for (std::size_t j = 0; i + j < kLargestStructure; ++j)
        for (const Tree& right : rights[j]) all[i + j + 1].push_back(apply_in_order(node.primitive, left, right));
    }
  }
  each(all);
  return all;
}

/// Which joints hold a structure, and how often it stands in their forms.
struct StructureOccurrences {
  std::size_t last_joint = 0, joints = 0, times = 0;
};
using HeldStructures = std::map<Tree, StructureOccurrences, Precedes>;

/// Counts those that are large enough in a form of the joint; joints count from 1.
void count_structures(const Tree& form, std::size_t joint, HeldStructures& held) {
  const auto count = [&](const Structures& here) {
    for (std::size_t i = kLeastFunctions; i < here.size(); ++i) {
      for (const Tree& structure : here[i]) {
        StructureOccurrences& occurrences = held[structure];
        if (std::exchange(occurrences.last_joint, joint) != joint) ++occurrences.joints;
        ++occurrences.times;
      }
    }
  };
  std::size_t position = 0;
  structures_at(form, position, count);
}

/// Structures that two joints hold, those first that might save most.
std::vector<Tree> promising(std::span<const std::vector<Tree>> forms) {
  HeldStructures structures;
  for (std::size_t joint = 0; joint < forms.size(); ++joint)
    for (const Tree& form : forms[joint]) count_structures(form, joint + 1, structures);
  std::vector<std::pair<std::size_t, Tree>> by_savings;
  for (const auto& [structure, occurrences] : structures)
    if (occurrences.joints >= 2) by_savings.emplace_back(occurrences.times * (functions_of(structure) - 1), structure);
  std::ranges::stable_sort(by_savings, std::ranges::greater{}, [](const auto& entry) { return entry.first; });
  std::vector<Tree> best;
  for (auto& [savings, structure] : by_savings)
    if (best.size() < kMostStructures) best.push_back(std::move(structure));
  return best;
}

/// The structure as a function: every argument another, or all of them one.
SharedFunction as_function(const Tree& structure, bool one_argument) {
  SharedFunction function{structure, 0};
  function.coefficients = static_cast<int>(std::ranges::count(structure, Primitive::constant, &Node::primitive));
  std::uint8_t coefficient = 0, argument = static_cast<std::uint8_t>(function.coefficients);
  for (Node& node : function.body) {
    if (node.primitive == Primitive::constant)
      node = {Primitive::variable, coefficient++, 0.0};
    else if (node.primitive == Primitive::variable)
      node.variable = one_argument ? argument : argument++;
  }
  return function;
}

std::vector<SharedFunction> candidates_among(std::span<const std::vector<Tree>> forms) {
  std::vector<SharedFunction> candidates;
  for (const Tree& structure : promising(forms)) {
    const auto arguments = std::ranges::count(structure, Primitive::variable, &Node::primitive);
    for (const bool one : {true, false}) {
      if (one && arguments < 2) continue;
      SharedFunction function = as_function(structure, one);
      const bool is_wanted = function.coefficients > 0 && arity(function) - function.coefficients <= kMostArguments;
      if (is_wanted && !find_fault(function)) candidates.push_back(std::move(function));
    }
  }
  return candidates;
}

/// Nodes and calls of all formulas and definitions; a definition has its body and its name.
std::size_t length_with(std::span<const std::vector<Tree>> forms, std::span<const SharedFunction> functions) {
  std::size_t length = 0;
  for (const SharedFunction& function : functions) length += function.body.size() + 1;
  for (const std::vector<Tree>& of_joint : forms)
    for (const Tree& form : of_joint) length += folded_size(form, functions);
  return length;
}

/// Whether formulas of two joints call the last of the functions.
bool is_shared(std::span<const std::vector<Tree>> forms, std::span<const SharedFunction> functions) {
  const auto calls_last = [&](const Tree& form) {
    const std::vector<std::size_t> called = functions_called(folded(form, functions));
    return !called.empty() && called.back() + 1 == functions.size();
  };
  const auto joint_calls = [&](const std::vector<Tree>& of_joint) { return std::ranges::any_of(of_joint, calls_last); };
  return std::ranges::count_if(forms, joint_calls) >= 2;
}

std::vector<std::vector<Tree>> forms_of(std::span<const std::vector<Tree>> formulas) {
  std::vector<std::vector<Tree>> forms;
  for (const std::vector<Tree>& of_joint : formulas) {
    std::set<Tree, Precedes> different;
    for (const Tree& formula : of_joint) different.insert(with_numbered_constants(block_form(formula)));
    forms.emplace_back(different.begin(), different.end());
  }
  return forms;
}

}  // namespace

std::vector<SharedFunction> find_shared_functions(std::span<const std::vector<Tree>> formulas, std::size_t most) {
  const std::vector<std::vector<Tree>> forms = forms_of(formulas);
  const std::vector<SharedFunction> candidates = candidates_among(forms);
  std::vector<SharedFunction> chosen;
  std::size_t length = length_with(forms, chosen);
  while (chosen.size() < most) {
    std::vector<SharedFunction> best;
    for (const SharedFunction& candidate : candidates) {
      std::vector<SharedFunction> with = chosen;
      with.push_back(candidate);
      const std::size_t shorter = length_with(forms, with);
      if (shorter >= length || !is_shared(forms, with)) continue;
      length = shorter;
      best = std::move(with);
    }
    if (best.empty()) break;
    chosen = std::move(best);
  }
  return chosen;
}

}  // namespace demecal::inline evolution
