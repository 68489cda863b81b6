#include "transport/dds_writers.hpp"

#include <algorithm>
#include <stdexcept>

#include "errors/check.hpp"
#include "transport/dds_qos.hpp"
#include "transport/wire_form.hpp"

namespace demecal {
namespace {

namespace dds = eprosima::fastdds::dds;

constexpr std::size_t kMostOver = 64;
/// A task that waits longer goes all the same.
constexpr std::chrono::milliseconds kLongestHold{300};
/// So long after a run's end its last words may still be said. A reader aborts where more is said of an instance that
/// was withdrawn (Fast DDS 2.9, DataReaderHistory::update_instance_nts).
constexpr std::chrono::milliseconds kLastWords{1000};
/// What is larger travels in parts.
constexpr std::size_t kDatagram_bytes = 60'000;

/// Calls `use(wire form)` with what travels for a message that can be sent.
template <class Use>
void with_wire_form(const Message& message, Use use) {
  std::visit(
      [&](const auto& plain) {
        if constexpr (requires { encode(plain); }) {
          auto sample = encode(plain);
          use(&sample);
        }
      },
      message);
}

DdsWriters::Place place_of(const TopicKey& key) {
  return {key.topic, key.topic == Topic::migrants ? key.island.joint : 0};
}

}  // namespace

void DdsWriters::add(Place place, Owned<dds::DataWriter> writer) {
  const std::lock_guard lock(mutex_);
  writers_.emplace(place, std::move(writer));
}

dds::DataWriter* DdsWriters::at(Place place) {
  const std::lock_guard lock(mutex_);
  const auto writer = writers_.find(place);
  DEMECAL_CHECK(writer != writers_.end(), "joint=" << place.second << " is not followed");
  return writer->second.get();
}

std::vector<std::pair<Topic, dds::DataWriter*>> DdsWriters::all() {
  const std::lock_guard lock(mutex_);
  std::vector<std::pair<Topic, dds::DataWriter*>> all;
  for (const auto& [place, writer] : writers_) all.emplace_back(place.first, writer.get());
  return all;
}

void DdsWriters::send(const Message& message) {
  const TopicKey key = key_of(message);
  if (key.topic != Topic::control) {
    const std::lock_guard lock(mutex_);
    const std::optional<Time> end = end_of(key.run);
    if (end && std::chrono::steady_clock::now() - *end >= kLastWords) return;
  }
  if (!hold(key, message)) write(key, message);
}

bool DdsWriters::hold(const TopicKey& key, const Message& message) {
  if (key.topic != Topic::checkpoint && key.topic != Topic::task) return false;
  const bool must_wait = !may_replace(key);
  const std::lock_guard lock(mutex_);
  held_.erase(key);
  if (must_wait) held_.emplace(key, message);
  return must_wait;
}

bool DdsWriters::may_replace(const TopicKey& key) {
  Value last;
  {
    const std::lock_guard lock(mutex_);
    for (const Values* values : {&published_, &ended_})
      if (const auto found = values->find(key); found != values->end()) last = found->second;
  }
  const bool is_late = key.topic == Topic::task && std::chrono::steady_clock::now() - last.written >= kLongestHold;
  return !last.in_parts || is_late || have_arrived(place_of(key));
}

void DdsWriters::write(const TopicKey& key, const Message& message) {
  dds::DataWriter* writer = at(place_of(key));
  bool written = false, in_parts = false;
  with_wire_form(message, [&](auto* sample) {
    in_parts = sample->getCdrSerializedSize(*sample) > kDatagram_bytes;
    written = writer->write(sample);
  });
  if (!written) throw std::runtime_error("DDS: cannot write to " + topic_name(key.topic, key.island.joint));
  if (key.run == 0 || key.topic == Topic::control) return;
  const std::lock_guard lock(mutex_);
  (end_of(key.run) ? ended_ : published_)[key] = {in_parts, std::chrono::steady_clock::now()};
}

/// Whether all this place's values have reached all who read them. To ask for one key alone would not do, since Fast
/// DDS forgets those who came late there.
bool DdsWriters::have_arrived(Place place) {
  return at(place)->wait_for_acknowledgments({0, 0}) == ReturnCode_t::RETCODE_OK;
}

void DdsWriters::withdraw(RunId run) {
  {
    const std::lock_guard lock(mutex_);
    if (end_of(run)) return;
    over_.emplace_back(run, std::chrono::steady_clock::now());
    if (over_.size() > kMostOver) over_.pop_front();
    std::erase_if(published_, [&](const auto& value) {
      if (value.first.run != run) return false;
      ended_.insert(value);
      return true;
    });
    std::erase_if(held_, [run](const auto& held) { return held.first.run == run; });
  }
}

/// When it ended; nothing where it goes on, or ended long ago.
std::optional<DdsWriters::Time> DdsWriters::end_of(RunId run) const {
  const auto found = std::ranges::find(over_, run, &std::pair<RunId, Time>::first);
  return found != over_.end() ? std::optional(found->second) : std::nullopt;
}

bool DdsWriters::catch_up() {
  std::unique_lock lock(mutex_);
  std::map<TopicKey, Message> held = std::exchange(held_, {});
  Values ended, lately;
  const Time before = std::chrono::steady_clock::now() - kLastWords;
  for (const auto& [key, value] : std::exchange(ended_, {})) {
    const std::optional<Time> end = end_of(key.run);
    (end && *end > before ? lately : ended).emplace(key, value);
  }
  ended_ = std::move(lately);
  std::erase_if(held, [&](const auto& waiting) {
    const std::optional<Time> end = end_of(waiting.first.run);
    return end && *end <= before;
  });
  lock.unlock();
  const std::size_t sent = std::erase_if(held, [this](const auto& waiting) {
    if (!may_replace(waiting.first)) return false;
    write(waiting.first, waiting.second);
    return true;
  });
  Values waiting = withdraw_arrived(std::move(ended));
  lock.lock();
  held_.merge(held);
  ended_.merge(waiting);
  return sent > 0;
}

/// Returns those that have to wait: who is told of an instance's end together with samples from before it loops for
/// ever where the writer has said more since (Fast DDS 2.9, StatefulWriter::check_acked_status).
DdsWriters::Values DdsWriters::withdraw_arrived(Values ended) {
  std::map<Place, bool> arrived;
  for (const auto& [key, value] : ended)
    if (!arrived.contains(place_of(key))) arrived[place_of(key)] = have_arrived(place_of(key));
  std::erase_if(ended, [&](const auto& value) {
    const TopicKey& key = value.first;
    if (!arrived.at(place_of(key))) return false;
    dds::DataWriter* writer = at(place_of(key));
    // Unregistering disposes as well; disposing alone would keep the memory.
    with_wire_form(empty_message(key), [&](auto* sample) { writer->unregister_instance(sample, dds::HANDLE_NIL); });
    return true;
  });
  return ended;
}

}  // namespace demecal
