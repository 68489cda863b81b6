// Effects that only one place judged are taken back unless they explain most of the error there, and what a second
// place is said to add is what real poses at one add.
#include "closed_calibration/one_place.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "fitting/touching_arm.hpp"

namespace demecal {
namespace {

constexpr double kSocketPlay_m = 5e-5;
constexpr DeclaredModel kLinks{.tool = true, .joint_offset = true, .geometry = true};

/// Two sockets 50 mm apart, touched by calibration and validation poses; the same elsewhere where asked for.
KnownArm sockets_of(std::uint64_t seed, bool elsewhere, const Eigen::Vector3d& away_m = {0.0, -0.5, 0.1}) {
  RandomStream stream{seed};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, kLinks);
  const Eigen::Vector3d first_m(0.4, 0.25, 0.2), gauge_m(0.0, 0.05, 0.0);
  for (const PoseSet set : {PoseSet::calibration, PoseSet::validation}) {
    const int count = set == PoseSet::calibration ? 20 : 8;
    touch(arm, stream, "near-0", first_m, count, kSocketPlay_m, set);
    touch(arm, stream, "near-1", first_m + gauge_m, count, kSocketPlay_m, set);
    if (!elsewhere) continue;
    touch(arm, stream, "far-0", first_m + away_m, count, kSocketPlay_m, set);
    touch(arm, stream, "far-1", first_m + gauge_m + away_m, count, kSocketPlay_m, set);
  }
  arm.data.contacts.distances.push_back({"near-0", "near-1", 0.05, 2e-5});
  if (elsewhere) arm.data.contacts.distances.push_back({"far-0", "far-1", 0.05, 2e-5});
  return arm;
}

/// The loop's result where it found something that takes `share` of each link's error away.
LoopResult loop_that_explains(const KnownArm& arm, double share) {
  LoopResult found;
  found.before.robot = found.model.robot = nominal_robot(arm.data);
  for (std::size_t i = 0; i < arm.truth.chain.joints.size(); ++i) {
    Joint& joint = found.model.robot.chain.joints[i];
    const Joint& real = arm.truth.chain.joints[i];
    for (int k = 0; k < kLinkParameters; ++k) {
      const auto link = static_cast<LinkParameter>(k);
      joint.parameter(link) += share * (real.parameter(link) - joint.parameter(link));
    }
  }
  found.model.robot.tools = arm.truth.tools;
  found.before.robot.tools = arm.truth.tools;
  found.outcome.rounds.emplace_back().verdict = Verdict::added;
  return found;
}

Verdict verdict_on(const KnownArm& arm, double share) {
  LoopResult found = loop_that_explains(arm, share);
  take_back_unjudged(arm.data, found);
  return found.outcome.rounds.front().verdict;
}

TEST(OnePlace, TakesEffectsBackThatExplainLittleThere) {
  for (const std::uint64_t seed : {9951u, 9952u, 9953u}) {
    EXPECT_EQ(verdict_on(sockets_of(seed, false), 0.1), Verdict::rejected);
    EXPECT_EQ(verdict_on(sockets_of(seed, false), 0.9), Verdict::added);
    EXPECT_EQ(verdict_on(sockets_of(seed, true), 0.1), Verdict::added) << "two places judge";
  }
}

TEST(OnePlace, SaysWhatPosesAtASecondOneAdd) {
  for (const std::uint64_t seed : {9955u, 9956u}) {
    const KnownArm arm = sockets_of(seed, false);
    const std::vector<std::size_t> poses = poses_of(arm.data, PoseSet::calibration);
    CalibratedModel model;
    model.declared = kLinks;
    model.robot = arm.truth;
    model.posterior = fitted_posterior(arm.data, kLinks, model.robot, poses).posterior;
    model.interval.emplace();
    model.measured = measured_ranges(arm.data, {});
    const auto second = second_place(arm.data, model, poses);
    ASSERT_TRUE(second) << seed;
    EXPECT_LT(second->both_m, 0.9 * second->one_place_m);
    const KnownArm both = sockets_of(seed, true, second->away_m);
    CalibratedModel of_both = model;
    of_both.posterior =
        fitted_posterior(both.data, kLinks, both.truth, poses_of(both.data, PoseSet::calibration)).posterior;
    const double real_m =
        workspace_error(*of_both.posterior, {}, model.robot, model.measured, false, RandomStream{1}).rms_m;
    EXPECT_LT(std::abs(std::log(second->both_m / real_m)), std::log(1.6)) << second->both_m << " " << real_m;
  }
}

TEST(OnePlace, OfAWireIsWhereTheToolIsNotWhereItEnds) {
  RandomStream stream{9957};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  arm.data.anchors_m = {{1.5, 0.3, -0.2}};
  measure(arm, stream, {.noise_m = kSocketPlay_m, .position = false}, 20);
  arm.data.anchors_m.clear();
  arm.data.anchors_unknown = true;
  take_wires_for_contacts(arm.data);
  EXPECT_FALSE(one_place_m(arm.data, arm.truth)) << "the tool was all over the workspace";
}

}  // namespace
}  // namespace demecal
