#include "data/same_places.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <utility>

namespace demecal::inline data {
namespace {

/// The first row that `row` is at one place with, as far as is known.
std::size_t first_row_of(std::vector<std::size_t>& parents, std::size_t row) {
  while (parents[row] != row) {
    parents[row] = parents[parents[row]];
    row = parents[row];
  }
  return row;
}

}  // namespace

bool same_reading(const JointVector& one, const JointVector& other) {
  return one.size() == other.size() && (one.size() == 0 || (one - other).cwiseAbs().maxCoeff() <= kSameReading);
}

std::vector<std::size_t> places_of(const DataSet& data, std::span<const std::size_t> rows) {
  std::vector<std::size_t> parents(rows.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  const auto join = [&](std::size_t a, std::size_t b) {
    const std::size_t first = first_row_of(parents, a), second = first_row_of(parents, b);
    parents[std::max(first, second)] = std::min(first, second);
  };
  std::map<std::string, std::size_t> by_name;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string& name = data.poses[rows[i]].pose_id;
    if (!name.empty()) join(i, by_name.try_emplace(name, i).first->second);
  }
  const auto joints_of = [&](std::size_t i) -> const JointVector& { return data.poses[rows[i]].joints; };
  const auto first_joint = [&](std::size_t i) { return joints_of(i).size() == 0 ? 0.0 : joints_of(i)[0]; };
  std::vector<std::size_t> ascending(rows.size());
  std::iota(ascending.begin(), ascending.end(), std::size_t{0});
  std::ranges::stable_sort(ascending, {}, first_joint);
  for (std::size_t k = 0; k < ascending.size(); ++k) {
    for (std::size_t next = k + 1; next < ascending.size(); ++next) {
      if (first_joint(ascending[next]) - first_joint(ascending[k]) > kSameReading) break;
      if (same_reading(joints_of(ascending[k]), joints_of(ascending[next]))) join(ascending[k], ascending[next]);
    }
  }
  std::vector<std::size_t> places;
  std::map<std::size_t, std::size_t> numbers;
  for (std::size_t i = 0; i < rows.size(); ++i)
    places.push_back(numbers.try_emplace(first_row_of(parents, i), numbers.size()).first->second);
  return places;
}

}  // namespace demecal::inline data
