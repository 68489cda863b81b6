// Which job a run is of, in hashes of all that its result is a function of.
#pragma once

#include <string>

#include "calibration/job.hpp"
#include "coordinator/journal_records.hpp"
#include "data/data_set.hpp"

namespace demecal {

/// `job` is that of the file with what options override in it. Throws InputError where a file cannot be read.
JobIdentity identity_of(const std::string& job_file, const Job& job, const DataSet& data, bool asynchronous);

/// Whether two paths name one folder; of folders that are missing, whether they are written alike.
bool same_folder(const std::string& a, const std::string& b);

}  // namespace demecal
