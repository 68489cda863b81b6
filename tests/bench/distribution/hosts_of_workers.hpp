// Hosts for many worker processes on this machine: a network namespace for each, and one for their coordinator.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>
#include <vector>

#include "coordinator/workers.hpp"
#include "dds/dds_transport.hpp"
#include "hosts.hpp"

namespace demecal::bench {

/// A process that sees the network as `network` does, and ends with what is returned.
std::unique_ptr<LocalWorkers> started_in_network(pid_t network, const std::string& program,
                                                 const std::vector<std::string>& arguments);

/// While it is there, the thread that made it sees the network of the coordinator's host.
class HostsOfWorkers {
 public:
  /// Throws std::runtime_error naming what is missing: root, `ip`, or `fast-discovery-server`.
  HostsOfWorkers(int workers, std::uint32_t domain);
  ~HostsOfWorkers();
  HostsOfWorkers(const HostsOfWorkers&) = delete;
  HostsOfWorkers& operator=(const HostsOfWorkers&) = delete;

  /// By a discovery server on the coordinator's host.
  const DdsOptions& dds() const { return dds_; }
  /// For each worker a process that sees its host's network.
  std::vector<pid_t> networks() const;

 private:
  int workers_;
  Hosts hosts_;
  int before_;  ///< the network seen before
  DdsOptions dds_;
  std::unique_ptr<LocalWorkers> server_;
};

}  // namespace demecal::bench
