// The transport inside one process: the twin of the DDS one, for tests and for runs without a network.
#pragma once

#include <memory>

#include "transport/transport.hpp"

namespace demecal {

class Exchange;  ///< what the DDS domain is to the other: where in-memory participants meet

std::shared_ptr<Exchange> make_exchange();
/// Joins the exchange. `name` identifies a worker: when its transport is destroyed without a WorkerStatus that says
/// `leaving`, the others receive WorkerLost{name}.
std::unique_ptr<Transport> join(std::shared_ptr<Exchange> exchange, Role role, const std::string& name);

}  // namespace demecal
