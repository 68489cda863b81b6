#include "dds/receiver.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "dds/participant.hpp"
#include "dds/parts.hpp"
#include "protocol/message_bytes.hpp"

namespace demecal::inline dds {
namespace {

namespace fastdds = eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SequenceNumber_t;

WriterId writer_id(const InstanceHandle_t& publication) {
  WriterId id{};
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = publication.value[i];
  return id;
}

/// Puts what a reader received where it belongs.
class Delivery : public fastdds::DataReaderListener {
 public:
  explicit Delivery(Inbox& inbox) : inbox_(inbox) {}

 protected:
  /// Calls `use(sample, writer)` with all that have come, each writer's in the order in which it wrote them: Fast DDS
  /// hands them over instance by instance.
  template <class Plain, class Use>
  void take_all(fastdds::DataReader& reader, Use use) {
    struct Taken {
      WriterId writer;
      SequenceNumber_t number;
      Sample<Plain> sample;
    };
    std::vector<Taken> all;
    Sample<Plain> sample;
    fastdds::SampleInfo info;
    while (reader.take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK)
      if (info.valid_data && !inbox_.is_own(info.publication_handle))
        all.push_back({writer_id(info.publication_handle), info.sample_identity.sequence_number(), std::move(sample)});
    std::ranges::sort(all, [](const Taken& a, const Taken& b) {
      return a.writer != b.writer ? a.writer < b.writer : a.number < b.number;
    });
    for (Taken& taken : all) use(std::move(taken.sample), taken.writer);
  }

  template <class Plain>
  void deliver(std::optional<Plain> message, const WriterId& writer) {
    if (!message) return reject(writer, "it cannot be read");
    deliver(std::move(*message), writer);
  }
  template <class Plain>
  void deliver(Plain message, const WriterId& writer) {
    const ParticipantId source = participant_of(writer);
    if constexpr (requires { inbox_.owners.receive(source, "", std::move(message), Time()); }) {
      inbox_.owners.receive(source, inbox_.name_of(source), std::move(message), std::chrono::steady_clock::now());
    } else if constexpr (requires { inbox_.reporters.receive(writer, std::move(message)); }) {
      if (!inbox_.reporters.receive(writer, std::move(message)))
        reject(writer, "news of a calibration that is another's");
    } else if (!may_publish_for(source, message)) {
      reject(writer, "it publishes as worker " + message.worker);
    } else if constexpr (std::is_same_v<Plain, WorkerStatus>) {
      inbox_.presence.receive(writer, std::move(message));
    } else if (is_for_another(message)) {
      return;
    } else if (!inbox_.mailbox.put(source, std::move(message))) {
      reject(writer, "more than can be kept");
    }
  }

  void reject(const WriterId& writer, const std::string& why) {
    inbox_.rejections.add(inbox_.name_of(participant_of(writer)), why);
  }

  Inbox& inbox_;

 private:
  using Time = RunOwners::Time;

  /// CalibrationPresence publish figures for watchers too, of workers that are gone.
  template <class Plain>
  bool may_publish_for(const ParticipantId& source, const Plain& message) const {
    if (inbox_.secured || (std::is_same_v<Plain, Progress> && inbox_.role == Role::watcher)) return true;
    return source == participant_of(message.worker);
  }

  /// Whether it answers another coordinator; one that does not read for a while would have to keep it.
  template <class Plain>
  bool is_for_another(const Plain& message) const {
    return inbox_.role == Role::coordinator && shows_publisher(message.run) && !may_publish(inbox_.id, message.run);
  }
};

template <class Plain>
class Receiver : public Delivery {
 public:
  using Delivery::Delivery;

  void on_data_available(fastdds::DataReader* reader) override {
    take_all<Plain>(*reader,
                    [this](Sample<Plain> sample, const WriterId& writer) { deliver(std::move(sample), writer); });
  }
};

/// Puts messages together from their parts.
template <class Plain>
class PartsReceiver : public Delivery {
 public:
  using Delivery::Delivery;

  void on_data_available(fastdds::DataReader* reader) override {
    take_all<MessagePart>(*reader,
                          [this](Sample<MessagePart> part, const WriterId& writer) { take(std::move(part), writer); });
  }

