// Crossover and mutation on whole trees by the plainest means: what the shared form must reproduce.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "evolution/tree_generation.hpp"

namespace demecal {

class PrefixVariation {
 public:
  PrefixVariation(const GpParameters& parameters, int variables)
      : parameters_(parameters), nodes_(node_set(parameters, variables)) {}

  bool cross(RandomStream& random, const Tree& mother, const Tree& father, Tree& daughter, Tree& son) const {
    for (int attempt = 0; attempt < parameters_.invalid_attempts; ++attempt) {
      const std::size_t hers = point(random, mother, parameters_.terminal_crossover_rate);
      const std::size_t his = point(random, father, parameters_.terminal_crossover_rate);
      const Tree her_part = part(mother, hers), his_part = part(father, his);
      const Tree one = replaced(mother, hers, his_part), other = replaced(father, his, her_part);
      if (!is_within(one) || !is_within(other) || her_part == his_part) continue;
      daughter = one;
      son = other;
      return true;
    }
    return false;
  }

  bool mutate(RandomStream& random, Tree& tree) const {
    for (int attempt = 0; attempt < parameters_.invalid_attempts; ++attempt) {
      const bool shrink = random.chance(parameters_.shrink_mutation_rate) && tree.size() > 1;
      const std::size_t place = point(random, tree, shrink ? 0.0 : parameters_.terminal_mutation_rate);
      const int deepest = shrink ? depth(part(tree, place)) - 1 : parameters_.max_tree_depth - level(tree, place);
      Tree grown;
      append_grown(random, nodes_, deepest, grown);
      const Tree mutated = replaced(tree, place, grown);
      if (!is_within(mutated) || part(tree, place) == grown) continue;
      tree = mutated;
      return true;
    }
    return false;
  }

 private:
  static Tree part(const Tree& tree, std::size_t place) {
    const auto begin = tree.begin();
    return {begin + static_cast<std::ptrdiff_t>(place), begin + static_cast<std::ptrdiff_t>(subtree_end(tree, place))};
  }
  static Tree replaced(Tree tree, std::size_t place, const Tree& replacement) {
    const auto begin = tree.begin() + static_cast<std::ptrdiff_t>(place);
    const auto end = tree.begin() + static_cast<std::ptrdiff_t>(subtree_end(tree, place));
    tree.insert(tree.erase(begin, end), replacement.begin(), replacement.end());
    return tree;
  }
  static int level(const Tree& tree, std::size_t place) {
    int ancestors = 0;
    for (std::size_t above = 0; above < place; ++above) ancestors += subtree_end(tree, above) > place ? 1 : 0;
    return ancestors;
  }
  static std::size_t point(RandomStream& random, const Tree& tree, double terminal_rate) {
    std::vector<std::size_t> terminals, functions;
    for (std::size_t i = 0; i < tree.size(); ++i) (arity(tree[i].primitive) == 0 ? terminals : functions).push_back(i);
    const bool terminal = random.chance(terminal_rate) || functions.empty();
    const std::vector<std::size_t>& places = terminal ? terminals : functions;
    return places[random.index(places.size())];
  }
  bool is_within(const Tree& tree) const {
    return parameters_.min_tree_depth <= depth(tree) && depth(tree) <= parameters_.max_tree_depth &&
           (parameters_.max_tree_nodes == 0 || tree.size() <= static_cast<std::size_t>(parameters_.max_tree_nodes));
  }

  GpParameters parameters_;
  NodeSet nodes_;
};

}  // namespace demecal
