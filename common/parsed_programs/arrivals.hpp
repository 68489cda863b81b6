// Where the arm comes from to each motion of a program, on all the paths that lead there.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "parsed_programs/program.hpp"

namespace demecal::inline parsed_programs {

/// Of every byte where the program moves to a target: the bytes of the motions that the arm may come from, in the order
/// of the text; empty where that is not known on one of the paths, or there are more than 16.
std::map<std::size_t, std::vector<std::size_t>> arrivals(const Program& program);

}  // namespace demecal::inline parsed_programs
