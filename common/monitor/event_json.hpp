// Events as JSON values, for documents that contain them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "protocol/messages.hpp"

namespace demecal::inline monitor {

/// What event_line() writes; null where that is empty.
nlohmann::ordered_json event_json(const Message& message, double time_s);

/// The value in one line, without its end.
std::string one_line(const nlohmann::ordered_json& json);

}  // namespace demecal::inline monitor
