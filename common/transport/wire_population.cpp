#include "transport/wire_population.hpp"

#include <cmath>
#include <utility>

namespace demecal {
namespace {

constexpr std::size_t kMostNodes = 65535;

/// Each element decoded, or nothing where one cannot be.
template <class Plain, class Wire>
std::optional<std::vector<Plain>> decode_each(const std::vector<Wire>& elements) {
  std::vector<Plain> decoded;
  decoded.reserve(elements.size());
  for (const Wire& element : elements) {
    auto plain = demecal::decode(element);
    if (!plain) return std::nullopt;
    decoded.push_back(std::move(*plain));
  }
  return decoded;
}

}  // namespace

wire::Formula encode(const Tree& tree) {
  wire::Formula formula;
  formula.primitives().reserve(tree.size());
  for (const Node& node : tree) {
    formula.primitives().push_back(static_cast<std::uint8_t>(node.primitive));
    if (node.primitive == Primitive::variable) formula.variables().push_back(node.variable);
    if (node.primitive == Primitive::constant) formula.constants().push_back(node.value);
  }
  return formula;
}

std::optional<Tree> decode(const wire::Formula& formula) {
  if (formula.primitives().size() > kMostNodes) return std::nullopt;
  auto variable = formula.variables().begin();
  auto constant = formula.constants().begin();
  Tree tree;
  tree.reserve(formula.primitives().size());
  for (const std::uint8_t code : formula.primitives()) {
    if (code >= kPrimitives.size()) return std::nullopt;
    Node node{static_cast<Primitive>(code)};
    if (node.primitive == Primitive::variable) {
      if (variable == formula.variables().end()) return std::nullopt;
      node.variable = *variable++;
    }
    if (node.primitive == Primitive::constant) {
      if (constant == formula.constants().end() || !std::isfinite(*constant)) return std::nullopt;
      node.value = *constant++;
    }
    tree.push_back(node);
  }
  if (variable != formula.variables().end() || constant != formula.constants().end()) return std::nullopt;
  return tree;
}

std::optional<Individual> decode(const wire::Individual& individual) {
  auto tree = decode(individual.formula());
  if (!tree) return std::nullopt;
  return Individual{std::move(*tree), individual.fitness()};
}

std::vector<wire::Individual> encode(const Population& population) {
  std::vector<wire::Individual> encoded(population.size());
  for (std::size_t i = 0; i < population.size(); ++i) {
    encoded[i].formula(encode(population[i].tree));
    encoded[i].fitness(population[i].fitness);
  }
  return encoded;
}

std::optional<Population> decode(const std::vector<wire::Individual>& population) {
  return decode_each<Individual>(population);
}

wire::IslandState encode(const IslandState& state) {
  wire::IslandState encoded;
  encoded.epoch(state.epoch);
  encoded.generation(state.generation);
  encoded.evaluations(state.evaluations);
  encoded.migrants_taken(state.migrants_taken);
  encoded.population(encode(state.population));
  encoded.front(encode(state.front));
  encoded.without_gain(state.without_gain);
  return encoded;
}

std::optional<IslandState> decode(const wire::IslandState& state) {
  auto population = decode(state.population());
  auto front = decode(state.front());
  if (!population || !front) return std::nullopt;
  return IslandState{state.epoch(),          state.generation(), state.evaluations(), state.migrants_taken(),
                     std::move(*population), std::move(*front),  state.without_gain()};
}

std::vector<wire::Migrants> encode(const std::vector<Migrants>& emigrations) {
  std::vector<wire::Migrants> encoded;
  encoded.reserve(emigrations.size());
  for (const Migrants& migrants : emigrations) encoded.push_back(encode(migrants));
  return encoded;
}

std::optional<std::vector<Migrants>> decode(const std::vector<wire::Migrants>& emigrations) {
  return decode_each<Migrants>(emigrations);
}

}  // namespace demecal
