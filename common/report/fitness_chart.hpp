// The plot of a joint's evolution: the best fitness of each of its islands over the generations.
#pragma once

#include <string>

#include "report/fitness_history.hpp"

namespace demecal {

/// One line per island with one point per row of the history, fitness on a logarithmic scale that all joints of
/// `history` share, as inline SVG. Empty where the joint has no points.
std::string fitness_chart(const FitnessHistory& history, std::uint64_t joint);

/// The best of all: "best 1.23 in generation 200, island 2"; empty where the joint has no points.
std::string fitness_caption(const FitnessHistory& history, std::uint64_t joint);

}  // namespace demecal
