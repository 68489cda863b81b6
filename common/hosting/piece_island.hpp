// A piece of work as islands are hosted: nothing is bred, and nobody exchanges anything.
#pragma once

#include <cstdint>
#include <functional>

#include "evolution/archipelago.hpp"
#include "evolution/island.hpp"
#include "evolution/population.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline hosting {

/// Its first epoch, in which others found populations, does nothing; the second and last makes the piece.
class PieceIsland {
 public:
  /// Keeps the work by reference.
  PieceIsland(const SharedWork& work, IslandKey key) : work_(work), key_(key) {}

  IslandKey key() const { return key_; }
  bool finished() const { return state_.epoch >= kEpochs; }
  void run_epoch(const Population& /*immigrants*/, const std::function<void()>& heartbeat) {
    if (heartbeat) heartbeat();
    if (++state_.epoch < kEpochs) return;
    state_.numbers = work_.piece(key_.deme);
    state_.generation = 1;
  }
  Population emigrants() const { return {}; }
  IslandFigures figures() const { return {}; }
  const IslandState& state() const { return state_; }
  void restore(const IslandState& state) { state_ = state; }

 private:
  static constexpr std::uint32_t kEpochs = 2;

  const SharedWork& work_;
  IslandKey key_;
  IslandState state_;
};

}  // namespace demecal::inline hosting
