// A piece of draws as islands are hosted: nothing is bred, and nobody exchanges anything.
#pragma once

#include <cstdint>
#include <functional>

#include "draws/draw_work.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/island.hpp"
#include "evolution/population.hpp"

namespace demecal::inline hosting {

/// Its first epoch, in which others found populations, does nothing; the second and last makes the piece.
class DrawIsland {
 public:
  /// Keeps the work by reference.
  DrawIsland(const DrawWork& work, IslandKey key) : work_(work), key_(key) {}

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

  const DrawWork& work_;
  IslandKey key_;
  IslandState state_;
};

}  // namespace demecal::inline hosting
