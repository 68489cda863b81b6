// Authentication, access control and encryption: what a participant shows of itself, and demands of the others.
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <string>

#include "transport/transport.hpp"

namespace demecal {

/// The name of the certificate by which a role takes part: a herald speaks for its coordinator.
std::string certificate_name(Role role);

/// Has a participant of this role use the files that scripts/security left in `folder`. Throws InputError, naming the
/// file, where one is missing or cannot be read.
void set_security(eprosima::fastdds::dds::DomainParticipantQos& qos, const std::string& folder, Role role);

}  // namespace demecal
