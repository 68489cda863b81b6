#include "joint_courses.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace demecal::bench {
namespace {

constexpr std::size_t kPosesOfLeg = 5;
constexpr std::size_t kGridLevels[] = {5, 5, 8};  ///< of the first joints; the last of them changes with every pose
constexpr std::size_t kWristLevels = 7;

JointVector random_place(const JointRanges& ranges, RandomStream& random) {
  JointVector joints(static_cast<Eigen::Index>(ranges.size()));
  for (std::size_t i = 0; i < ranges.size(); ++i)
    joints[static_cast<Eigen::Index>(i)] = random.real(ranges[i][0], ranges[i][1]);
  return joints;
}

std::vector<JointVector> path(const JointRanges& ranges, std::size_t poses, RandomStream& random) {
  std::vector<JointVector> all;
  JointVector from = random_place(ranges, random), to = random_place(ranges, random);
  for (std::size_t i = 0; i < poses; ++i) {
    const std::size_t step = i % kPosesOfLeg;
    if (i > 0 && step == 0) from = std::exchange(to, random_place(ranges, random));
    const double part = static_cast<double>(step) / static_cast<double>(kPosesOfLeg);
    all.emplace_back(from + 0.5 * (1.0 - std::cos(std::numbers::pi * part)) * (to - from));
  }
  return all;
}

double at_level(const std::array<double, 2>& range, std::size_t level, std::size_t levels) {
  return std::lerp(range[0], range[1], (static_cast<double>(level) + 0.5) / static_cast<double>(levels));
}

JointVector grid_place(const JointRanges& ranges, std::size_t number, RandomStream& random) {
  JointVector joints(static_cast<Eigen::Index>(ranges.size()));
  for (std::size_t i = std::size(kGridLevels); i < ranges.size(); ++i)
    joints[static_cast<Eigen::Index>(i)] = at_level(ranges[i], random.index(kWristLevels), kWristLevels);
  for (std::size_t i = std::size(kGridLevels); i-- > 0;) {
    const std::size_t levels = kGridLevels[i], step = number % levels;
    number /= levels;
    joints[static_cast<Eigen::Index>(i)] = at_level(ranges[i], number % 2 == 0 ? step : levels - 1 - step, levels);
  }
  return joints;
}

}  // namespace

std::vector<JointVector> joint_course(Course course, const JointRanges& ranges, std::size_t poses,
                                      RandomStream& random) {
  if (course == Course::path) return path(ranges, poses, random);
  std::vector<JointVector> all;
  for (std::size_t i = 0; i < poses; ++i)
    all.push_back(course == Course::grid ? grid_place(ranges, i, random) : random_place(ranges, random));
  return all;
}

}  // namespace demecal::bench
