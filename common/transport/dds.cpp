#include "transport/dds.hpp"

#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

#include "errors/check.hpp"
#include "transport/dds_participant.hpp"
#include "transport/dds_qos.hpp"
#include "transport/dds_receiver.hpp"
#include "transport/topic.hpp"
#include "transport/wire_form.hpp"

namespace demecal {
namespace {

namespace dds = eprosima::fastdds::dds;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Calls `use(wire form)` with what travels for a message that can be sent.
template <class Use>
void with_wire_form(const Message& message, Use use) {
  std::visit(
      [&](const auto& plain) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(plain)>, WorkerLost>) {
          auto sample = encode(plain);
          use(&sample);
        }
      },
      message);
}

class DdsTransport final : public Transport {
 public:
  DdsTransport(const DdsOptions& options, Role role, const std::string& name)
      : role_(role), name_(name), participant_(options, name) {
    inbox_.is_own = [this](const auto& publication) { return participant_.is_own(publication); };
    for (const Topic topic : kTopics)
      if (topic != Topic::migrants) join_topic(topic, 0);
  }

  void publish(const Message& message) override;
  std::optional<Message> receive(milliseconds patience) override;
  void wake() override { inbox_.mailbox.wake(); }
  void follow_migrants(std::uint32_t joint) override;
  void assert_alive() override;
  bool flush(milliseconds patience) override;
  std::uint64_t unreadable() const override { return inbox_.unreadable; }

 private:
  using Place = std::pair<Topic, std::uint32_t>;  ///< a topic, and the joint (from 0) where it is migrants, else 0

  static Place place_of(const TopicKey& key) {
    return {key.topic, key.topic == Topic::migrants ? key.island.joint : 0};
  }
  void join_topic(Topic topic, std::uint32_t joint);
  dds::DataWriter* writer_at(Place place);
  std::vector<dds::DataWriter*> writers();
  void note_published(const TopicKey& key, const Message& message);
  std::optional<WorkerStatus> status_due();
  void withdraw(RunId run);

  const Role role_;
  const std::string name_;
  Inbox inbox_;
  std::vector<std::unique_ptr<dds::DataReaderListener>> receivers_;
  DdsParticipant participant_;
  std::mutex mutex_;  ///< guards what follows
  std::map<Place, Owned<dds::DataWriter>> writers_;
  std::map<Place, Owned<dds::DataReader>> readers_;
  std::set<TopicKey> published_;        ///< keys with a run, to be withdrawn when it is over
  std::optional<WorkerStatus> status_;  ///< the last one published
  steady_clock::time_point status_published_;
};

void DdsTransport::join_topic(Topic topic, std::uint32_t joint) {
  const Place place{topic, joint};
  if (reads(role_, topic)) {
    receivers_.push_back(make_receiver(topic, inbox_));
    readers_.emplace(place, participant_.make_reader(topic, joint, receivers_.back().get()));
  }
  if (writes(role_, topic)) writers_.emplace(place, participant_.make_writer(topic, joint));
}

void DdsTransport::follow_migrants(std::uint32_t joint) {
  const std::lock_guard lock(mutex_);
  const Place place{Topic::migrants, joint};
  if (!readers_.contains(place)) join_topic(Topic::migrants, joint);
}

dds::DataWriter* DdsTransport::writer_at(Place place) {
  const std::lock_guard lock(mutex_);
  const auto writer = writers_.find(place);
  DEMECAL_CHECK(writer != writers_.end(), "joint=" << place.second << " is not followed");
  return writer->second.get();
}

std::vector<dds::DataWriter*> DdsTransport::writers() {
  const std::lock_guard lock(mutex_);
  std::vector<dds::DataWriter*> all;
  for (const auto& [place, writer] : writers_) all.push_back(writer.get());
  return all;
}

void DdsTransport::publish(const Message& message) {
  const TopicKey key = key_of(message);
  check_may_publish(role_, name_, key);
  dds::DataWriter* writer = writer_at(place_of(key));
  note_published(key, message);
  bool written = false;
  with_wire_form(message, [&](void* sample) { written = writer->write(sample); });
  if (!written) throw std::runtime_error("DDS: cannot write to " + topic_name(key.topic, key.island.joint));
  if (const RunId ended = ended_run(message)) withdraw(ended);
}

void DdsTransport::note_published(const TopicKey& key, const Message& message) {
  const std::lock_guard lock(mutex_);
  if (const auto* status = std::get_if<WorkerStatus>(&message)) {
    status_ = *status;
    status_published_ = steady_clock::now();
  } else if (key.topic != Topic::control) {
    published_.insert(key);
  }
}

std::optional<Message> DdsTransport::receive(milliseconds patience) {
  auto message = inbox_.mailbox.take(patience);
  if (message)
    if (const RunId ended = ended_run(*message)) withdraw(ended);
  return message;
}

void DdsTransport::withdraw(RunId run) {
  std::set<TopicKey> of_run;
  {
    const std::lock_guard lock(mutex_);
    for (const TopicKey& key : published_)
      if (key.run == run) of_run.insert(key);
    for (const TopicKey& key : of_run) published_.erase(key);
  }
  for (const TopicKey& key : of_run) {
    dds::DataWriter* writer = writer_at(place_of(key));
    // Unregistering disposes as well; disposing alone would keep the memory.
    with_wire_form(empty_message(key), [&](void* sample) { writer->unregister_instance(sample, dds::HANDLE_NIL); });
  }
}

void DdsTransport::assert_alive() {
  if (role_ != Role::worker) return;
  writer_at({Topic::worker, 0})->assert_liveliness();
  // An assertion that meets the end of the lease revives the worker in Fast DDS without telling its readers, who go on
  // taking it for lost: they hear it from the status.
  if (const auto due = status_due()) publish(*due);
}

std::optional<WorkerStatus> DdsTransport::status_due() {
  const std::lock_guard lock(mutex_);
  return steady_clock::now() - status_published_ >= kLease ? status_ : std::nullopt;
}

bool DdsTransport::flush(milliseconds patience) {
  const auto deadline = steady_clock::now() + patience;
  bool arrived = true;
  for (dds::DataWriter* writer : writers()) {
    const auto left = std::chrono::duration_cast<milliseconds>(deadline - steady_clock::now());
    arrived &=
        writer->wait_for_acknowledgments(dds_duration(std::max(left, milliseconds{0}))) == ReturnCode_t::RETCODE_OK;
  }
  return arrived;
}

}  // namespace

std::unique_ptr<Transport> join_dds(const DdsOptions& options, Role role, const std::string& name) {
  return std::make_unique<DdsTransport>(options, role, name);
}

}  // namespace demecal
