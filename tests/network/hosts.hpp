// Several hosts on this machine: network namespaces whose links meet at a bridge, and can be cut.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace demecal {

/// The namespaces have no names and are held by processes that die with this one: whatever becomes of a test, nothing
/// stays behind. Hosts count from 0.
class Hosts {
 public:
  /// Throws std::runtime_error, with the reason, where they cannot be made: that takes root and the program `ip`.
  explicit Hosts(int count);
  ~Hosts();
  Hosts(const Hosts&) = delete;
  Hosts& operator=(const Hosts&) = delete;

  /// A process that sees the network as this host does.
  pid_t at(int host) const { return hosts_.at(static_cast<std::size_t>(host)); }
  /// The host's address, which all others reach.
  static std::string address(int host) { return "10.99.0." + std::to_string(1 + host); }

  /// Nothing arrives at the host or leaves it, until it is healed.
  void cut(int host) const { set_link(host, "down"); }
  void heal(int host) const { set_link(host, "up"); }

 private:
  void connect(int host) const;
  void set_link(int host, const std::string& state) const;

  pid_t bridge_;  ///< sees the bridge and the other end of every host's link
  std::vector<pid_t> hosts_;
};

}  // namespace demecal
