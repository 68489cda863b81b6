// The robot programs of a plan: they drive along its way and wait where something is measured.
#pragma once

#include <string>
#include <vector>

#include "kinematics/chain.hpp"
#include "parsed_programs/language.hpp"
#include "planning/plan.hpp"

namespace demecal::inline drafting {

/// The stops of the way: P1 is measured, A1 comes before it, W1 and W1b are on the way there.
std::vector<ProgrammedStop> programmed_stops(const Plan& plan);

/// One program of the way. Its head says from where nobody has looked whether the way is free, and which poses it
/// leaves out; empty where the language has no targets of such an arm's joints or nothing is driven to.
std::string planned_program(const Plan& plan, const Chain& arm, const Language& language);

/// The second file of the same program, where programs of the language are two.
std::string planned_program_beside(const Plan& plan, const Language& language);

/// Why no program is written in languages that plans are otherwise written in, as a sentence; empty: all are.
std::string programs_left_out(const Plan& plan, const Chain& arm);

}  // namespace demecal::inline drafting
