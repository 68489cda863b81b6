#include "evolution/variation.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace demecal {
namespace {

std::size_t any_of(RandomStream& random, const std::vector<std::uint32_t>& places) {
  return places[random.index(places.size())];
}

std::size_t draw_point(RandomStream& random, const TreeShape& shape, double terminal_rate) {
  const bool terminal = random.chance(terminal_rate);
  return any_of(random, terminal || shape.functions().empty() ? shape.terminals() : shape.functions());
}

std::span<const Node> subtree(const Tree& tree, const TreeShape& shape, std::size_t point) {
  return std::span(tree).subspan(point, shape.end(point) - point);
}

/// `tree` with `replacement` in the place of the subtree at `point`, into `result`.
void replace(const Tree& tree, const TreeShape& shape, std::size_t point, std::span<const Node> replacement,
             Tree& result) {
  const auto begin = tree.begin();
  result.assign(begin, begin + static_cast<std::ptrdiff_t>(point));
  result.insert(result.end(), replacement.begin(), replacement.end());
  result.insert(result.end(), begin + static_cast<std::ptrdiff_t>(shape.end(point)), tree.end());
}

}  // namespace

Variation::Variation(const GpParameters& parameters, int variables)
    : parameters_(parameters), nodes_(node_set(parameters, variables)) {}

bool Variation::is_valid_depth(int depth) const {
  return parameters_.min_tree_depth <= depth && depth <= parameters_.max_tree_depth;
}

bool Variation::cross(RandomStream& random, const Tree& mother, const Tree& father, Tree& daughter, Tree& son) {
  const TreeShape &hers = mother_shape_, &his = father_shape_;
  mother_shape_.measure(mother);
  father_shape_.measure(father);
  for (int attempt = 0; attempt < parameters_.invalid_attempts; ++attempt) {
    const std::size_t her_point = draw_point(random, hers, parameters_.terminal_crossover_rate);
    const std::size_t his_point = draw_point(random, his, parameters_.terminal_crossover_rate);
    if (!is_valid_depth(hers.depth_with(her_point, his.subtree_depth(his_point)))) continue;
    if (!is_valid_depth(his.depth_with(his_point, hers.subtree_depth(her_point)))) continue;
    if (std::ranges::equal(subtree(mother, hers, her_point), subtree(father, his, his_point))) continue;
    replace(mother, hers, her_point, subtree(father, his, his_point), daughter);
    replace(father, his, his_point, subtree(mother, hers, her_point), son);
    return true;
  }
  return false;
}

std::size_t Variation::mutation_point(RandomStream& random, bool shrink) const {
  return draw_point(random, mother_shape_, shrink ? 0.0 : parameters_.terminal_mutation_rate);
}

bool Variation::mutate(RandomStream& random, Tree& tree) {
  const TreeShape& shape = mother_shape_;
  mother_shape_.measure(tree);
  for (int attempt = 0; attempt < parameters_.invalid_attempts; ++attempt) {
    const bool shrink = random.chance(parameters_.shrink_mutation_rate) && !shape.functions().empty();
    const std::size_t point = mutation_point(random, shrink);
    const int deepest = shrink ? shape.subtree_depth(point) - 1 : parameters_.max_tree_depth - shape.level(point);
    grown_.clear();
    if (!is_valid_depth(shape.depth_with(point, append_grown(random, nodes_, deepest, grown_)))) continue;
    if (std::ranges::equal(subtree(tree, shape, point), grown_)) continue;
    replace(tree, shape, point, grown_, mutated_);
    std::swap(tree, mutated_);
    return true;
  }
  return false;
}

}  // namespace demecal
