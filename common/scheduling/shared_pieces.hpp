// Work that workers and this process do together: of a piece the first result is taken, for all are the same.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

#include "protocol/messages.hpp"
#include "scheduling/evolution_run.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline scheduling {

/// Pieces as they are done; from any thread. As the observer of a run it takes those of workers.
class SharedPieces final : public RunObserver {
 public:
  explicit SharedPieces(std::size_t pieces) : pieces_(pieces) {}

  void on_outcome(const Outcome& outcome) override;
  /// Does the last piece. How long all others would take one thread, s: as they give more numbers.
  double do_last(const SharedWork& work);
  /// Does what nobody has done yet, the last piece first: workers begin with the first ones. Returns all, in order.
  std::vector<std::vector<double>> do_rest(const SharedWork& work);
  std::size_t done_elsewhere() const;

 private:
  bool is_done(std::size_t piece) const;
  void put(std::size_t piece, std::vector<double> numbers);

  mutable std::mutex mutex_;
  std::vector<std::optional<std::vector<double>>> pieces_;
  std::size_t done_elsewhere_ = 0;
};

}  // namespace demecal::inline scheduling
