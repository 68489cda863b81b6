// How a participant reaches the others: sockets, addresses and discovery.
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <string>

#include "dds/dds_transport.hpp"

namespace demecal {

/// The name of the certificate by which a role takes part: a herald publishes for its coordinator.
std::string certificate_name(Role role);

/// A worker's participant is the one that its name stands for (participant_of). Throws InputError where a peer or the
/// discovery server is no address, or a file of the security folder is missing.
eprosima::fastdds::dds::DomainParticipantQos participant_qos(const DdsOptions& options, Role role,
                                                             const std::string& name);

}  // namespace demecal
