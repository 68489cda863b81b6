#include "data/spread_poses.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

namespace demecal::inline data {

std::vector<std::size_t> spread_indices(std::size_t size, std::size_t count) {
  std::vector<std::size_t> indices(size);
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  if (size <= count) return indices;
  // Multiples of the golden ratio fall evenly between whole numbers and share no period with the order of targets.
  const auto rank = [](std::size_t i) {
    double whole = 0.0;
    return std::pair(std::modf(static_cast<double>(i) * std::numbers::phi, &whole), i);
  };
  std::ranges::sort(indices, {}, rank);
  indices.resize(count);
  std::ranges::sort(indices);
  return indices;
}

std::vector<std::size_t> spread_poses(std::span<const std::size_t> poses, std::size_t count) {
  std::vector<std::size_t> chosen = spread_indices(poses.size(), count);
  for (std::size_t& one : chosen) one = poses[one];
  return chosen;
}

}  // namespace demecal::inline data
