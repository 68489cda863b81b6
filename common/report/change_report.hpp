// What `check` says of a robot: as JSON, and for a terminal.
#pragma once

#include <string>

#include "data/data_set.hpp"
#include "updating/change.hpp"

namespace demecal::inline report {

/// One JSON object on one line.
std::string to_json(const ChangeReport& change, const DataSet& data, const std::string& model_file);

/// The answer first, then what was found and what to do, then how sure it is.
std::string change_text(const ChangeReport& change, const DataSet& data, const std::string& model_file);

}  // namespace demecal::inline report
