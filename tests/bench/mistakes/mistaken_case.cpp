#include "mistaken_case.hpp"

#include <algorithm>

#include "data_files/robot_file.hpp"
#include "kinematics/inverse.hpp"
#include "mistakes.hpp"
#include "simulation/simulated_robot.hpp"

namespace demecal::bench {
namespace {

// What random streams are for.
constexpr std::uint64_t kArmErrors = 1, kMistake = 2, kClean = 3, kDraw = 5;

/// A joint that stands still must do so before the arm is measured.
void hold_a_joint(Scenario& scenario, RandomStream& random) {
  const std::size_t joint = 1 + random.index(scenario.joint_ranges.size() - 2);
  const double at = 0.5 * (scenario.joint_ranges[joint][0] + scenario.joint_ranges[joint][1]) + 0.2;
  scenario.joint_ranges[joint] = {at, at + 1e-9};
}

bool within_limits(const Chain& chain, const JointVector& joints) {
  for (int i = 0; i < chain.size(); ++i) {
    const Joint& joint = chain.joints[static_cast<std::size_t>(i)];
    if (joints[i] < joint.lower || joints[i] > joint.upper) return false;
  }
  return true;
}

/// Measures poses whose nominal tool points lie on a line, the tool turned this way and that as in the poses there
/// were.
void measure_on_a_line(DataSet& data, const Scenario& scenario, RandomStream& random) {
  const SimulatedRobot robot(scenario);
  const Chain& chain = scenario.robot.chain;
  const PoseFunction at_point = [&chain](const JointVector& joints) {
    PoseAndJacobian there{forward(chain, joints) * Eigen::Translation3d(chain.tool_m),
                          joint_jacobian(chain, joints, chain.tool_m)};
    there.pose.linear().setIdentity();
    there.jacobian.bottomRows<3>().setZero();
    return there;
  };
  const Eigen::Vector3d middle = tool_position(chain, data.poses.front().joints);
  const Eigen::Vector3d way(0.6, -0.5, 0.62);
  std::vector<MeasuredPose> kept;
  for (MeasuredPose& pose : data.poses) {
    Eigen::Isometry3d target = Eigen::Isometry3d::Identity();
    target.translation() = middle + random.real(-0.2, 0.2) * way;
    const InverseSolution solution = inverse(at_point, target, pose.joints);
    if (solution.position_residual_m > 1e-6 || (solution.q - pose.joints).cwiseAbs().maxCoeff() > 2.0 ||
        !within_limits(chain, solution.q))
      continue;
    MeasuredPose measured = robot.measure(solution.q, *pose.approach, 0.0, random);
    measured.set = pose.set;
    measured.pose_id = pose.pose_id;
    kept.push_back(std::move(measured));
  }
  data.poses = std::move(kept);
}

/// Measures the accept poses with another tool.
void retool(MistakenCase& one, const Scenario& scenario, RandomStream& random) {
  Scenario other = scenario;
  other.tool_error_m += Eigen::Vector3d(random.real(-0.03, 0.03), random.real(0.01, 0.03), random.real(0.005, 0.04));
  const DataSet measured = dealt(other);
  for (const std::size_t i : poses_of(one.data, PoseSet::accept))
    one.data.poses[i].position_m = measured.poses[i].position_m;
}

const Make& make_of(std::size_t number) {
  static const std::vector<Make> makes{{},
                                       {.poses = {20, 10, 10}},
                                       {.poses = {12, 0, 0}},
                                       {.range_share = 0.2},
                                       {.repeats = 2},
                                       {.orientation = true},
                                       {.warm = true},
                                       {.wrongness = 3.0},
                                       {.base_frame = true},
                                       {.poses = {150, 40, 40}},
                                       {.poses = {8, 4, 4}},
                                       {.poses = {40, 10, 10}, .range_share = 0.9}};
  return makes[number % makes.size()];
}

}  // namespace

std::vector<Robot> mistaken_arms(const std::string& robots_folder) {
  std::vector<Robot> arms;
  for (const char* file : {"puma761.yaml", "elbow-offset.yaml", "ur10.yaml"})
    arms.push_back(load_robot(robots_folder + "/" + file));
  arms[2].chain.tool_m = {0.055, -0.03, 0.09};
  arms.push_back(seven_joints());
  return arms;
}

std::vector<MistakenCase> mistaken_cases(const std::vector<Robot>& arms, const MistakeDraw& draw) {
  std::vector<MistakenCase> cases;
  for (std::size_t arm = 0; arm < arms.size(); ++arm) {
    for (const Mistake& mistake : mistakes()) {
      MistakenCase one{.number = static_cast<int>(cases.size()),
                       .arm = arms[arm].name,
                       .what = mistake.what,
                       .kind = mistake.kind,
                       .data = {}};
      RandomStream errors{draw.seed, kArmErrors, static_cast<std::uint64_t>(one.number)};
      RandomStream random{draw.seed, kMistake, static_cast<std::uint64_t>(one.number)};
      Make make = mistake.arm;
      make.poses = draw.poses;
      Scenario scenario = scenario_of(arms[arm], make, errors);
      if (mistake.kind == FindingKind::constant_joint) hold_a_joint(scenario, random);
      one.data = dealt(scenario);
      if (mistake.kind == FindingKind::degenerate_points) measure_on_a_line(one.data, scenario, random);
      if (mistake.make) {
        mistake.make(one, random);
      } else if (mistake.kind == FindingKind::wrong_tool) {
        retool(one, scenario, random);
      }
      cases.push_back(std::move(one));
    }
  }
  return cases;
}

std::vector<MistakenCase> unmistaken_cases(const std::vector<Robot>& arms, int count, const MistakeDraw& draw) {
  std::vector<MistakenCase> cases;
  for (int number = 0; number < count; ++number) {
    RandomStream random{draw.seed, kClean, static_cast<std::uint64_t>(number)};
    const Robot& robot = arms[static_cast<std::size_t>(number) % arms.size()];
    const Scenario scenario = scenario_of(robot, make_of(static_cast<std::size_t>(number) / arms.size()), random);
    const bool targets = number % 5 == 4;
    cases.push_back({.number = number,
                     .arm = robot.name,
                     .what = targets ? "several targets" : "nothing",
                     .kind = {},
                     .data = targets ? with_targets(robot, scenario) : dealt(scenario)});
  }
  return cases;
}

std::vector<MistakenCase> drawn_cases(const DataSet& measured, int count, const MistakeDraw& draw) {
  std::vector<MistakenCase> cases;
  for (int number = 0; number < count; ++number) {
    RandomStream random{draw.seed, kDraw, static_cast<std::uint64_t>(number)};
    MistakenCase one{.number = number, .arm = measured.robot.name, .what = measured.name, .kind = {}, .data = measured};
    const std::size_t size = std::min<std::size_t>(measured.poses.size(), 40 + random.index(160));
    const double share = static_cast<double>(size) / static_cast<double>(measured.poses.size());
    // Poses in a row of a moving arm lie on a line or plane, and are no data set that somebody measured.
    std::erase_if(one.data.poses, [&](const MeasuredPose&) { return !random.chance(share); });
    cases.push_back(std::move(one));
  }
  return cases;
}

}  // namespace demecal::bench
