#include "transport/dds_receiver.hpp"

#include <algorithm>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <utility>

#include "transport/wire_form.hpp"

namespace demecal {
namespace {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::InstanceHandle_t;

WriterId writer_id(const InstanceHandle_t& publication) {
  WriterId id{};
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = publication.value[i];
  return id;
}

template <class Wire>
class Receiver : public dds::DataReaderListener {
 public:
  explicit Receiver(Inbox& inbox) : inbox_(inbox) {}

  void on_data_available(dds::DataReader* reader) override {
    Wire sample;
    dds::SampleInfo info;
    while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data || inbox_.is_own(info.publication_handle)) continue;
      const WriterId writer = writer_id(info.publication_handle);
      auto message = decode(sample);
      if (message) {
        deliver(std::move(*message), writer);
      } else {
        drop(writer, "it cannot be read");
      }
    }
  }

 protected:
  template <class Plain>
  void deliver(Plain message, const WriterId& writer) {
    const ParticipantId source = participant_of(writer);
    if constexpr (requires { inbox_.owners.heard(source, "", std::move(message), Time()); }) {
      inbox_.owners.heard(source, inbox_.name_of(source), std::move(message), std::chrono::steady_clock::now());
    } else if constexpr (std::is_same_v<Plain, LoopNews>) {
      if (!inbox_.heralds.heard(writer, std::move(message))) drop(writer, "news of a calibration that is another's");
    } else if (!may_speak_for(source, message)) {
      drop(writer, "it speaks for worker " + message.worker);
    } else if constexpr (std::is_same_v<Plain, WorkerStatus>) {
      inbox_.presence.heard(writer, std::move(message));
    } else if (is_for_another(message)) {
      return;
    } else if (!inbox_.mailbox.put(source, std::move(message))) {
      drop(writer, "more than can be kept");
    }
  }

  Inbox& inbox_;

 private:
  using Time = RunOwners::Time;

  /// Figures are told to watchers by heralds too, of workers that are gone.
  template <class Plain>
  bool may_speak_for(const ParticipantId& source, const Plain& message) const {
    if (inbox_.secured || (std::is_same_v<Plain, Progress> && inbox_.role == Role::watcher)) return true;
    return source == participant_of(message.worker);
  }

  /// Whether it answers another coordinator; one that does not read for a while would have to keep it.
  template <class Plain>
  bool is_for_another(const Plain& message) const {
    return inbox_.role == Role::coordinator && shows_publisher(message.run) && !may_publish(inbox_.id, message.run);
  }

  void drop(const WriterId& writer, const std::string& why) {
    inbox_.dropped.note(inbox_.name_of(participant_of(writer)), why);
  }
};

/// Hears also of those whose writer of data goes.
class DataReceiver final : public Receiver<wire::CalibrationData> {
 public:
  using Receiver::Receiver;

  void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) override {
    const WriterId writer = writer_id(status.last_publication_handle);
    if (status.current_count_change < 0) inbox_.owners.departed(participant_of(writer));
  }
};

/// Hears also of workers that fall silent.
class WorkerReceiver final : public Receiver<wire::WorkerStatus> {
 public:
  using Receiver::Receiver;

  void on_liveliness_changed(dds::DataReader*, const dds::LivelinessChangedStatus& status) override {
    const WriterId writer = writer_id(status.last_publication_handle);
    if (status.not_alive_count_change > 0) inbox_.presence.fell_silent(writer);
    if (status.alive_count_change > 0) inbox_.presence.spoke_again(writer);
  }

  void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) override {
    if (status.current_count_change < 0) inbox_.presence.departed(writer_id(status.last_publication_handle));
  }
};

/// Hears also of those whose writer of news goes.
class LoopReceiver final : public Receiver<wire::LoopNews> {
 public:
  using Receiver::Receiver;

  void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) override {
    if (status.current_count_change < 0) inbox_.heralds.departed(writer_id(status.last_publication_handle));
  }
};

}  // namespace

std::unique_ptr<dds::DataReaderListener> make_receiver(Topic topic, Inbox& inbox) {
  switch (topic) {
    case Topic::data:
      return std::make_unique<DataReceiver>(inbox);
    case Topic::task:
      return std::make_unique<Receiver<wire::IslandTask>>(inbox);
    case Topic::control:
      return std::make_unique<Receiver<wire::Control>>(inbox);
    case Topic::migrants:
      return std::make_unique<Receiver<wire::Migrants>>(inbox);
    case Topic::progress:
      return std::make_unique<Receiver<wire::Progress>>(inbox);
    case Topic::checkpoint:
      return std::make_unique<Receiver<wire::Checkpoint>>(inbox);
    case Topic::outcome:
      return std::make_unique<Receiver<wire::Outcome>>(inbox);
    case Topic::loop:
      return std::make_unique<LoopReceiver>(inbox);
    case Topic::worker:
      break;
  }
  return std::make_unique<WorkerReceiver>(inbox);
}

}  // namespace demecal
