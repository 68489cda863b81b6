#include "coordinator/dds_arguments.hpp"

namespace demecal {

std::shared_ptr<DdsOptions> add_dds_arguments(CLI::App& command) {
  const auto dds = std::make_shared<DdsOptions>();
  const auto reach_out = [dds](std::int64_t) { dds->reach = DdsOptions::Reach::network; };
  command.add_option("--domain", dds->domain, "DDS domain")
      ->envname("DEMECAL_DOMAIN")
      ->check(CLI::Range(0, 230))
      ->capture_default_str();
  command.add_flag("--network", reach_out, "see other machines too, found by multicast");
  command.add_option("--interface", dds->interfaces, "addresses of the network interfaces to use");
  command.add_option("--peer", dds->peers, "addresses of other hosts, where there is no multicast");
  command.add_option("--discovery-server", dds->discovery_server, "ADDRESS:PORT of a discovery server");
  command
      .add_option("--security", dds->security,
                  "folder of certificates, from scripts/security; not with a discovery server")
      ->excludes("--discovery-server");
  command.parse_complete_callback([dds] {
    if (!dds->peers.empty() || !dds->discovery_server.empty()) dds->reach = DdsOptions::Reach::network;
  });
  return dds;
}

void add_fleet_arguments(CLI::App& command, FleetArguments& fleet) {
  command.add_option("--workers", fleet.workers, "local worker processes; 0 waits for workers started elsewhere")
      ->check(CLI::Range(0, 256))
      ->default_str("one per core");  // not their number: the manual page is of every machine
  fleet.dds = add_dds_arguments(command);
}

}  // namespace demecal
