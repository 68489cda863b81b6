#include "planning/candidates.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <ranges>
#include <string>
#include <utility>

#include "effects/catalogue.hpp"
#include "effects/effect.hpp"
#include "kinematics/chain.hpp"
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

namespace {

/// Where a form of the law stands among its forms, from its first.
std::size_t rank_of(const EffectLaw& law, const Effect& effect) {
  const std::vector<std::string> forms = law.forms();
  if (effect.form.empty() || forms.empty()) return 0;
  return static_cast<std::size_t>(std::ranges::find(forms, effect.form) - forms.begin());
}

/// Of each joint those of the first form that its proposals have; of a form that takes another's place the one with
/// most coefficients.
std::vector<Effect> plainest(const EffectLaw& law, const Robot& robot, std::vector<Effect> proposals) {
  std::vector<Effect> kept;
  const auto size = [&](const Effect& effect) { return law.coefficients(effect, robot).size(); };
  for (Effect& effect : proposals) {
    const std::size_t rank = rank_of(law, effect);
    const bool outdone = std::ranges::any_of(
        proposals, [&](const Effect& other) { return other.joint == effect.joint && rank_of(law, other) < rank; });
    if (outdone) continue;
    const auto known = std::ranges::find(kept, effect.joint, &Effect::joint);
    if (rank == 0 || known == kept.end())
      kept.push_back(effect);
    else if (size(effect) > size(*known))
      *known = effect;
  }
  return kept;
}

}  // namespace

std::vector<Effect> effects_to_detect(const Robot& robot, const std::vector<Interval>& ranges,
                                      const std::vector<std::string>& kinds, bool orientation) {
  constexpr int kHighestRatio = 3;  // the lowest of gear harmonics stands for all: poses tell them alike
  const Evidence evidence{.approach = true,
                          .masses = !robot.masses.empty(),
                          .orientation = orientation,
                          .joint_ranges = ranges,
                          .highest_ratio = kHighestRatio};
  std::vector<Effect> effects;
  for (const EffectLaw* law : catalogue()) {
    if (std::ranges::find(kinds, law->kind()) == kinds.end() || law->takes_formula()) continue;
    for (Effect& effect : plainest(*law, robot, law->proposals(robot, evidence))) effects.push_back(std::move(effect));
  }
  return effects;
}

std::size_t candidates_for(const InformationModel& model, std::size_t poses) {
  const double numbers = std::max(20.0, static_cast<double>(model.ids().size()));
  const double affordable = 1200.0 * std::pow(33.0 / numbers, 2.0) * 3.0 / model.rows_per_pose();
  return std::max({static_cast<std::size_t>(std::clamp(affordable, 300.0, 1500.0)), 3 * poses});
}

}  // namespace demecal::inline planning
