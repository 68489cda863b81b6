// Listeners that put what DDS readers receive into a mailbox.
#pragma once

#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <functional>
#include <memory>
#include <string>

#include "protocol/messages.hpp"
#include "transport/mailbox.hpp"
#include "transport/participants.hpp"
#include "transport/run_owners.hpp"

namespace demecal::inline dds {

/// Where a participant's listeners put what they receive.
struct Inbox {
  explicit Inbox(Role reader) : role(reader) {}

  const Role role;     ///< of who reads
  ParticipantId id{};  ///< of who reads; to be set before any reader is made
  Mailbox mailbox;
  RejectionLog rejections;
  Presence presence{mailbox};
  CalibrationPresence reporters{mailbox};
  RunOwners owners{mailbox, rejections, role == Role::worker};
  /// Whether a publication is this participant's own, which is not delivered.
  std::function<bool(const eprosima::fastrtps::rtps::InstanceHandle_t&)> is_own;
  /// Whether certificates decide who may publish what, and GUIDs are made of them.
  bool secured = false;
  /// What a participant calls itself, for people.
  std::function<std::string(const ParticipantId&)> name_of;
};

/// The listener for a reader of this topic. Called on Fast DDS's threads; `inbox` must outlive the reader.
std::unique_ptr<eprosima::fastdds::dds::DataReaderListener> make_receiver(Topic topic, Inbox& inbox);

}  // namespace demecal::inline dds
