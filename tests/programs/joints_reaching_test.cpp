// The search for all configurations of a pose leaves out what cannot find any: its answers are those of the whole
// search, to the bit.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "kinematics/angles.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/inverse.hpp"
#include "programs/configuration.hpp"
#include "programs/nominal_joints.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

/// alpha, a and d of each link.
struct LinkShape {
  double alpha_rad, a_m, d_m;
};

Chain six_of(const std::vector<LinkShape>& links) {
  Chain chain;
  for (const LinkShape& link : links) {
    Joint joint;
    joint.alpha_rad = link.alpha_rad;
    joint.a_m = link.a_m;
    joint.d_m = link.d_m;
    joint.lower = -2.96;
    joint.upper = 2.96;
    chain.joints.push_back(joint);
  }
  chain.tool_m = {0.03, -0.05, 0.12};
  return chain;
}

Chain meeting_wrist() {
  return six_of(
      {{-kQuarter, 0.15, 0.4}, {0, 0.6, 0}, {-kQuarter, 0.1, 0}, {kQuarter, 0, 0.6}, {-kQuarter, 0, 0}, {0, 0, 0.1}});
}

Chain three_parallel() {
  return six_of(
      {{kQuarter, 0, 0.16}, {0, -0.6, 0}, {0, -0.55, 0}, {kQuarter, 0, 0.17}, {-kQuarter, 0, 0.12}, {0, 0, 0.1}});
}

Chain without_sides() {
  return six_of(
      {{-1.5, 0.2, 0.4}, {0.3, 0.5, 0.1}, {-1.4, 0.1, 0.05}, {1.6, 0.1, 0.5}, {-1.3, 0.05, 0.1}, {0.2, 0.02, 0.1}});
}

Chain six_on_rail() {
  Chain chain = meeting_wrist();
  Joint rail = chain.joints.front();
  rail.type = JointType::prismatic;
  rail.lower = 0.0;
  rail.upper = 3.0;
  chain.joints.insert(chain.joints.begin(), rail);
  return chain;
}

Chain coupled() {
  Chain chain = meeting_wrist();
  chain.couplings.push_back({2, 1, -1.0});
  return chain;
}

bool same_but_for_turns(const Chain& arm, const JointVector& one, const JointVector& other) {
  for (Eigen::Index i = 0; i < one.size(); ++i) {
    const double apart = one[i] - other[i];
    if (std::abs(is_revolute(arm, static_cast<int>(i)) ? wrap_near(apart, 0.0) : apart) > 1e-3) return false;
  }
  return true;
}

/// All starts to their ends.
std::vector<JointVector> whole_search(const Chain& arm, const Eigen::Isometry3d& tool, const JointVector& reference,
                                      int held) {
  const PoseFunction model = [&](const JointVector& q) {
    return PoseAndJacobian{forward(arm, q) * Eigen::Translation3d(arm.tool_m), joint_jacobian(arm, q, arm.tool_m)};
  };
  std::vector<JointVector> found;
  const auto try_from = [&](const JointVector& start) {
    const InverseSolution solution = inverse(model, tool, start, {.held = held});
    const auto same = [&](const JointVector& known) { return same_but_for_turns(arm, known, solution.q); };
    if (solution.status == InverseStatus::converged && std::ranges::none_of(found, same)) found.push_back(solution.q);
  };
  try_from(reference);
  for (int index = 1; index <= kSearchStarts && found.size() < 16; ++index)
    try_from(search_start(arm, index, reference, held));
  const Eigen::Index last = reference.size() - 1;
  for (std::size_t i = 0; i < found.size() && found.size() < 16; ++i) {
    JointVector wrist = found[i], elbow = wrist, shoulder = wrist;
    wrist[last - 2] += std::numbers::pi;
    wrist[last - 1] *= -1.0;
    wrist[last] += std::numbers::pi;
    elbow[held + 2] = std::numbers::pi - elbow[held + 2];
    shoulder[held] += std::numbers::pi;
    for (const JointVector& start : {wrist, elbow, shoulder}) try_from(start);
  }
  std::vector<JointVector> inside;
  for (JointVector& joints : found) {
    bool outside = false;
    for (Eigen::Index i = 0; i < joints.size(); ++i) {
      const Joint& joint = arm.joints[static_cast<std::size_t>(i)];
      joints[i] = nearest_turn(joint, joints[i], reference[i]);
      outside = outside || beyond_limits(joint, joints[i]) > 0.0;
    }
    if (!outside) inside.push_back(joints);
  }
  return inside.empty() ? found : inside;
}

void expect_whole(const Chain& arm, int held, std::uint64_t seed, double wrist_rad) {
  constexpr int kPoses = 6;
  RandomStream stream{seed};
  for (int pose = 0; pose < kPoses; ++pose) {
    JointVector wanted(arm.size()), reference(arm.size());
    for (Eigen::Index i = 0; i < wanted.size(); ++i) {
      wanted[i] = stream.real(0.5, 2.0) * (stream.chance(0.5) ? 1.0 : -1.0);
      reference[i] = i < held ? wanted[i] : wanted[i] + stream.real(-0.3, 0.3);
    }
    if (wrist_rad >= 0.0) wanted[wanted.size() - 2] = wrist_rad;
    const Eigen::Isometry3d tool = forward(arm, wanted) * Eigen::Translation3d(arm.tool_m);
    const std::vector<JointVector> all = joints_reaching(arm, tool, reference, held);
    const std::vector<JointVector> whole = whole_search(arm, tool, reference, held);
    ASSERT_EQ(all.size(), whole.size()) << "pose " << pose;
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], whole[i]) << "pose " << pose;
  }
}

TEST(JointsReaching, AreThoseOfTheWholeSearch) {
  expect_whole(meeting_wrist(), 0, 8801, -1.0);
  expect_whole(three_parallel(), 0, 8802, -1.0);
  expect_whole(without_sides(), 0, 8803, -1.0);
  expect_whole(six_on_rail(), 1, 8804, -1.0);
  expect_whole(six_on_rail(), 0, 8805, -1.0);
  expect_whole(coupled(), 0, 8806, -1.0);
}

TEST(JointsReaching, AreThoseOfTheWholeSearchNearSingularPostures) {
  for (const double wrist_rad : {0.0, 1e-3, 0.05}) {
    expect_whole(meeting_wrist(), 0, 8807, wrist_rad);
    expect_whole(three_parallel(), 0, 8808, wrist_rad);
  }
}

TEST(JointsReaching, AreAtMostEightWhereWristsMeetOrThreeAxesAreParallel) {
  const JointVector joints = JointVector::Constant(6, 0.7);
  EXPECT_EQ(most_configurations(meeting_wrist(), joints), 8U);
  EXPECT_EQ(most_configurations(three_parallel(), joints), 8U);
  EXPECT_EQ(most_configurations(without_sides(), joints), 16U);
  Chain moved = meeting_wrist();
  moved.joints[4].a_m = 0.02;
  EXPECT_EQ(most_configurations(moved, joints), 16U);
  Chain turned = three_parallel();
  turned.joints[2].alpha_rad = 0.01;
  EXPECT_EQ(most_configurations(turned, joints), 16U);
}

}  // namespace
}  // namespace demecal
