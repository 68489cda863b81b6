// How a participant reaches the others: sockets, addresses and discovery.
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <string>

#include "transport/dds.hpp"

namespace demecal {

/// Throws InputError where a peer or the discovery server is no address.
eprosima::fastdds::dds::DomainParticipantQos participant_qos(const DdsOptions& options, const std::string& name);

}  // namespace demecal
