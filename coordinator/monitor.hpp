// Watching: what goes on in a domain, or a recorded run, shown to people or to other programs.
#pragma once

#include <atomic>
#include <chrono>
#include <string>

#include "coordinator/exit_codes.hpp"
#include "transport/transport.hpp"

namespace demecal {

struct MonitorOptions {
  bool json = false;                         ///< a line for each event instead of pages
  bool once = false;                         ///< the present state, then the end
  std::chrono::milliseconds patience{5000};  ///< how long `once` waits for the present state to be complete
  double speed = 1.0;                        ///< of a recorded run: how much faster than it was
  std::string place;                         ///< where one watches, for people: "domain 3"
};

/// Shows on standard output what the transport, a watcher's, brings, until `stop` is set. Done; or, where `once` saw
/// nobody, no_worker.
ExitCode watch(Transport& transport, const std::atomic<bool>& stop, const MonitorOptions& options);

/// Shows a recorded run: the file of events, or the folder that holds it. Throws InputError where it cannot be read.
ExitCode replay(const std::string& path, const std::atomic<bool>& stop, const MonitorOptions& options);

}  // namespace demecal
