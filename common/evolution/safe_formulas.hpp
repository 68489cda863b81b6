// Which formulas surely stay within a table's limit, whatever its variable is between its least and greatest row.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "evolution/fitness.hpp"
#include "expression/limit.hpp"
#include "expression/node_store.hpp"

namespace demecal {

/// Judges formulas of one store by interval arithmetic, and remembers: a pole that cannot be excluded is beyond every
/// limit. Without a limit all are safe.
class SafeFormulas {
 public:
  explicit SafeFormulas(const TrainingTable& table);

  bool is_on() const { return is_on_; }
  bool operator()(const NodeStore& store, NodeId root);
  /// Drops what is known of nodes that the store dropped.
  void forget(std::span<const NodeId> dropped);

 private:
  enum class Verdict : std::uint8_t { unknown, safe, unsafe };

  bool is_on_;
  double limit_;
  Interval range_;
  std::vector<Verdict> known_;  ///< by node
  Tree tree_;
};

}  // namespace demecal
