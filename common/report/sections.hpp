// The parts of the report's page, in its order: each the HTML of one part, empty where the report has nothing for it.
#pragma once

#include <string>

#include "report/error_stages.hpp"
#include "report/fitness_history.hpp"
#include "report/json_value.hpp"

namespace demecal {

/// What was calibrated, the error before and after in one sentence, and the figures to judge by.
std::string opening(const JsonValue& report, const ErrorStages& errors);
/// The tool error from stage to stage, as table and bars.
std::string stages_section(const JsonValue& report, const ErrorStages& errors);
/// What the closed loop tried, found and could not find.
std::string loop_section(const JsonValue& report);
/// Every joint's error, correction and evolution.
std::string joints_section(const JsonValue& report, const FitnessHistory& history);
/// The identified numbers, and what these poses cannot identify.
std::string parameters_section(const JsonValue& report);
/// Poses that were noticed, by name.
std::string poses_section(const JsonValue& report);
/// What the run took, and what repeats it.
std::string run_section(const JsonValue& report);

/// The mean tool error (mm) that the measurement's noise alone makes, from the floor's standard deviation per axis.
std::optional<double> noise_mean_mm(const JsonValue& report);

}  // namespace demecal
