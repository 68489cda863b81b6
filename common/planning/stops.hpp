// How many poses judge a calibration, and the order in which all are measured.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "planning/cell.hpp"
#include "planning/plan.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {

/// Poses for validation, or for acceptance, beside so many that calibrate.
int judging(const std::optional<int>& asked, int calibration);

/// As many where sockets are touched: of a contact that few poses touch nobody knows how well they agree.
std::size_t at_sockets(const std::optional<int>& asked, std::size_t usual, std::size_t sockets);

void add_stops(std::span<const PlannedPose> from, std::size_t count, PoseSet set, std::vector<PlannedStop>& stops);

/// Fills in the stops in the order of measuring, their ids and counts and, where no sockets are touched, the way.
void order_stops(const FeasibleSpace& space, std::vector<PlannedStop> stops, RandomStream random, Plan& plan);

}  // namespace demecal::inline planning
