// Ctrl-C and termination, as a flag that long work looks at.
#pragma once

#include <atomic>

namespace demecal {

/// From now on SIGINT and SIGTERM set the returned flag; a second one ends the program at once.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace demecal
