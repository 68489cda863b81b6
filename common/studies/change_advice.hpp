// What `check` found, in words, and what to do about it.
#pragma once

#include <string>
#include <utility>

#include "data/data_set.hpp"
#include "updating/change.hpp"

namespace demecal::inline studies {

/// The unit that people use, and how many of it one inside is.
std::pair<std::string, double> shown_unit(const std::string& unit);

/// The cause in words. Of what the model has already: from how much to how much it went; lost motion is counted end to
/// end there.
std::string sentence_on(const ChangeCause& cause, const Robot& robot);

/// The same of a cause that was found, and of a zero at which temperature.
std::string sentence_on(const ChangeReport& change, const ChangeCause& cause, const Robot& robot);

/// What to do, in sentences; `model_file` is the one that was compared.
std::string what_to_do(const ChangeReport& change, const std::string& model_file);

}  // namespace demecal::inline studies
