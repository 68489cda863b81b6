// `prepare` of recordings of joints: the contacts in them as a data set.
#pragma once

#include <string>

#include "coordinator/commands.hpp"
#include "preparation/recorded_contacts.hpp"

namespace demecal {

struct RecordedOutput {
  std::string out;
  bool json = false, force = false;
};

/// Finds the contacts, checks the data set and writes it with standstills.csv.
ExitCode prepare_recordings(const Recordings& recordings, const RecordedOutput& output);

}  // namespace demecal
