// What the check of the data found, for terminal, page and report.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "data_check/finding.hpp"

namespace demecal {

/// A sentence a line, the gravest first, at most 100 columns wide; empty where nothing was found.
std::string data_check_to_terminal(const DataCheck& check);

/// {"verdict", "findings": [{"kind", "joint", "poses", "error_mm": {"as_given", "if_changed"}, "sentence"}]}
nlohmann::ordered_json data_check_to_json(const DataCheck& check);

}  // namespace demecal
