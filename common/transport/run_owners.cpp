#include "transport/run_owners.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>
#include <variant>

#include "protocol/message_bytes.hpp"

namespace demecal::inline transport {
namespace {

constexpr std::ptrdiff_t kMostRuns = 48;  ///< of one owner at a time
constexpr std::size_t kMostOver = 64;     ///< runs that are over, or whose owner is gone
constexpr std::size_t kMostEarly = 4096, kMostEarly_bytes = 256 << 20;

/// Whether a message takes the place of one of the same key: an end stays, and so does the higher attempt.
bool is_newer(const Message& message, const Message& before) {
  const auto* task = std::get_if<IslandTask>(&message);
  return task != nullptr ? task->attempt > std::get<IslandTask>(before).attempt : ended_run(before) == 0;
}

}  // namespace

void RunOwners::put(const ParticipantId& source, const std::string& name, Message message) {
  if (!mailbox_.put(source, std::move(message))) rejections_.add(name, "more than can be kept");
}

void RunOwners::receive(const ParticipantId& source, const std::string& name, CalibrationData data, Time) {
  const std::lock_guard lock(mutex_);
  const RunId run = data.run;
  const auto known = runs_.find(run);
  const bool may_own = known == runs_.end() ? may_publish(source, run) : known->second.owner == source;
  if (!may_own) return rejections_.add(name, "data of a run that is another's");
  if (known == runs_.end() && !has_room(source)) return rejections_.add(name, "more runs than one may have at a time");
  Run& owned = runs_.try_emplace(run, Run{.owner = source, .order = ++order_}).first->second;
  owned.owner_gone.reset();
  put(source, name, std::move(data));
  give_early(run, source, name);
  forget_first_of_many();
}

void RunOwners::receive(const ParticipantId& source, const std::string& name, IslandTask task, Time now) {
  const std::lock_guard lock(mutex_);
  const RunId run = task.run;
  Message message(std::move(task));
  if (is_settled(source, name, message, run)) return;
  if (runs_.contains(run) || !may_publish(source, run))
    return rejections_.add(name, "a task of a run that is another's");
  wait(source, name, std::move(message), now);
}

void RunOwners::receive(const ParticipantId& source, const std::string& name, Control control, Time now) {
  const std::lock_guard lock(mutex_);
  if (is_settled(source, name, control, control.run)) return;
  const auto known = runs_.find(control.run);
  const bool ends = control.state != Control::State::running;
  if (known == runs_.end() && may_publish(source, control.run)) return wait(source, name, std::move(control), now);
  // A coordinator that resumes a job ends the runs of its predecessors, also for workers that never knew them or know
  // it already: no source is named.
  if (known == runs_.end() || !ends || known->second.end_from_elsewhere)
    return rejections_.add(ends ? "" : name, "control of a run that is another's");
  if (!known->second.owner_gone) {
    known->second.end_from_elsewhere = std::move(control);
    return;
  }
  known->second.is_over = true;
  put(source, name, std::move(control));
}

bool RunOwners::is_settled(const ParticipantId& source, const std::string& name, const Message& message, RunId run) {
  const auto known = runs_.find(run);
  const bool may_publish_it = known == runs_.end() ? !waits_ : known->second.owner == source;
  if (may_publish_it && known != runs_.end() && ended_run(message) != 0) known->second.is_over = true;
  if (may_publish_it) put(source, name, message);
  return may_publish_it;
}

/// Replaces what the source published under this key before.
void RunOwners::wait(const ParticipantId& source, const std::string& name, Message message, Time now) {
  Early& early = early_[source];
  const TopicKey key = key_of(message);
  if (const auto before = early.last.find(key); before != early.last.end()) {
    if (!is_newer(message, before->second.message)) return;
    take_back(early, before);
  }
  const std::size_t bytes = weight_bytes(message);
  if (early.last.size() >= kMostEarly || early.bytes + bytes > kMostEarly_bytes) {
    return rejections_.add(name, "more of runs without data than can be kept");
  }
  early.bytes += bytes;
  early.last.emplace(key, Early::Entry{std::move(message), now});
}

Message RunOwners::take_back(Early& early, std::map<TopicKey, Early::Entry>::iterator entry) {
  Message message = std::move(entry->second.message);
  early.bytes -= weight_bytes(message);
  early.last.erase(entry);
  return message;
}

/// What waited for this run's data: the owner's is put, of others' an end is kept.
void RunOwners::give_early(RunId run, const ParticipantId& owner, const std::string& name) {
  for (auto& [source, early] : early_) {
    for (auto entry = early.last.begin(); entry != early.last.end();) {
      const auto next = std::next(entry);
      if (entry->first.run == run) {
        Message message = take_back(early, entry);
        if (source == owner) {
          runs_.at(run).is_over |= ended_run(message) != 0;
          put(source, name, std::move(message));
        } else if (ended_run(message) != 0) {
          runs_.at(run).end_from_elsewhere = std::get<Control>(std::move(message));
        } else {
          rejections_.add("participant " + to_string(source), "of a run that is another's");
        }
      }
      entry = next;
    }
  }
  std::erase_if(early_, [](const auto& entry) { return entry.second.last.empty(); });
}

void RunOwners::arrived(const ParticipantId& source) {
  const std::lock_guard lock(mutex_);
  for (auto& [number, run] : runs_)
    if (run.owner == source) run.owner_gone.reset();
}

void RunOwners::departed(const ParticipantId& source, Time now) {
  const std::lock_guard lock(mutex_);
  for (auto& [number, run] : runs_) {
    if (run.owner != source) continue;
    run.owner_gone = now;
    if (auto end = std::exchange(run.end_from_elsewhere, std::nullopt)) {
      run.is_over = true;
      put(source, "nobody", std::move(*end));
    }
  }
  const auto early = early_.find(source);
  if (early == early_.end()) return;
  // A coordinator that ends a run leaves soon after: the end counts.
  for (auto entry = early->second.last.begin(); entry != early->second.last.end();) {
    const auto next = std::next(entry);
    if (ended_run(entry->second.message) == 0) take_back(early->second, entry);
    entry = next;
  }
}

void RunOwners::end_abandoned(Time now) {
  for (auto& [number, run] : runs_) {
    if (run.is_over || !run.owner_gone || now - *run.owner_gone < kLongestAbsence) continue;
    run.is_over = true;
    put(run.owner, "nobody", Control{number, Control::State::cancelled, ""});
  }
}

void RunOwners::release(Time now) {
  const std::lock_guard lock(mutex_);
  if (waits_) end_abandoned(now);
  for (auto& [source, early] : early_) {
    for (auto entry = early.last.begin(); entry != early.last.end();) {
      const auto next = std::next(entry);
      if (ended_run(entry->second.message) != 0 && now - entry->second.came >= kLateGrace) {
        put(source, "participant " + to_string(source), take_back(early, entry));
      }
      entry = next;
    }
  }
  std::erase_if(early_, [](const auto& entry) { return entry.second.last.empty(); });
}

bool RunOwners::has_room(const ParticipantId& owner) const {
  return std::ranges::count_if(
             runs_, [&](const auto& run) { return run.second.owner == owner && !run.second.is_over; }) < kMostRuns;
}

/// Of the runs that are over or left by their owners the one that appeared first, where they are many. What is left
/// ends with that.
void RunOwners::forget_first_of_many() {
  std::size_t count = 0;
  auto first = runs_.end();
  for (auto run = runs_.begin(); run != runs_.end(); ++run) {
    if (!run->second.is_over && !run->second.owner_gone) continue;
    ++count;
    if (first == runs_.end() || run->second.order < first->second.order) first = run;
  }
  if (count <= kMostOver) return;
  if (!first->second.is_over) put(first->second.owner, "nobody", Control{first->first, Control::State::cancelled, ""});
  runs_.erase(first);
}

}  // namespace demecal::inline transport
