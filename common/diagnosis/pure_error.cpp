#include <cmath>
#include <map>
#include <utility>

#include "diagnosis/structure.hpp"
#include "fitting/distributions.hpp"

namespace demecal {

std::optional<PureError> pure_error(const DataSet& data, std::span<const std::size_t> poses) {
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> repeats;
  for (const std::size_t pose : poses) {
    const MeasuredPose& at = data.poses[pose];
    if (at.position_m && !at.pose_id.empty()) repeats[{at.pose_id, at.target}].push_back(pose);
  }
  PureError error;
  for (const auto& [id, group] : repeats) {
    if (group.size() < 2) continue;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const std::size_t pose : group) mean += *data.poses[pose].position_m / static_cast<double>(group.size());
    for (const std::size_t pose : group) error.squares += (*data.poses[pose].position_m - mean).squaredNorm();
    error.freedom += 3.0 * static_cast<double>(group.size() - 1);
  }
  if (error.freedom == 0.0) return std::nullopt;
  error.deviation_m = std::sqrt(error.squares / error.freedom);
  return error;
}

double lack_of_fit_p_value(const PureError& pure, double squares_m2, double freedom) {
  const double more = freedom - pure.freedom, excess = squares_m2 - pure.squares;
  if (more <= 0.0 || excess <= 0.0) return 1.0;
  if (pure.squares <= 0.0) return 0.0;
  const double ratio = (excess / more) / (pure.squares / pure.freedom);
  return fisher_p_value(ratio, more, pure.freedom);
}

}  // namespace demecal
