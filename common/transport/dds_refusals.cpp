#include "transport/dds_refusals.hpp"

#include <fastrtps/utils/IPLocator.h>
#include <algorithm>
#include <cstdio>

#include "protocol/printable.hpp"

namespace demecal {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

/// How long a handshake may take on a busy machine.
constexpr std::chrono::seconds kHandshake{5};

std::string place_of(const rtps::ParticipantProxyData& participant) {
  if (participant.default_locators.unicast.empty()) return "";
  return " at " + rtps::IPLocator::ip_to_string(participant.default_locators.unicast[0]);
}

bool shows_certificate(const rtps::ParticipantProxyData& participant) {
  return !participant.identity_token_.class_id().empty();
}

}  // namespace

void Refusals::on_participant_discovery(dds::DomainParticipant*, rtps::ParticipantDiscoveryInfo&& found) {
  const std::lock_guard lock(mutex_);
  if (found.status == rtps::ParticipantDiscoveryInfo::REMOVED_PARTICIPANT ||
      found.status == rtps::ParticipantDiscoveryInfo::DROPPED_PARTICIPANT) {
    others_.erase(found.info.m_guid);
    return;
  }
  const bool certified = shows_certificate(found.info);
  const bool settled = !secured_ && !certified;
  const std::string name = printable(found.info.m_participantName.to_string());
  Other& other =
      others_.try_emplace(found.info.m_guid, Other{name, place_of(found.info), Clock::now(), settled}).first->second;
  if (secured_ && !certified) tell(other, "is refused: it shows no certificate");
  if (!secured_ && certified)
    tell(other, "does not talk to this one: it demands a certificate, which --security would show");
}

void Refusals::onParticipantAuthentication(dds::DomainParticipant*, rtps::ParticipantAuthenticationInfo&& result) {
  const std::lock_guard lock(mutex_);
  const auto other = others_.find(result.guid);
  if (other == others_.end()) return;
  if (result.status == rtps::ParticipantAuthenticationInfo::UNAUTHORIZED_PARTICIPANT)
    tell(other->second, "is refused: its certificate is not valid for the authority of this one");
  other->second.settled = true;
}

std::string Refusals::name_of(const ParticipantId& participant) {
  Guid guid;
  std::ranges::copy(participant, guid.guidPrefix.value);
  guid.entityId = eprosima::fastrtps::rtps::c_EntityId_RTPSParticipant;
  const std::lock_guard lock(mutex_);
  const auto other = others_.find(guid);
  return other == others_.end() || other->second.name.empty() ? "participant " + text_of(participant)
                                                              : other->second.name;
}

void Refusals::tell_unproven(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  for (auto& [guid, other] : others_)
    if (now - other.found > kHandshake) tell(other, "is kept out: it has not proved its identity for 5 s");
}

void Refusals::tell(Other& other, const std::string& what) const {
  if (!silent_ && !other.settled)
    std::fprintf(stderr, "'%s'%s %s\n", other.name.c_str(), other.place.c_str(), what.c_str());
  other.settled = true;
}

}  // namespace demecal
