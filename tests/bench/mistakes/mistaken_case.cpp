#include "mistaken_case.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "config/load_robot.hpp"
#include "data/split.hpp"
#include "kinematics/inverse.hpp"
#include "kinematics/units.hpp"
#include "random/random_stream.hpp"
#include "simulation/simulated_robot.hpp"

namespace demecal::bench {
namespace {

// What random streams are for.
constexpr std::uint64_t kArmErrors = 1, kMistake = 2, kClean = 3, kDeal = 4, kDraw = 5;

/// An arm of seven joints with a shoulder, elbow and wrist whose axes meet, as lightweight arms have them.
Robot seven_joints() {
  Robot robot;
  robot.name = "Seven joints";
  robot.chain.convention = Convention::standard_dh;
  const double alpha_deg[] = {-90, 90, 90, -90, -90, 90, 0}, d_mm[] = {360, 0, 420, 0, 400, 0, 152};
  const double limit_deg[] = {170, 120, 170, 120, 170, 120, 175};
  for (int i = 0; i < 7; ++i) {
    robot.chain.joints.push_back({.d_m = metres(d_mm[i]),
                                  .alpha_rad = radians(alpha_deg[i]),
                                  .lower = -radians(limit_deg[i]),
                                  .upper = radians(limit_deg[i])});
    robot.masses.push_back({.mass_kg = 5.0 - 0.6 * i, .centre_m = {0.0, 0.0, 0.03}});
  }
  robot.chain.tool_m = {0.045, 0.03, 0.12};
  return robot;
}

/// How wrong an arm is, in multiples of what is usual, and how it is measured.
struct Make {
  std::array<int, 3> poses{50, 25, 25};
  double wrongness = 1.0;
  double range_share = 0.6;  ///< of each joint's range
  int repeats = 1;
  bool orientation = false, warm = false, base_frame = false;
};

Scenario scenario_of(const Robot& robot, const Make& make, RandomStream& random) {
  Scenario scenario;
  scenario.name = robot.name;
  scenario.robot = robot;
  scenario.seed = random.index(1'000'000);
  scenario.by_joints = true;
  for (const Joint& joint : robot.chain.joints) {
    const double half = 0.5 * std::min(joint.upper - joint.lower, radians(300.0)) * make.range_share;
    const double middle = 0.5 * (joint.lower + joint.upper);
    scenario.joint_ranges.push_back({middle - half, middle + half});
  }
  scenario.poses = make.poses;
  scenario.repeats = make.repeats;
  scenario.noise_m = random.real(2e-5, 1e-4);
  scenario.orientation_measured = make.orientation;
  scenario.orientation_noise_rad = 1e-4;
  if (!make.base_frame) {
    for (double& shift : scenario.sensor_from_base.translation()) shift = random.real(-2.5, 2.5);
    scenario.sensor_from_base.linear() = (Eigen::AngleAxisd(random.real(-3.0, 3.0), Eigen::Vector3d::UnitZ()) *
                                          Eigen::AngleAxisd(random.real(-0.05, 0.05), Eigen::Vector3d::UnitX()))
                                             .toRotationMatrix();
  }
  for (double& error : scenario.tool_error_m) error = make.wrongness * 1e-3 * random.normal();
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    for (const LinkParameter parameter : {LinkParameter::theta, LinkParameter::alpha})
      scenario.geometry.push_back({joint, parameter, make.wrongness * 1.5e-3 * random.normal()});
    for (const LinkParameter parameter : {LinkParameter::a, LinkParameter::d})
      scenario.geometry.push_back({joint, parameter, make.wrongness * 5e-4 * random.normal()});
    scenario.gear_harmonics.push_back(
        {joint, static_cast<double>(2 + random.index(60)), 1e-4 * random.normal(), 1e-4 * random.normal()});
    scenario.backlash.push_back({joint, 2e-4 * random.real()});
  }
  scenario.compliance.push_back({1, 1e-6 * random.real()});
  if (make.warm) {
    scenario.seconds_per_pose = 30.0;
    scenario.temperature = TemperatureCourse{.lower_celsius = 20.0, .upper_celsius = 29.0, .period_s = 9000.0};
    scenario.thermal_lengths.push_back({1, 1.2e-5});
    scenario.drift.metres_per_s = Eigen::Vector3d(1, -1, 1) * 3e-8;
  }
  return scenario;
}

/// Poses dealt to the sets at random.
DataSet dealt(const Scenario& scenario) {
  DataSet data = simulate(scenario);
  const double total = static_cast<double>(data.poses.size());
  RandomStream random{scenario.seed, kDeal};
  split_by_pose(data.poses,
                {.validation = scenario.poses[1] * scenario.repeats / total,
                 .accept = scenario.poses[2] * scenario.repeats / total},
                [&random](std::size_t n) { return random.index(n); });
  return data;
}

/// The same poses measured at several points of the tool, one row each.
DataSet with_targets(const Robot& robot, const Scenario& scenario) {
  DataSet data;
  const Eigen::Vector3d points_m[] = {{0.06, 0.0, 0.1}, {-0.05, 0.05, 0.12}, {0.0, -0.07, 0.08}};
  for (int i = 0; i < 3; ++i) {
    Scenario one = scenario;
    one.robot.chain.tool_m = points_m[i];
    DataSet measured = dealt(one);
    const std::string name(1, static_cast<char>('A' + i));
    if (i == 0) {
      data = measured;
      data.poses.clear();
      data.robot = robot;
    }
    data.tools_m[name] = points_m[i];
    for (std::size_t p = 0; p < measured.poses.size(); ++p) {
      measured.poses[p].target = name;
      const auto at = data.poses.begin() +
                      static_cast<std::ptrdiff_t>(p * static_cast<std::size_t>(i + 1) + static_cast<std::size_t>(i));
      data.poses.insert(at, measured.poses[p]);
    }
  }
  return data;
}

struct Mistake {
  FindingKind kind;
  std::string what;
  std::function<void(MistakenCase&, RandomStream&)> make;
  Make arm{};
};

void each_pose(DataSet& data, const std::function<void(MeasuredPose&)>& change) {
  for (MeasuredPose& pose : data.poses) change(pose);
}

void each_joint(DataSet& data, int joint, const std::function<double(double)>& change) {
  each_pose(data, [&](MeasuredPose& pose) { pose.joints[joint] = change(pose.joints[joint]); });
}

/// Measured points moved along the rows.
void shift_points(DataSet& data, std::size_t from, int by) {
  std::vector<Eigen::Vector3d> points;
  for (const MeasuredPose& pose : data.poses) points.push_back(*pose.position_m);
  const auto n = static_cast<int>(points.size());
  for (auto i = static_cast<int>(from); i < n; ++i)
    data.poses[static_cast<std::size_t>(i)].position_m = points[static_cast<std::size_t>((i + by + n) % n)];
}

Eigen::Isometry3d moved(RandomStream& random, double shift_m, double turn_rad) {
  Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
  const Eigen::Vector3d way(random.normal(), random.normal(), random.normal());
  move.linear() = Eigen::AngleAxisd(turn_rad, axis.normalized()).toRotationMatrix();
  move.translation() = shift_m * way.normalized();
  return move;
}

/// A joint whose angle the tool point shows in more than the base or the tool would take.
int inner_joint(const DataSet& data, RandomStream& random) {
  return 1 + static_cast<int>(random.index(static_cast<std::size_t>(data.robot.chain.size() - 2)));
}

std::size_t any_pose(const DataSet& data, RandomStream& random) {
  return random.index(data.poses.size());
}

void exchange_rows(MistakenCase& one, RandomStream& random, int pairs) {
  for (int i = 0; i < pairs; ++i) {
    MeasuredPose& first = one.data.poses[any_pose(one.data, random)];
    MeasuredPose& second = one.data.poses[any_pose(one.data, random)];
    if ((*first.position_m - *second.position_m).norm() < 0.05 || std::ranges::count(one.poses, first.pose_id) > 0 ||
        std::ranges::count(one.poses, second.pose_id) > 0) {
      --i;
      continue;
    }
    std::swap(first.position_m, second.position_m);
    one.poses.push_back(first.pose_id);
    one.poses.push_back(second.pose_id);
  }
}

/// The other robot: same joints, another size and other offsets.
void take_other_robot(DataSet& data, RandomStream& random) {
  for (Joint& joint : data.robot.chain.joints) {
    joint.a_m *= random.real(1.15, 1.4);
    joint.d_m *= random.real(0.6, 0.85);
    if (joint.a_m != 0.0) joint.a_m += random.real(0.03, 0.08);
  }
}

std::vector<Mistake> mistakes() {
  using Kind = FindingKind;
  std::vector<Mistake> all;
  const auto add = [&all](Kind kind, std::string what, std::function<void(MistakenCase&, RandomStream&)> make,
                          Make arm = {}) {
    all.push_back({kind, std::move(what), std::move(make), arm});
  };
  add(Kind::joint_sign, "sign of an inner joint", [](MistakenCase& one, RandomStream& random) {
    each_joint(one.data, inner_joint(one.data, random), [](double q) { return -q; });
  });
  add(Kind::joint_sign, "sign of joint 1",
      [](MistakenCase& one, RandomStream&) { each_joint(one.data, 0, [](double q) { return -q; }); });
  add(Kind::joint_sign, "sign of the last joint", [](MistakenCase& one, RandomStream&) {
    each_joint(one.data, one.data.robot.chain.size() - 1, [](double q) { return -q; });
  });
  add(Kind::joint_offset, "an inner joint off by 90 deg", [](MistakenCase& one, RandomStream& random) {
    const double by = random.chance(0.5) ? radians(90.0) : -radians(90.0);
    each_joint(one.data, inner_joint(one.data, random), [by](double q) { return q + by; });
  });
  add(Kind::joint_offset, "joint 2 off by 180 deg",
      [](MistakenCase& one, RandomStream&) { each_joint(one.data, 1, [](double q) { return q + radians(180.0); }); });
  add(Kind::joints_exchanged, "two joint columns exchanged", [](MistakenCase& one, RandomStream& random) {
    const int first = inner_joint(one.data, random);
    each_pose(one.data, [first](MeasuredPose& pose) { std::swap(pose.joints[first], pose.joints[first + 1]); });
  });
  add(Kind::axes_exchanged, "x and y exchanged, base frame",
      [](MistakenCase& one, RandomStream&) {
        each_pose(one.data, [](MeasuredPose& pose) { std::swap(pose.position_m->x(), pose.position_m->y()); });
      },
      {.base_frame = true});
  add(Kind::axes_exchanged, "y and z exchanged, instrument's frame", [](MistakenCase& one, RandomStream&) {
    each_pose(one.data, [](MeasuredPose& pose) { std::swap(pose.position_m->y(), pose.position_m->z()); });
  });
  add(Kind::mirrored, "x negated", [](MistakenCase& one, RandomStream&) {
    each_pose(one.data, [](MeasuredPose& pose) { pose.position_m->x() *= -1.0; });
  });
  add(Kind::mirrored, "z negated, base frame",
      [](MistakenCase& one, RandomStream&) {
        each_pose(one.data, [](MeasuredPose& pose) { pose.position_m->z() *= -1.0; });
      },
      {.base_frame = true});
  add(Kind::unit, "inches under mm", [](MistakenCase& one, RandomStream&) {
    each_pose(one.data, [](MeasuredPose& pose) { *pose.position_m /= 25.4; });
  });
  add(Kind::unit, "metres under mm", [](MistakenCase& one, RandomStream&) {
    each_pose(one.data, [](MeasuredPose& pose) { *pose.position_m /= 1000.0; });
  });
  add(Kind::unit, "radians under deg", [](MistakenCase& one, RandomStream&) {
    each_pose(one.data, [](MeasuredPose& pose) { pose.joints *= radians(1.0); });
  });
  add(Kind::convention, "the other convention", [](MistakenCase& one, RandomStream&) {
    Convention& convention = one.data.robot.chain.convention;
    convention = convention == Convention::standard_dh ? Convention::modified_dh : Convention::standard_dh;
  });
  add(Kind::rows_shifted, "points shifted by a few rows", [](MistakenCase& one, RandomStream& random) {
    shift_points(one.data, 0, 1 + static_cast<int>(random.index(5)));
  });
  add(Kind::rows_shifted, "points shifted by one from a row on", [](MistakenCase& one, RandomStream& random) {
    shift_points(one.data, one.data.poses.size() / 4 + random.index(one.data.poses.size() / 2), 1);
  });
  add(Kind::rows_shuffled, "points in another order", [](MistakenCase& one, RandomStream& random) {
    for (std::size_t i = one.data.poses.size(); i > 1; --i)
      std::swap(one.data.poses[i - 1].position_m, one.data.poses[random.index(i)].position_m);
  });
  add(Kind::rows_exchanged, "two pairs of rows exchanged",
      [](MistakenCase& one, RandomStream& random) { exchange_rows(one, random, 2); });
  add(Kind::instrument_moved, "the instrument moved by some mm midway", [](MistakenCase& one, RandomStream& random) {
    const Eigen::Isometry3d move = moved(random, random.real(0.004, 0.02), random.real(0.0, 0.01));
    const std::size_t from = one.data.poses.size() / 4 + random.index(one.data.poses.size() / 2);
    for (std::size_t i = from; i < one.data.poses.size(); ++i)
      one.data.poses[i].position_m = move * *one.data.poses[i].position_m;
  });
  add(Kind::instrument_moved, "the instrument set up anew for the last poses",
      [](MistakenCase& one, RandomStream& random) {
        const Eigen::Isometry3d move = moved(random, random.real(0.5, 2.0), random.real(0.5, 2.0));
        for (std::size_t i = one.data.poses.size() * 3 / 4; i < one.data.poses.size(); ++i)
          one.data.poses[i].position_m = move * *one.data.poses[i].position_m;
      });
  add(Kind::set_in_other_frame, "validation in another frame", [](MistakenCase& one, RandomStream& random) {
    const Eigen::Isometry3d move = moved(random, random.real(0.005, 0.8), random.real(0.005, 0.5));
    for (const std::size_t i : poses_of(one.data, PoseSet::validation))
      one.data.poses[i].position_m = move * *one.data.poses[i].position_m;
  });
  add(Kind::wrong_tool, "accept with another tool", {});
  add(Kind::wrong_tool, "a tool that is not the robot file's", [](MistakenCase& one, RandomStream& random) {
    one.data.robot.chain.tool_m +=
        Eigen::Vector3d(random.real(0.02, 0.05), random.real(-0.05, -0.02), random.real(0.02, 0.08));
  });
  add(Kind::constant_joint, "a joint that stands still", {});
  add(Kind::degenerate_points, "points on a line", {});
  add(Kind::copied_rows, "rows copied with their ids", [](MistakenCase& one, RandomStream& random) {
    for (int i = 0; i < 2; ++i) {
      const std::size_t at = any_pose(one.data, random);
      one.data.poses.insert(one.data.poses.begin() + static_cast<std::ptrdiff_t>(at) + 1, one.data.poses[at]);
      one.poses.push_back(one.data.poses[at].pose_id);
    }
  });
  add(Kind::copied_rows, "a measured point copied into another row", [](MistakenCase& one, RandomStream& random) {
    const std::size_t at = random.index(one.data.poses.size() - 1);
    one.data.poses[at + 1].position_m = one.data.poses[at].position_m;
    one.poses.push_back(one.data.poses[at + 1].pose_id);
  });
  add(Kind::typing_error, "two digits of a joint", [](MistakenCase& one, RandomStream& random) {
    MeasuredPose& pose = one.data.poses[any_pose(one.data, random)];
    pose.joints[inner_joint(one.data, random)] += radians(random.chance(0.5) ? 9.0 : -27.0);
    one.poses.push_back(pose.pose_id);
  });
  add(Kind::typing_error, "joints of two rows", [](MistakenCase& one, RandomStream& random) {
    for (const double by_deg : {1.0, 40.0}) {
      MeasuredPose& pose = one.data.poses[any_pose(one.data, random)];
      if (std::ranges::count(one.poses, pose.pose_id) > 0) continue;
      pose.joints[inner_joint(one.data, random)] -= radians(by_deg);
      one.poses.push_back(pose.pose_id);
    }
  });
  add(Kind::outlier, "five outliers", [](MistakenCase& one, RandomStream& random) {
    for (int i = 0; i < 5; ++i) {
      MeasuredPose& pose = one.data.poses[any_pose(one.data, random)];
      *pose.position_m += moved(random, random.real(0.006, 0.025), 0.0).translation();
      if (std::ranges::count(one.poses, pose.pose_id) == 0) one.poses.push_back(pose.pose_id);
    }
  });
  add(Kind::other_robot, "another robot",
      [](MistakenCase& one, RandomStream& random) { take_other_robot(one.data, random); });
  return all;
}

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
