#include "fleets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fitting/fit.hpp"
#include "planning/plan.hpp"
#include "random/distributions.hpp"
#include "scene.hpp"
#include "updating/fleet_model.hpp"
#include "updating/update.hpp"
#include "workflows/workflows.hpp"

namespace demecal::bench {
namespace {

constexpr int kRobots = 5, kPosesOfRobot = 60, kValidation = 30;
/// How far lengths of links of two robots of a type are apart, standard deviations; their angles by as much over half a
/// metre.
constexpr double kSpreads_m[] = {2e-5, 5e-5, 2e-4};
constexpr int kPoses[] = {15, 30};
constexpr double kOfLoop_m = 5e-5;  ///< of these spreads the one at which the closed loop takes its time

/// What all robots of a type have in common: how they differ from the drawing, and their joints' springs.
struct Type {
  Robot robot;
  FeasibleSpace space;
  CorrectedRobot mean;
  double spread_m = 0.0;
};

/// Of the joint's torque by gravity, the root mean square over poses, Nm.
double usual_torque(const Robot& robot, const std::vector<PlannedPose>& poses, int joint) {
  double squares = 0.0;
  for (const PlannedPose& pose : poses)
    squares += std::pow(arm_state(robot, pose.joints).torque(robot.chain, joint), 2.0);
  return std::sqrt(squares / static_cast<double>(poses.size()));
}

Type type_of(const Robot& robot, double spread_m, std::uint64_t seed) {
  constexpr double kFromDrawing_m = 3e-4, kFromDrawing_rad = 3e-4, kSpring_rad = 5e-4;
  RandomStream random{790, seed};
  DataSet none;
  none.robot = robot;
  Type type{robot, FeasibleSpace(robot, assumed_cell(robot)), nominal_robot(none), spread_m};
  for (Joint& joint : type.mean.chain.joints) {
    joint.alpha_rad += kFromDrawing_rad * random.normal();
    joint.a_m += kFromDrawing_m * random.normal();
    joint.d_m += kFromDrawing_m * random.normal();
  }
  const auto poses = draw_poses(type.space, 100, RandomStream{791, seed}).poses;
  for (const int joint : {1, 2})
    type.mean.effects.push_back({.kind = "compliance",
                                 .joint = joint,
                                 .form = "masses",
                                 .values = {kSpring_rad / usual_torque(robot, poses, joint) * random.real(0.7, 1.3)}});
  for (const int joint : {0, 1, 2})
    type.mean.effects.push_back(
        {.kind = "eccentricity", .joint = joint, .settings = {{"order", 1.0}}, .values = {0.0, 0.0}});
  return type;
}

/// Zeros of joints and eccentricities are wholly a robot's own, links partly, and springs hardly.
CorrectedRobot robot_of(const Type& type, RandomStream& random) {
  constexpr double kZero_rad = 1e-3, kSpringShare = 0.1, kEccentricity_rad = 1e-4, kHalfMetre = 0.5, kTool_m = 1e-3;
  CorrectedRobot robot = type.mean;
  for (Joint& joint : robot.chain.joints) {
    joint.theta_rad += kZero_rad * random.normal();
    joint.alpha_rad += type.spread_m / kHalfMetre * random.normal();
    joint.a_m += type.spread_m * random.normal();
    joint.d_m += type.spread_m * random.normal();
  }
  for (Effect& effect : robot.effects) {
    for (double& value : effect.values)
      value += (value == 0.0 ? kEccentricity_rad : kSpringShare * value) * random.normal();
  }
  robot.tools.at("").translation() += kTool_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  robot.sensor_from_base.translation() = Eigen::Vector3d(2.0, 1.0, 0.5);
  robot.sensor_from_base.linear() = Eigen::AngleAxisd(random.real(-3, 3), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return robot;
}

/// Fitted by itself: links, and the effects that such arms have.
CorrectedRobot fitted_alone(const Type& type, const DataSet& data) {
  CorrectedRobot start = nominal_robot(data);
  start.effects = type.mean.effects;
  for (Effect& effect : start.effects) std::ranges::fill(effect.values, 0.0);
  return fit_declared(data, poses_of(data, PoseSet::calibration), kLinks, start).robot;
}

CalibratedModel model_of(const Type& type, const CorrectedRobot& truth, RandomStream& random, std::uint64_t seed) {
  const auto poses = draw_poses(type.space, kPosesOfRobot + kValidation, RandomStream{792, seed}).poses;
  DataSet data = measured(type.robot, truth, poses, random);
  for (std::size_t i = kPosesOfRobot; i < data.poses.size(); ++i) data.poses[i].set = PoseSet::validation;
  CalibratedModel model;
  model.nominal = type.robot;
  model.declared = kLinks;
  model.robot = fitted_alone(type, data);
  const FittedPosterior own = fitted_posterior(data, kLinks, model.robot, poses_of(data, PoseSet::calibration));
  model.posterior = own.posterior;
  model.interval = prediction_interval(data, own, model.robot);
  for (const Joint& joint : type.robot.chain.joints) model.measured.push_back({joint.lower, joint.upper});
  return model;
}

/// As `diagnose` finds it: it is not told which effects there are.
CorrectedRobot diagnosed_alone(const DataSet& data) {
  Job job;
  job.name = "bench";
  job.method = Method::diagnose;
  job.declared = kLinks;
  return diagnose(data, job, std::nullopt, {}).result.model.robot;
}

CorrectedRobot fitted_with(const CalibratedModel& fleet, const DataSet& data) {
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const CorrectedRobot placed = fit_registration(data, poses, {.registration = true, .tool = true}, fleet.robot).robot;
  return updated(fleet, placed, data, poses, kLinks).robot;
}

/// Of one number of poses, over the seeds.
struct Errors {
  std::vector<double> with_fleet, alone, alone_of_twice, over_twice;
  std::vector<double> diagnosed_of_twice, over_diagnosed;  ///< at one spread
};

void measure(const Robot& robot, double spread_m, std::uint64_t seed, std::vector<Errors>& all) {
  const Type type = type_of(robot, spread_m, seed);
  RandomStream random{793, seed};
  std::vector<NamedModel> models;
  for (std::uint64_t i = 0; i < kRobots; ++i)
    models.push_back({"", model_of(type, robot_of(type, random), random, 100 * seed + i)});
  const CalibratedModel fleet = fleet_model(models);
  const CorrectedRobot sixth = robot_of(type, random);
  const auto places = draw_poses(type.space, 200, RandomStream{794, seed}).poses;
  for (std::size_t i = 0; i < std::size(kPoses); ++i) {
    const auto twice = static_cast<std::size_t>(2 * kPoses[i]);
    const auto poses = draw_poses(type.space, twice, RandomStream{795 + i, seed}).poses;
    const DataSet whole = measured(type.robot, sixth, poses, random);
    DataSet half = whole;
    half.poses.resize(twice / 2);
    Errors& errors = all[i];
    errors.with_fleet.push_back(true_error_m(fitted_with(fleet, half), sixth, places));
    errors.alone.push_back(true_error_m(fitted_alone(type, half), sixth, places));
    errors.alone_of_twice.push_back(true_error_m(fitted_alone(type, whole), sixth, places));
    errors.over_twice.push_back(errors.with_fleet.back() / errors.alone_of_twice.back());
    if (spread_m != kOfLoop_m) continue;
    errors.diagnosed_of_twice.push_back(true_error_m(diagnosed_alone(whole), sixth, places));
    errors.over_diagnosed.push_back(errors.with_fleet.back() / errors.diagnosed_of_twice.back());
  }
}

void print(const Robot& robot, double spread_m, int poses, const Errors& errors, bool json) {
  const double with = 1e3 * median(errors.with_fleet), alone = 1e3 * median(errors.alone),
               twice = 1e3 * median(errors.alone_of_twice);
  const bool diagnosed = !errors.over_diagnosed.empty();
  const double found = diagnosed ? 1e3 * median(errors.diagnosed_of_twice) : 0.0;
  const double over_found = diagnosed ? median(errors.over_diagnosed) : 0.0;
  if (json) {
    nlohmann::ordered_json line{{"workload", "fleet"},
                                {"robot", robot.name},
                                {"spread_mm", 1e3 * spread_m},
                                {"poses", poses},
                                {"seeds", errors.alone.size()},
                                {"error_with_fleet_mm", with},
                                {"error_alone_mm", alone},
                                {"error_alone_of_twice_mm", twice},
                                {"error_over_alone_of_twice_median", median(errors.over_twice)}};
    if (diagnosed) {
      line["error_diagnosed_of_twice_mm"] = found;
      line["error_over_diagnosed_of_twice_median"] = over_found;
    }
    fmt::print("{}\n", line.dump());
    return;
  }
  fmt::print("{:<17} {:>6.2f} {:>5} {:>9.3f} {:>9.3f} {:>9.3f} {:>10.2f}", robot.name, 1e3 * spread_m, poses, with,
             alone, twice, median(errors.over_twice));
  if (diagnosed) fmt::print(" {:>12.3f} {:>10.2f}", found, over_found);
  fmt::print("\n");
}

}  // namespace

void bench_fleets(int seeds, bool json) {
  if (!json)
    fmt::print(
        "rms error, mm, of the sixth robot: with the fleet; alone, told which effects there are, of as many poses and "
        "of "
        "twice as many; diagnosed alone of twice as many\n{:<17} {:>6} {:>5} {:>9} {:>9} {:>9} {:>10} {:>12} {:>10}\n",
        "robot", "spread", "poses", "fleet", "alone", "twice", "ratio", "diagnosed", "ratio");
  std::vector<Robot> robots = arms();
  std::erase_if(robots, [](const Robot& robot) { return robot.masses.empty(); });
  for (const Robot& robot : robots) {
    for (const double spread_m : kSpreads_m) {
      std::vector<Errors> all(std::size(kPoses));
      for (int seed = 1; seed <= seeds; ++seed) measure(robot, spread_m, static_cast<std::uint64_t>(seed), all);
      for (std::size_t i = 0; i < all.size(); ++i) print(robot, spread_m, kPoses[i], all[i], json);
    }
  }
}

}  // namespace demecal::bench
