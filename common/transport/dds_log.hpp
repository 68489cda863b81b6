// What Fast DDS itself has to say.
#pragma once

namespace demecal {

/// Only errors, on standard error, not where results are printed; each kind of error once, since a participant that
/// sends nonsense can cause one with every packet.
void set_up_dds_log();

}  // namespace demecal
