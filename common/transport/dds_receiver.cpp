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
      auto message = decode(sample);
      if (message)
        deliver(std::move(*message), info.publication_handle);
      else
        ++inbox_.unreadable;
    }
  }

 protected:
  template <class Plain>
  void deliver(Plain message, const InstanceHandle_t& publication) {
    if constexpr (std::is_same_v<Plain, WorkerStatus>)
      inbox_.presence.heard(writer_id(publication), std::move(message));
    else if constexpr (std::is_same_v<Plain, LoopNews>)
      inbox_.heralds.heard(writer_id(publication), std::move(message));
    else
      inbox_.mailbox.put(std::move(message));
  }

  Inbox& inbox_;
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
      return std::make_unique<Receiver<wire::CalibrationData>>(inbox);
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
