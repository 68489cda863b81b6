#include "updating/joint_rounding.hpp"

#include <fmt/format.h>
#include <cmath>
#include <vector>

#include "kinematics/units.hpp"

namespace demecal::inline updating {
namespace {

constexpr double kNotableRounding = 0.3;  ///< of the noise

}  // namespace

std::optional<JointRounding> notable_rounding(const Chain& chain, const DataSet& data,
                                              std::span<const std::size_t> poses, double noise_m) {
  std::vector<JointVector> joints;
  for (const std::size_t pose : poses) joints.push_back(data.poses[pose].joints);
  const JointSteps steps = joint_steps(chain, joints);
  double squares = 0.0;
  for (const std::size_t pose : poses)
    squares += rounding_m2(chain, data.poses[pose].joints, nominal_tool(data, data.poses[pose]), steps);
  const double rounded_m = std::sqrt(squares / static_cast<double>(poses.size()));
  if (!(rounded_m > kNotableRounding * std::sqrt(3.0) * noise_m)) return std::nullopt;
  const std::string step = steps.angle_rad > 0.0 ? fmt::format("{:.2g} deg", degrees(steps.angle_rad))
                                                 : fmt::format("{:.2g} mm", millimetres(steps.slide_m));
  return JointRounding{
      steps, fmt::format("Joints are written to {} only, which alone moves the tool by {:.2g} mm (rms): it counts as "
                         "noise, so that changes below it may be missed. Note joints to 0.001 deg.",
                         step, millimetres(rounded_m))};
}

}  // namespace demecal::inline updating
