#include "coordinator/dds_fleet.hpp"

#include <string>
#include <vector>

namespace demecal {
namespace {

std::vector<std::string> worker_arguments(const DdsOptions& options, RunId run) {
  std::vector<std::string> arguments{"--domain", std::to_string(options.domain), "--only-run", std::to_string(run)};
  const auto add = [&](const char* option, const std::string& value) {
    arguments.emplace_back(option);
    arguments.push_back(value);
  };
  if (options.reach == DdsOptions::Reach::network) arguments.emplace_back("--network");
  for (const std::string& address : options.interfaces) add("--interface", address);
  for (const std::string& peer : options.peers) add("--peer", peer);
  if (!options.discovery_server.empty()) add("--discovery-server", options.discovery_server);
  if (!options.security.empty()) add("--security", options.security);
  return arguments;
}

}  // namespace

DdsFleet::DdsFleet(const DdsOptions& options, int local_workers)
    : options_(options),
      local_workers_(local_workers),
      transport_(join_dds(options, Role::coordinator, "coordinator")) {}

void DdsFleet::launch(RunId run) {
  if (workers_ && workers_->any_alive()) return;
  std::vector<std::string> arguments = worker_arguments(options_, run);
  int processes = local_workers_;
  if (!options_.security.empty() && processes > 0) {
    arguments.insert(arguments.end(), {"--slots", std::to_string(processes)});
    processes = 1;
  }
  workers_.emplace(beside_this_program("demecal-worker"), arguments, processes);
}

}  // namespace demecal
