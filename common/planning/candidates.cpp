#include "planning/candidates.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "effects/catalogue.hpp"
#include "effects/effect.hpp"
#include "planning/travel.hpp"

namespace demecal::inline planning {
namespace {

constexpr std::size_t kMostDraws = 150'000;
constexpr std::size_t kUniform = 60'000;  ///< of these

JointVector near_one(const FeasibleSpace& space, const std::vector<PlannedPose>& poses, RandomStream& random) {
  constexpr double kNear = 0.08;  ///< of a joint's range
  JointVector joints = poses[random.index(poses.size())].joints;
  for (std::size_t i = 0; i < space.ranges().size(); ++i) {
    const Interval& range = space.ranges()[i];
    auto& value = joints[static_cast<Eigen::Index>(i)];
    value = std::clamp(value + kNear * (range.upper - range.lower) * random.normal(), range.lower, range.upper);
  }
  return joints;
}

/// Draws sides to come from; returns what is in the way from all of those tried.
Obstruction draw_approach(const FeasibleSpace& space, PlannedPose& pose, RandomStream& random) {
  constexpr int kTries = 4;
  Obstruction obstruction = Obstruction::none;
  for (int i = 0; i < kTries; ++i) {
    for (double& sign : pose.approach) sign = random.chance(0.5) ? 1.0 : -1.0;
    obstruction = on_the_way(space, approach_stop(space, pose), pose.joints);
    if (obstruction == Obstruction::none) break;
  }
  return obstruction;
}

}  // namespace

DrawnPoses draw_poses(const FeasibleSpace& space, std::size_t count, RandomStream random) {
  DrawnPoses found;
  while (found.poses.size() < count && found.drawn < kMostDraws) {
    const bool uniform = found.poses.empty() || found.drawn < kUniform;
    JointVector joints =
        uniform ? space.draw(random) : rounded(space.robot().chain, near_one(space, found.poses, random));
    ++found.drawn;
    Obstruction obstruction = space.obstruction(joints);
    PlannedPose pose{std::move(joints), ApproachSigns(space.robot().chain.size())};
    if (obstruction == Obstruction::none) obstruction = draw_approach(space, pose, random);
    ++found.refused[static_cast<std::size_t>(obstruction)];
    if (obstruction == Obstruction::none) found.poses.push_back(std::move(pose));
  }
  return found;
}

std::vector<Effect> effects_to_detect(const Robot& robot, const std::vector<Interval>& ranges,
                                      const std::vector<std::string>& kinds, bool orientation) {
  constexpr int kHighestRatio = 2;
  const Evidence evidence{.approach = true,
                          .masses = !robot.masses.empty(),
                          .orientation = orientation,
                          .joint_ranges = ranges,
                          .highest_ratio = kHighestRatio};
  std::vector<Effect> effects;
  for (const EffectLaw* law : catalogue()) {
    if (std::ranges::find(kinds, law->kind()) == kinds.end()) continue;
    const std::vector<std::string> forms = law->forms();
    for (Effect& effect : law->proposals(robot, evidence)) {
      const bool plain = effect.form.empty() || forms.empty() || effect.form == forms.front();
      if (plain && !law->takes_formula()) effects.push_back(std::move(effect));
    }
  }
  return effects;
}

}  // namespace demecal::inline planning
