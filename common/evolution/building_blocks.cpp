#include "evolution/building_blocks.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "errors/check.hpp"
#include "expression/simplify.hpp"
#include "expression/tree.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline evolution {
namespace {

const Node kConstant{Primitive::variable, 0, 0.0};

bool is_unknown_constant(const Tree& form) {
  return form == Tree{kConstant};
}

/// Whether the form is the unknown constant and something else under `function`.
bool holds_constant(const Tree& form, Primitive function) {
  return form.front().primitive == function && (form[1] == kConstant || form.back() == kConstant) &&
         (form[1] == kConstant || subtree_end(form, 1) + 1 == form.size());
}

/// Of two arguments in canonical form.
Tree apply_canonically(Primitive function, Tree a, Tree b) {
  if (is_unknown_constant(a) && is_unknown_constant(b)) return a;
  if (is_unknown_constant(b) && function == Primitive::subtract) function = Primitive::add;
  if (is_unknown_constant(b) && function == Primitive::divide) function = Primitive::multiply;
  if (!is_commutative(function)) return apply(function, a, b);
  if (is_unknown_constant(a) && holds_constant(b, function)) return b;
  if (is_unknown_constant(b) && holds_constant(a, function)) return a;
  return apply_in_order(function, a, b);
}

/// Of the subtree that begins at `position`, which is moved behind it.
Tree form_from(const Tree& formula, std::size_t& position) {
  const Node& node = formula[position++];
  if (node.primitive == Primitive::constant) return {kConstant};
  if (node.primitive == Primitive::variable) {
    DEMECAL_CHECK(node.variable < 255, "a formula of more than 254 variables");
    return variable_tree(static_cast<std::uint8_t>(node.variable + 1));
  }
  Tree first = form_from(formula, position);
  if (arity(node.primitive) == 1) return is_unknown_constant(first) ? first : apply(node.primitive, std::move(first));
  Tree second = form_from(formula, position);
  return apply_canonically(node.primitive, std::move(first), std::move(second));
}

bool is_block(std::span<const Node> form) {
  return form.front().primitive != Primitive::variable;
}

/// What is known of a form.
struct FormOccurrences {
  std::set<std::uint32_t> joints;
  std::size_t islands = 0, individuals = 0;
  double rank_shares = 0.0;
  std::size_t last_island = 0;  ///< counted, from 1
  std::map<Tree, std::size_t, Precedes>
      individuals_within;  ///< next larger forms, and how many individuals have it there
};
using Forms = std::map<Tree, FormOccurrences, Precedes>;

/// Every block of a canonical form, and the forms it stands in directly.
std::map<Tree, std::set<Tree, Precedes>, Precedes> blocks_of(const Tree& form) {
  std::map<Tree, std::set<Tree, Precedes>, Precedes> blocks;
  const auto part = [&](std::size_t begin) {
    return Tree(form.begin() + static_cast<std::ptrdiff_t>(begin),
                form.begin() + static_cast<std::ptrdiff_t>(subtree_end(form, begin)));
  };
  for (std::size_t i = 0; i < form.size(); ++i) {
    if (form[i].primitive == Primitive::variable) continue;
    const Tree whole = part(i);
    blocks[whole];
    std::size_t argument = i + 1;
    for (int k = 0; k < arity(form[i].primitive); ++k) {
      const Tree inner = part(argument);
      if (is_block(inner)) blocks[inner].insert(whole);
      argument += inner.size();
    }
  }
  return blocks;
}

void count_blocks(const IslandFront& front, std::size_t island, Forms& forms) {
  for (const Individual& member : front.members) {
    const auto worse = [&](const Individual& other) { return other.fitness > member.fitness; };
    const auto beaten = static_cast<double>(std::count_if(front.members.begin(), front.members.end(), worse));
    const double others = std::max(1.0, static_cast<double>(front.members.size()) - 1.0);
    for (const auto& [block, within] : blocks_of(block_form(member.tree))) {
      FormOccurrences& occurrences = forms[block];
      occurrences.joints.insert(front.joint);
      if (std::exchange(occurrences.last_island, island) != island) ++occurrences.islands;
      ++occurrences.individuals;
      occurrences.rank_shares += beaten / others;
      for (const Tree& larger : within) ++occurrences.individuals_within[larger];
    }
  }
}

/// Whether all individuals with the form have it within one and the same larger form.
bool stands_alone(const FormOccurrences& occurrences) {
  return std::none_of(occurrences.individuals_within.begin(), occurrences.individuals_within.end(),
                      [&](const auto& within) { return within.second == occurrences.individuals; });
}

std::size_t functions_in(const Tree& form) {
  return static_cast<std::size_t>(
      std::count_if(form.begin(), form.end(), [](const Node& node) { return node.primitive != Primitive::variable; }));
}

}  // namespace

Tree block_form(const Tree& formula) {
  const Tree simple = simplified(formula);
  std::size_t position = 0;
  return form_from(simple, position);
}

std::string block_text(const Tree& form, const VariableNames& names) {
  VariableNames with_constant{"c"};
  with_constant.insert(with_constant.end(), names.begin(), names.end());
  return to_string(form, with_constant);
}

std::vector<BuildingBlock> building_blocks(std::span<const IslandFront> fronts, const BlockLimits& limits) {
  Forms forms;
  for (std::size_t i = 0; i < fronts.size(); ++i) count_blocks(fronts[i], i + 1, forms);
  std::vector<BuildingBlock> blocks;
  for (const auto& [form, occurrences] : forms) {
    if (occurrences.joints.size() < limits.least_joints || functions_in(form) < limits.least_functions) continue;
    if (!stands_alone(occurrences)) continue;
    const double share = occurrences.rank_shares / static_cast<double>(occurrences.individuals);
    blocks.push_back({form, occurrences.joints.size(), occurrences.islands, occurrences.individuals, share});
  }
  const auto more = [](const BuildingBlock& a, const BuildingBlock& b) {
    const auto size = [](const BuildingBlock& block) {
      return std::tuple(block.joints, block.islands, block.individuals, block.form.size());
    };
    return size(a) != size(b) ? size(a) > size(b) : precedes(a.form, b.form);
  };
  std::sort(blocks.begin(), blocks.end(), more);
  return blocks;
}

}  // namespace demecal::inline evolution
