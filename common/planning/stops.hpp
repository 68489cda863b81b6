// How many poses judge a calibration, and the order in which all are measured.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "data/data_set.hpp"
#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "planning/plan.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {

/// Poses of this set to measure beside so many that calibrate: as asked for, or as many as are still lacking.
int judging(const PlanRequest& request, PoseSet set, int calibration);

/// As many where sockets are touched: of a contact that few poses touch nobody knows how well they agree.
std::size_t at_sockets(const std::optional<int>& asked, std::size_t usual, std::size_t sockets);

/// Those of `poses` that are not the poses of these stops.
std::vector<PlannedPose> poses_but(std::vector<PlannedPose> poses, const std::vector<PlannedStop>& stops,
                                   const std::vector<std::size_t>& but);

void add_stops(std::span<const PlannedPose> from, std::size_t count, PoseSet set, std::vector<PlannedStop>& stops);

/// Fills in the stops in the order of measuring, their ids (from "P1", or behind those measured before) and counts and,
/// where no sockets are touched, the way.
void order_stops(const FeasibleSpace& space, const std::optional<DataSet>& measured, std::vector<PlannedStop> stops,
                 RandomStream random, Plan& plan);

}  // namespace demecal::inline planning