  void on_subscription_matched(fastdds::DataReader*, const fastdds::SubscriptionMatchedStatus& status) override {
    if (status.current_count_change >= 0) return;
    const std::lock_guard lock(mutex_);
    assembly_.departed(writer_id(status.last_publication_handle), std::chrono::steady_clock::now());
  }

 private:
  void take(Sample<MessagePart> part, const WriterId& writer) {
    if (!part) return reject(writer, "it cannot be read");
    MessageAssembler::Result result;
    {
      const std::lock_guard lock(mutex_);
      result = assembly_.take(writer, std::move(*part));
    }
    using enum MessageAssembler::Verdict;
    if (result.verdict == whole) return deliver(from_bytes<Plain>(result.bytes), writer);
    if (result.verdict == malformed) return reject(writer, "it cannot be read");
    if (result.verdict == too_much) reject(writer, "more than can be kept");
  }

  std::mutex mutex_;
  MessageAssembler assembly_;
};

class ProgressReceiver : public Delivery {
 public:
  using Delivery::Delivery;

  void on_data_available(fastdds::DataReader* reader) override {
    take_all<PlacedProgress>(*reader, [this](Sample<PlacedProgress> sample, const WriterId& writer) {
      if (!sample) return reject(writer, "it cannot be read");
      if (!sample->over) deliver(std::move(sample->progress), writer);
    });
  }
};

/// Notices also when a writer of data comes or goes.
class DataReceiver final : public PartsReceiver<CalibrationData> {
 public:
  using PartsReceiver::PartsReceiver;

  void on_subscription_matched(fastdds::DataReader* reader, const fastdds::SubscriptionMatchedStatus& status) override {
    PartsReceiver::on_subscription_matched(reader, status);
    const ParticipantId owner = participant_of(writer_id(status.last_publication_handle));
    if (status.current_count_change < 0) inbox_.owners.departed(owner, std::chrono::steady_clock::now());
    if (status.current_count_change > 0) inbox_.owners.arrived(owner);
  }
};

/// Notices also when a worker loses its liveliness.
class WorkerReceiver final : public Receiver<WorkerStatus> {
 public:
  using Receiver::Receiver;

  void on_liveliness_changed(fastdds::DataReader*, const fastdds::LivelinessChangedStatus& status) override {
    const WriterId writer = writer_id(status.last_publication_handle);
    if (status.not_alive_count_change > 0) inbox_.presence.lost_liveliness(writer);
    if (status.alive_count_change > 0) inbox_.presence.regained_liveliness(writer);
  }

  void on_subscription_matched(fastdds::DataReader*, const fastdds::SubscriptionMatchedStatus& status) override {
    if (status.current_count_change < 0) inbox_.presence.departed(writer_id(status.last_publication_handle));
  }
};

/// Notices also when a writer of news goes.
class LoopReceiver final : public Receiver<LoopNews> {
 public:
  using Receiver::Receiver;

  void on_subscription_matched(fastdds::DataReader*, const fastdds::SubscriptionMatchedStatus& status) override {
    if (status.current_count_change < 0) inbox_.reporters.departed(writer_id(status.last_publication_handle));
  }
};

}  // namespace

std::unique_ptr<fastdds::DataReaderListener> make_receiver(Topic topic, Inbox& inbox) {
  switch (topic) {
    case Topic::data:
      return std::make_unique<DataReceiver>(inbox);
    case Topic::task:
      return std::make_unique<PartsReceiver<IslandTask>>(inbox);
    case Topic::control:
      return std::make_unique<Receiver<Control>>(inbox);
    case Topic::migrants:
      return std::make_unique<PartsReceiver<Migrants>>(inbox);
    case Topic::progress:
      return std::make_unique<ProgressReceiver>(inbox);
    case Topic::checkpoint:
      return std::make_unique<PartsReceiver<Checkpoint>>(inbox);
    case Topic::outcome:
      return std::make_unique<PartsReceiver<Outcome>>(inbox);
    case Topic::loop:
      return std::make_unique<LoopReceiver>(inbox);
    case Topic::cause:
      return std::make_unique<Receiver<CauseFound>>(inbox);
    case Topic::final_figures:
      return std::make_unique<Receiver<FinalFigures>>(inbox);
    case Topic::worker:
      break;
  }
  return std::make_unique<WorkerReceiver>(inbox);
}

}  // namespace demecal::inline dds
