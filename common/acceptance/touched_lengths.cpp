#include "acceptance/touched_lengths.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <string>

namespace demecal::inline acceptance {
namespace {

Eigen::Vector3d tool_m(const CorrectedRobot& robot, const MeasuredPose& pose) {
  return robot.predict(Stop(pose), pose.target).translation();
}

}  // namespace

bool touch_alone(const DataSet& data, std::span<const std::size_t> rows) {
  return !rows.empty() && std::ranges::all_of(rows, [&](std::size_t row) {
    const MeasuredPose& pose = data.poses[row];
    return !pose.contact.empty() && !pose.position_m && pose.distances_m.empty();
  });
}

std::vector<TouchedLength> touched_lengths(const DataSet& data, std::span<const std::size_t> rows,
                                           const CorrectedRobot& robot) {
  std::map<std::string, std::deque<std::size_t>> touching;
  for (const std::size_t row : rows)
    if (data.contacts.form_of(data.poses[row].contact).kind == ContactKind::point)
      touching[data.poses[row].contact].push_back(row);
  std::vector<TouchedLength> lengths;
  for (bool more = true; more;) {
    more = false;
    for (const KnownDistance& known : data.contacts.distances) {
      std::deque<std::size_t>&first = touching[known.first], &second = touching[known.second];
      if (first.empty() || second.empty()) continue;
      TouchedLength one{.known = &known, .rows = {first.front(), second.front()}};
      first.pop_front();
      second.pop_front();
      for (std::size_t end = 0; end < 2; ++end) one.ends_m[end] = tool_m(robot, data.poses[one.rows[end]]);
      one.error_m = std::abs((one.ends_m[0] - one.ends_m[1]).norm() - known.length_m);
      lengths.push_back(one);
      more = true;
    }
  }
  return lengths;
}

}  // namespace demecal::inline acceptance
