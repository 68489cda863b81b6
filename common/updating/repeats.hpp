// Repeats of a pose, taken together: what a model errs by at a pose is the same in each, so that they tell as much as
// one.
#pragma once

#include <cstddef>
#include <vector>

#include "data/data_set.hpp"

namespace demecal::inline updating {

struct DistinctPoses {
  DataSet data;                       ///< one pose for all its repeats, of their mean
  std::vector<std::size_t> measured;  ///< of each, the first of its repeats in the data set that it is made of
  std::vector<std::vector<std::size_t>> repeats{};  ///< of each, all of them
};

/// Repeats stand at the same joints with the same tool, payload and side that joints come from, at temperatures less
/// than 1 K apart. A data set without any is returned as it is.
DistinctPoses distinct_poses(const DataSet& data);

}  // namespace demecal::inline updating
