#include "transport/mailbox.hpp"

namespace demecal {
namespace {

constexpr std::size_t kText_bytes = 256;  ///< a message's texts are bounded

struct Weight {
  std::size_t operator()(const Tree& tree) const { return sizeof tree + tree.size() * sizeof(Node); }
  std::size_t operator()(const Population& population) const {
    std::size_t bytes = population.size() * sizeof(double);
    for (const Individual& individual : population) bytes += (*this)(individual.tree);
    return bytes;
  }
  std::size_t operator()(const std::vector<Migrants>& emigrations) const {
    std::size_t bytes = 0;
    for (const Migrants& migrants : emigrations) bytes += (*this)(migrants);
    return bytes;
  }
  std::size_t operator()(const IslandState& state) const { return (*this)(state.population) + (*this)(state.front); }

  std::size_t operator()(const Migrants& m) const { return sizeof m + kText_bytes + (*this)(m.individuals); }
  std::size_t operator()(const IslandTask& m) const {
    return sizeof m + kText_bytes + (*this)(m.start) + (*this)(m.recent);
  }
  std::size_t operator()(const Checkpoint& m) const {
    return sizeof m + kText_bytes + (*this)(m.state) + (*this)(m.recent);
  }
  std::size_t operator()(const Progress& m) const {
    return sizeof m + kText_bytes + m.before.size() * sizeof(EpochFigures);
  }
  std::size_t operator()(const Outcome& m) const { return sizeof m + kText_bytes + (*this)(m.front); }
  std::size_t operator()(const CalibrationData& m) const {
    std::size_t bytes = sizeof m + kText_bytes;
    for (const SharedFunction& function : m.parameters.shared_functions) bytes += (*this)(function.body);
    for (const TrainingTable& table : m.tables) {
      bytes += sizeof table + (table.target.size() + table.weight.size()) * sizeof(double);
      for (const auto& column : table.variables) bytes += sizeof column + column.size() * sizeof(double);
      for (const Tree& seed : table.seeds) bytes += (*this)(seed);
    }
    return bytes;
  }
  template <class Small>
  std::size_t operator()(const Small& message) const {
    return sizeof message + 4 * kText_bytes;
  }
};

}  // namespace

std::size_t weight_bytes(const Message& message) {
  return std::visit(Weight{}, message);
}

}  // namespace demecal
