#include "dds/dds_transport.hpp"
#include "dds/participant.hpp"
#include "protocol/messages.hpp"

#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "errors/input_error.hpp"
#include "transport/participants.hpp"

namespace demecal::inline dds {
namespace {

namespace rtps = eprosima::fastrtps::rtps;
namespace fastdds = eprosima::fastdds::dds;
using std::chrono::milliseconds;

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::uint32_t kSocketBuffer_bytes = 4 << 20;
/// How many participants of one host are found by unicast.
constexpr std::uint32_t kParticipantsPerHost = 100;
constexpr milliseconds kParticipantLease{5000};
constexpr milliseconds kParticipantAnnouncement{1000};
constexpr milliseconds kFirstAnnouncements{60};
/// So many of them, closer together: whoever starts beside another may miss the first. Each goes to all ports where a
/// participant of the host may listen, which costs most of what a short run does beside breeding.
constexpr std::uint32_t kFirst = 4;
constexpr milliseconds kServerSync{200};

std::vector<std::string> bound_addresses(const DdsOptions& options) {
  if (options.interfaces.empty() && options.reach == DdsOptions::Reach::local) return {kLoopback};
  return options.interfaces;
}

/// A locator of a host given by address or name; port 0 stands for "each participant's own".
rtps::Locator_t locator(const std::string& host, std::uint32_t port) {
  std::string address = host;
  if (!rtps::IPLocator::isIPv4(host)) {
    const auto addresses = rtps::IPLocator::resolveNameDNS(host).first;
    if (addresses.empty()) throw InputError({}, host, "is neither an IPv4 address nor the name of a known host");
    address = *addresses.begin();
  }
  rtps::Locator_t result;
  rtps::IPLocator::createLocator(LOCATOR_KIND_UDPv4, address, port, result);
  return result;
}

rtps::Locator_t server_locator(const std::string& server) {
  const auto colon = server.rfind(':');
  std::uint16_t port = 0;
  if (colon != std::string::npos) std::from_chars(server.data() + colon + 1, server.data() + server.size(), port);
  if (colon == 0 || port == 0) throw InputError({}, server, "is not a discovery server: ADDRESS:PORT");
  return locator(server.substr(0, colon), port);
}

/// Those found by unicast: the peers, and this host's other participants.
std::vector<std::string> unicast_hosts(const DdsOptions& options) {
  std::vector<std::string> hosts = bound_addresses(options);
  if (hosts.empty()) hosts.emplace_back(kLoopback);
  hosts.insert(hosts.end(), options.peers.begin(), options.peers.end());
  return hosts;
}

void set_discovery(rtps::BuiltinAttributes& builtin, const DdsOptions& options) {
  auto& discovery = builtin.discovery_config;
  discovery.leaseDuration = dds_duration(kParticipantLease);
  discovery.leaseDuration_announcementperiod = dds_duration(kParticipantAnnouncement);
  discovery.initial_announcements = {kFirst, dds_duration(kFirstAnnouncements)};
  if (!options.discovery_server.empty()) {
    discovery.discoveryProtocol = rtps::DiscoveryProtocol_t::CLIENT;
    discovery.discoveryServer_client_syncperiod = dds_duration(kServerSync);
    eprosima::fastdds::rtps::RemoteServerAttributes server;
    eprosima::fastdds::rtps::get_server_client_default_guidPrefix(0, server.guidPrefix);
    server.metatrafficUnicastLocatorList.push_back(server_locator(options.discovery_server));
    discovery.m_DiscoveryServers.push_back(server);
  } else if (options.reach == DdsOptions::Reach::local || !options.peers.empty()) {
    for (const std::string& host : unicast_hosts(options)) builtin.initialPeersList.push_back(locator(host, 0));
  }
  // Named addresses keep the participant out of the multicast group.
  if (options.reach == DdsOptions::Reach::local)
    for (const std::string& address : bound_addresses(options))
      builtin.metatrafficUnicastLocatorList.push_back(locator(address, 0));
}

/// The file as a property names it.
std::string readable(const std::filesystem::path& folder, const std::string& file) {
  const std::filesystem::path path = folder / file;
  if (!std::filesystem::is_regular_file(path) || !std::ifstream(path)) {
    throw InputError({path.string(), 0}, "",
                     "is missing or unreadable; `scripts/security DIR` makes a folder of certificates");
  }
  return "file://" + std::filesystem::absolute(path).string();
}

/// Has a participant of this role use the files that scripts/security left in `folder`.
void set_security(fastdds::DomainParticipantQos& qos, const std::string& folder, Role role) {
  const std::string name = certificate_name(role);
  const std::string authority = readable(folder, "authority.pem");
  const std::string identity = "dds.sec.auth.builtin.PKI-DH.", access = "dds.sec.access.builtin.Access-Permissions.";
  auto& properties = qos.properties().properties();
  properties.emplace_back("dds.sec.auth.plugin", "builtin.PKI-DH");
  properties.emplace_back(identity + "identity_ca", authority);
  properties.emplace_back(identity + "identity_certificate", readable(folder, name + ".pem"));
  properties.emplace_back(identity + "private_key", readable(folder, name + ".key"));
  properties.emplace_back("dds.sec.access.plugin", "builtin.Access-Permissions");
  properties.emplace_back(access + "permissions_ca", authority);
  properties.emplace_back(access + "governance", readable(folder, "governance.p7s"));
  properties.emplace_back(access + "permissions", readable(folder, name + ".p7s"));
  properties.emplace_back("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
}

}  // namespace

std::string certificate_name(Role role) {
  switch (role) {
    case Role::coordinator:
    case Role::reporter:
      return "coordinator";
    case Role::worker:
      return "worker";
    case Role::watcher:
      break;
  }
  return "watcher";
}

fastdds::DomainParticipantQos participant_qos(const DdsOptions& options, Role role, const std::string& name) {
  fastdds::DomainParticipantQos qos = fastdds::PARTICIPANT_QOS_DEFAULT;
  qos.name(name);
  if (role == Role::worker) std::ranges::copy(participant_of(name), qos.wire_protocol().prefix.value);
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->sendBufferSize = kSocketBuffer_bytes;
  udp->receiveBufferSize = kSocketBuffer_bytes;
  udp->maxInitialPeersRange = kParticipantsPerHost;
  udp->interfaceWhiteList = bound_addresses(options);
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(std::move(udp));
  qos.transport().send_socket_buffer_size = kSocketBuffer_bytes;
  qos.transport().listen_socket_buffer_size = kSocketBuffer_bytes;
  set_discovery(qos.wire_protocol().builtin, options);
  if (!options.security.empty()) set_security(qos, options.security, role);
  return qos;
}

}  // namespace demecal::inline dds
