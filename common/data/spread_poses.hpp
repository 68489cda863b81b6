// Which of many poses stand for all where not all can be tried.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace demecal::inline data {

/// `count` of 0 .. `size` - 1, all where there are no more, ascending and spread evenly over them, and over what
/// recurs: of targets that were measured in turn each has its share.
std::vector<std::size_t> spread_indices(std::size_t size, std::size_t count);

/// The poses at these places of a list.
std::vector<std::size_t> spread_poses(std::span<const std::size_t> poses, std::size_t count);

}  // namespace demecal::inline data
