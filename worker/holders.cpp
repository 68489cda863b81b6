#include "worker/holders.hpp"

namespace demecal {
namespace {

constexpr std::size_t kMostNamed = 1024;

}  // namespace

bool Holders::name(const IslandTask& task) {
  std::set<std::string>& given = holders_[{task.run, task.island}].given;
  return given.size() < kMostNamed && given.insert(task.worker).second;
}

bool Holders::give(const IslandTask& task) {
  Holder& holder = holders_[{task.run, task.island}];
  if (task.attempt <= holder.attempt) return false;
  holder.attempt = task.attempt;
  holder.worker = task.worker;
  return true;
}

bool Holders::is_elsewhere(const Place& place, const std::string& worker) const {
  const auto holder = holders_.find(place);
  return holder != holders_.end() && holder->second.attempt > 0 && holder->second.worker != worker;
}

bool Holders::was_given(const Place& place, const std::string& worker) const {
  const auto holder = holders_.find(place);
  return holder != holders_.end() && holder->second.given.contains(worker);
}

std::set<std::string> Holders::forget(RunId run) {
  std::set<std::string> given;
  for (auto holder = holders_.begin(); holder != holders_.end();) {
    if (holder->first.first != run) {
      ++holder;
      continue;
    }
    given.merge(holder->second.given);
    holder = holders_.erase(holder);
  }
  return given;
}

}  // namespace demecal
