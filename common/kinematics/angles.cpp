#include "kinematics/angles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace demecal::inline kinematics {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Controllers round what they report: data this little beyond +-pi still count as quadrant data.
constexpr double kRounding = 1e-6;

}  // namespace

double wrap_near(double angle_rad, double centre_rad) {
  return angle_rad - kTurn * std::round((angle_rad - centre_rad) / kTurn);
}

AngleBranch choose_branch(std::span<const double> angles_rad) {
  std::vector<double> sorted(angles_rad.begin(), angles_rad.end());
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty() || sorted.front() < -std::numbers::pi - kRounding ||
      sorted.back() > std::numbers::pi + kRounding) {
    return {};
  }
  double widest = kTurn - (sorted.back() - sorted.front());  // the arc through +-pi
  AngleBranch branch;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double gap = sorted[i] - sorted[i - 1];
    if (gap > widest) {
      widest = gap;
      branch = {true, std::remainder(sorted[i - 1] + gap / 2 + std::numbers::pi, kTurn)};
    }
  }
  return branch;
}

AngleBranch choose_branch(std::span<const double> angles_rad, double lower_rad, double upper_rad) {
  const double travel = upper_rad - lower_rad;
  if (travel <= 0.0 || travel > kTurn) return choose_branch(angles_rad);
  const bool quadrants_suffice =
      lower_rad >= -std::numbers::pi - kRounding && upper_rad <= std::numbers::pi + kRounding;
  return quadrants_suffice ? AngleBranch{} : AngleBranch{true, (lower_rad + upper_rad) / 2};
}

}  // namespace demecal::inline kinematics
