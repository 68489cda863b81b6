// What a terminal shows of reports, the closed loop, studies, comparisons and plans.
#pragma once

#include <cstddef>
#include <string>

#include "planning/plan.hpp"
#include "report/evaluation.hpp"
#include "report/report.hpp"
#include "studies/study.hpp"

namespace demecal::inline terminal {

/// Mean, rms, P95 and max in mm of every stage on every set that has poses; the joints' errors in rad; what the poses
/// could not see; what was named. At most 100 columns wide.
std::string to_terminal(const Report& report);

/// One stage's figures, and how far single poses are predicted to err, where that is known.
std::string to_terminal(const Evaluation& evaluation);

/// How many findings are shown: ten where report.json has the others, all where no report is written.
enum class ShownFindings { ten, all };

/// What the check of the data found: a sentence a line, the gravest first, at most 100 columns wide; empty where
/// nothing was found.
std::string to_terminal(const DataCheckEntry& check, ShownFindings shown);

/// One line per effect added with its size, p and the validation error before and after (many gear harmonics take one
/// line per joint), what it may be taken for, what to measure next, what was tried last, why the loop stopped, and
/// what was not found. At most kTerminalColumns wide; empty where the loop did not run.
std::string loop_to_terminal(const Report& report);

/// The part of it that says what the loop could not find or not see, how measurements scatter together, and how the
/// controls fared: a few kinds that people ask for first have a line each, "no backlash: joint 2 below 8 arcsec", or
/// between which limits where several places were searched.
std::string limits_to_terminal(const Report& report);

/// A line for every cell, with medians over its seeds and how sure they are, in words below.
std::string study_table(const Study& study);

/// The first `most` blocks, a line each; a sentence where there are none.
std::string blocks_table(const Study& study, std::size_t most);

/// A line per method: validation and accept error, numbers identified, time. At most 100 columns wide.
std::string comparison_table(const Comparison& comparison);

/// What is planned and what it is predicted to reach, the first of what it cannot tell and would find, what may be
/// wrong with it, and the first thing it rests on; the plan's page has all of them. At most kTerminalColumns wide.
std::string to_terminal(const Plan& plan, const PlanRequest& request);

}  // namespace demecal::inline terminal
