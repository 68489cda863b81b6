// Listeners that turn what DDS readers hear into messages in a mailbox.
#pragma once

#include <atomic>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <functional>
#include <memory>

#include "transport/mailbox.hpp"
#include "transport/presence.hpp"
#include "transport/topic.hpp"

namespace demecal {

/// Where a participant's listeners put what they hear.
struct Inbox {
  Mailbox mailbox;
  Presence presence{mailbox};
  Heralds heralds{mailbox};
  std::atomic<std::uint64_t> unreadable{0};  ///< messages dropped because they could not be decoded
  /// Whether a publication is this participant's, so that what it says is not heard.
  std::function<bool(const eprosima::fastrtps::rtps::InstanceHandle_t&)> is_own;
};

/// The listener for a reader of this topic. Called on Fast DDS's threads; `inbox` must outlive the reader.
std::unique_ptr<eprosima::fastdds::dds::DataReaderListener> make_receiver(Topic topic, Inbox& inbox);

}  // namespace demecal
