// The options of the command line that say which domain to join and how, and who works there.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <thread>

#include "dds/dds_transport.hpp"

namespace demecal {

/// Adds --domain, --network, --interface, --peer, --discovery-server and --security; what they say is in the result
/// once the command line is parsed.
std::shared_ptr<DdsOptions> add_dds_arguments(CLI::App& command);

/// Where a command's workers come from.
struct FleetArguments {
  int workers = static_cast<int>(std::thread::hardware_concurrency());  ///< local processes
  std::shared_ptr<DdsOptions> dds;
};
/// Adds --workers and those of add_dds_arguments(); `fleet` outlives the command.
void add_fleet_arguments(CLI::App& command, FleetArguments& fleet);

}  // namespace demecal
