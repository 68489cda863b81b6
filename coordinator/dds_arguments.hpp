// The options of the command line that say which domain to join, and how.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "transport/dds.hpp"

namespace demecal {

/// Adds --domain, --network, --interface, --peer, --discovery-server and --security; what they say is in the result
/// once the command line is parsed.
std::shared_ptr<DdsOptions> add_dds_arguments(CLI::App& command);

}  // namespace demecal
