#include "hosts_of_workers.hpp"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace demecal::bench {
namespace {

constexpr const char* kServer = "/usr/bin/fast-discovery-server";
constexpr const char* kPort = "11811";

void see_network(int network) {
  if (::setns(network, CLONE_NEWNET) != 0)
    throw std::runtime_error(std::string("cannot enter a network namespace: ") + std::strerror(errno));
}

int network_of(const std::string& process) {
  return ::open(("/proc/" + process + "/ns/net").c_str(), O_RDONLY | O_CLOEXEC);
}

/// Of so many hosts; throws where what they take is missing.
int checked(int hosts) {
  if (::access(kServer, X_OK) != 0)
    throw std::runtime_error(std::string("no ") + kServer + ": Debian's fastdds-tools has it");
  return hosts;
}

}  // namespace

std::unique_ptr<LocalWorkers> started_in_network(pid_t network, const std::string& program,
                                                 const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"--target", std::to_string(network), "--net", "--", program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return std::make_unique<LocalWorkers>("/usr/bin/nsenter", words, 1);
}

HostsOfWorkers::HostsOfWorkers(int workers, std::uint32_t domain)
    : workers_(workers), hosts_(checked(workers + 1)), before_(network_of("self")) {
  dds_.domain = domain;
  dds_.reach = DdsOptions::Reach::network;
  dds_.discovery_server = Hosts::address(0) + ":" + kPort;
  server_ = started_in_network(hosts_.at(0), kServer,
                               {"-x", std::string(DEMECAL_SOURCE_DIR) + "/configs/dds/discovery-server.xml", "-i", "0",
                                "-l", Hosts::address(0), "-p", kPort});
  const int own = network_of(std::to_string(hosts_.at(0)));
  see_network(own);
  ::close(own);
}

HostsOfWorkers::~HostsOfWorkers() {
  ::setns(before_, CLONE_NEWNET);
  ::close(before_);
}

std::vector<pid_t> HostsOfWorkers::networks() const {
  std::vector<pid_t> all;
  for (int worker = 1; worker <= workers_; ++worker) all.push_back(hosts_.at(worker));
  return all;
}

}  // namespace demecal::bench
