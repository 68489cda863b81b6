// Says who was turned away from a secured domain, and why.
#pragma once

#include <chrono>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <map>
#include <mutex>
#include <string>

#include "transport/participant_of.hpp"
#include "transport/transport.hpp"

namespace demecal {

/// A participant's listener, called on Fast DDS's threads. A sentence goes to standard error for each participant with
/// which this one does not talk because of certificates; from a herald none, since its coordinator says the same.
class Refusals final : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  using Clock = std::chrono::steady_clock;

  Refusals(bool secured, Role role) : secured_(secured), silent_(role == Role::herald) {}

  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& found) override;
  void onParticipantAuthentication(eprosima::fastdds::dds::DomainParticipant* participant,
                                   eprosima::fastrtps::rtps::ParticipantAuthenticationInfo&& result) override;

  /// What a participant that is there calls itself; its GUID prefix where it is not known.
  std::string name_of(const ParticipantId& participant);

  /// Whoever begins a handshake is not told that the other end does not accept it: only that it takes no end.
  void tell_unproven(Clock::time_point now);

 private:
  using Guid = eprosima::fastrtps::rtps::GUID_t;
  struct Other {
    std::string name;
    std::string place;  ///< where it says that it is
    Clock::time_point found;
    bool settled;  ///< whether it was accepted, or spoken of
  };
  void tell(Other& other, const std::string& what) const;

  const bool secured_;
  const bool silent_;
  std::mutex mutex_;
  std::map<Guid, Other> others_;  ///< those that are there
};

}  // namespace demecal
