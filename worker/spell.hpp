// A spell of work: some epochs of neighbouring islands, bred by one slot without a word to anybody.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "worker/migrant_store.hpp"
#include "worker/tenancy.hpp"

namespace demecal {

/// Handing an island to a slot and back costs as much as a good part of a short epoch, so a slot keeps islands that
/// need nobody else for a while: each finds its neighbours' migrants within the spell.
class Spell {
 public:
  /// What an island of the spell did in it.
  struct Member {
    std::shared_ptr<Tenancy> tenancy;
    bool is_awaited;          ///< by an island of another worker: the spell ends after an epoch of it
    std::uint32_t began = 0;  ///< its epoch before the spell
  };

  /// `arrived` has what the members lack of others. No other thread may touch the members until the spell is over.
  Spell(std::vector<Member> members, MigrantStore arrived);

  /// Breeds whichever island is farthest behind of those that can go on, until `budget` is over, none can, an awaited
  /// island has bred or one has bred kMostEpochs; at least one epoch where any can. `beat` as for Tenancy::run_epoch.
  void breed(std::chrono::steady_clock::duration budget, const std::function<void()>& beat);

  /// Ends after the present epoch; from any thread.
  void end_soon() { ends_ = true; }

  std::span<const Member> members() const { return members_; }
  /// When its last epoch ended.
  WaitedShare::Time ended() const { return ended_; }

 private:
  /// Of each island, before others hear of it: well below what neighbours keep migrants of.
  static constexpr std::uint32_t kMostEpochs = kMigrantEpochs / 4;

  const Member* next() const;

  std::vector<Member> members_;
  MigrantStore arrived_;
  WaitedShare::Time ended_{};
  std::atomic<bool> ends_{false};
};

/// Those of `tenancies`, islands of one run, that `island` is linked with by who takes migrants from whom, over any
/// number of steps among them; itself first.
std::vector<std::shared_ptr<Tenancy>> linked_with(const std::shared_ptr<Tenancy>& island,
                                                  const std::map<IslandKey, std::shared_ptr<Tenancy>>& tenancies);

}  // namespace demecal
