// What the arm carries at each motion of a program whose statements say it.
#pragma once

#include "parsed_programs/program.hpp"

namespace demecal::inline parsed_programs {

/// The program, every target with the payload that statements state on all ways to all motions to it. One that states
/// its own keeps it; one to which ways lead on which no statement stands, or one that cannot be read, or others of
/// another payload, states none. A routine begins with what its callers carry.
Program with_followed_payloads(Program program);

}  // namespace demecal::inline parsed_programs
