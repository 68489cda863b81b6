// Draws that workers and this process make together: of a piece the first result is taken, for all are the same.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

#include "draws/draw_work.hpp"
#include "protocol/messages.hpp"
#include "scheduling/evolution_run.hpp"

namespace demecal::inline scheduling {

/// Pieces as they are made; from any thread. As the observer of a run it takes those of workers.
class SharedDraws final : public RunObserver {
 public:
  explicit SharedDraws(std::size_t pieces) : pieces_(pieces) {}

  void on_outcome(const Outcome& outcome) override;
  /// Makes what nobody has made yet, the last piece first: workers begin with the first ones. Returns all, in order.
  std::vector<std::vector<double>> make_rest(const DrawWork& work);
  std::size_t made_elsewhere() const;

 private:
  bool is_made(std::size_t piece) const;
  void put(std::size_t piece, std::vector<double> numbers);

  mutable std::mutex mutex_;
  std::vector<std::optional<std::vector<double>>> pieces_;
  std::size_t made_elsewhere_ = 0;
};

}  // namespace demecal::inline scheduling
