// Listeners that turn what DDS readers hear into messages in a mailbox.
#pragma once

#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <functional>
#include <memory>
#include <string>

#include "transport/dropped_samples.hpp"
#include "transport/mailbox.hpp"
#include "transport/presence.hpp"
#include "transport/run_owners.hpp"
#include "transport/topic.hpp"

namespace demecal {

/// Where a participant's listeners put what they hear.
struct Inbox {
  explicit Inbox(Role reader) : role(reader) {}

  const Role role;     ///< of who reads
  ParticipantId id{};  ///< of who reads; to be set before any reader is made
  Mailbox mailbox;
  DroppedSamples dropped;
  Presence presence{mailbox};
  Heralds heralds{mailbox};
  RunOwners owners{mailbox, dropped, role == Role::worker};
  /// Whether a publication is this participant's, so that what it says is not heard.
  std::function<bool(const eprosima::fastrtps::rtps::InstanceHandle_t&)> is_own;
  /// Whether certificates decide who may say what, and GUIDs are made of them.
  bool secured = false;
  /// What a participant calls itself, for people.
  std::function<std::string(const ParticipantId&)> name_of;
};

/// The listener for a reader of this topic. Called on Fast DDS's threads; `inbox` must outlive the reader.
std::unique_ptr<eprosima::fastdds::dds::DataReaderListener> make_receiver(Topic topic, Inbox& inbox);

}  // namespace demecal
