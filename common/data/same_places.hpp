// Which measured poses are of one place: repeats, however a file names them and whatever its logged joints scatter by.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline data {

/// rad or m: to what joints that are driven to again are read.
inline constexpr double kSameReading = 2e-4;

/// Whether no joint of one differs by more from the other's.
bool same_reading(const JointVector& one, const JointVector& other);

/// The place of each of `rows`, counted from 0 as they first appear: poses of one name are at one place, and so are
/// poses whose joints read the same, directly or by others between.
std::vector<std::size_t> places_of(const DataSet& data, std::span<const std::size_t> rows);

}  // namespace demecal::inline data
