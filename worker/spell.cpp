#include "worker/spell.hpp"

#include <set>
#include <utility>

namespace demecal {

Spell::Spell(std::vector<Member> members, MigrantStore arrived)
    : members_(std::move(members)), arrived_(std::move(arrived)) {
  for (Member& member : members_) member.began = member.tenancy->epoch();
}

void Spell::breed(std::chrono::steady_clock::duration budget, const std::function<void()>& beat) {
  const auto end = std::chrono::steady_clock::now() + budget;
  while (const Member* member = next()) {
    Tenancy& tenancy = *member->tenancy;
    tenancy.run_epoch(tenancy.immigrants(arrived_), beat);
    arrived_.put(tenancy.last_migrants());
    ended_ = tenancy.epoch_ended();
    if (ends_ || ended_ >= end || member->is_awaited || tenancy.epoch() - member->began >= kMostEpochs) return;
  }
}

const Spell::Member* Spell::next() const {
  const Member* slowest = nullptr;
  for (const Member& member : members_) {
    if (member.tenancy->finished() || (slowest && slowest->tenancy->epoch() <= member.tenancy->epoch())) continue;
    if (member.tenancy->is_ready(arrived_)) slowest = &member;
  }
  return slowest;
}

std::vector<std::shared_ptr<Tenancy>> linked_with(const std::shared_ptr<Tenancy>& island,
                                                  const std::map<IslandKey, std::shared_ptr<Tenancy>>& tenancies) {
  std::vector<std::shared_ptr<Tenancy>> linked{island};
  std::set<IslandKey> seen{island->island()};
  const auto reach = [&](const std::vector<IslandKey>& neighbours) {
    for (const IslandKey& neighbour : neighbours) {
      const auto found = tenancies.find(neighbour);
      if (found != tenancies.end() && seen.insert(neighbour).second) linked.push_back(found->second);
    }
  };
  for (std::size_t i = 0; i < linked.size(); ++i) {
    const std::shared_ptr<Tenancy> member = linked[i];
    reach(member->sources());
    reach(member->consumers());
  }
  return linked;
}

}  // namespace demecal
