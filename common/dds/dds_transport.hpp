// The transport over Fast DDS.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "protocol/messages.hpp"
#include "transport/transport.hpp"

namespace CLI {
class App;
}

namespace demecal::inline dds {

struct DdsOptions {
  std::uint32_t domain = 0;
  /// local: this machine only, unicast over 127.0.0.1; network: every interface, multicast discovery; with peers,
  /// unicast discovery to them; with a discovery server, through it.
  enum class Reach { local, network } reach = Reach::local;
  std::vector<std::string> interfaces;  ///< addresses to bind to; empty: all (network) or 127.0.0.1 (local)
  std::vector<std::string> peers;       ///< "ADDRESS" of other hosts
  std::string discovery_server;         ///< "ADDRESS:PORT", or empty
  /// Folder of certificates that scripts/security made; empty: none are needed. Not with a discovery server: Fast DDS's
  /// own shows no certificate.
  std::string security;
};

/// Adds --domain, --network, --interface, --peer, --discovery-server and --security; what they say is in the result
/// once the command line is parsed.
std::shared_ptr<DdsOptions> add_dds_arguments(CLI::App& command);
/// `options` as the arguments that add_dds_arguments() reads.
std::vector<std::string> dds_arguments(const DdsOptions& options);

/// Runs `leave` on a thread of its own. Whether it ended within `patience`: where not, the thread is abandoned, and the
/// process will exit without waiting for it, with the status that it exits with.
bool leave_within(std::chrono::milliseconds patience, std::function<void()> leave);

/// Joins the domain; the transport leaves it, when it is destroyed, within ten seconds. `name` identifies a worker in
/// WorkerLost. Throws std::runtime_error where no participant can be made, and InputError where an address is none or a
/// certificate is missing or not accepted.
std::unique_ptr<Transport> join_dds(const DdsOptions& options, Role role, const std::string& name);

}  // namespace demecal::inline dds
