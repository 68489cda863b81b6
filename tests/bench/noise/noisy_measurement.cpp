#include "noisy_measurement.hpp"

#include <cmath>
#include <utility>

#include "closed_loop/scene.hpp"
#include "data/data_set.hpp"
#include "joint_courses.hpp"
#include "kinematics/units.hpp"
#include "measurement_noise.hpp"
#include "simulation/simulated_robot.hpp"

namespace demecal::bench {
namespace {

// What the random streams of a case are for; 1 to 21 are those of the simulation and of the closed loop's benchmark.
constexpr std::uint64_t kWrongArm = 31, kJointCourse = 32, kCircumstances = 33, kNoiseDraw = 34, kDealt = 35,
                        kFreshCourse = 36, kFreshCircumstances = 37, kFreshStops = 38;

constexpr double kWhite_m = 5e-5;
constexpr double kWhiteBesideJoints_m = 2e-5, kWhiteBesideOthers_m = 1e-5;
constexpr double kCorrelation = 0.9;
constexpr double kDrift_m = 2e-4;
constexpr double kWarmUp_kelvin = 8.0, kCold_celsius = 20.0;
constexpr std::size_t kFreshPoses = 200, kPosesMeasured = 200, kPosesRepeated = 51, kRepeats = 4;
constexpr double kSmallestMove = 2e-3;  ///< rad or m: below it a gear stays where it was

bool drifts(const NoiseCase& one) {
  return one.condition.noise == Noise::warming || one.condition.noise == Noise::drift;
}

/// A quarter of the session.
double seconds_to_e(const Scenario& scenario) {
  return scenario.seconds_per_pose * static_cast<double>(kPosesMeasured) / 4.0;
}

double recorded_celsius(const NoiseCase& one, const Scenario& scenario, double time_s) {
  if (one.condition.noise == Noise::warming)
    return kCold_celsius - kWarmUp_kelvin * std::expm1(-time_s / seconds_to_e(scenario));
  return temperature_celsius(*scenario.temperature, time_s);
}

ApproachSigns came_from(const JointVector& before, const JointVector& here) {
  ApproachSigns signs(here.size());
  for (Eigen::Index i = 0; i < here.size(); ++i) {
    const double move = here[i] - before[i];
    signs[i] = std::abs(move) < kSmallestMove ? 0.0 : std::copysign(1.0, move);
  }
  return signs;
}

/// One visit a row; those of one place follow each other, each coming from another place.
std::vector<Visit> visits_of(const std::vector<JointVector>& places, std::size_t repeats, const Scenario& scenario,
                             RandomStream& random) {
  std::vector<Visit> visits;
  for (std::size_t place = 0; place < places.size(); ++place) {
    const double payload_kg = scenario.payloads_kg[random.index(scenario.payloads_kg.size())];
    for (std::size_t repeat = 0; repeat < repeats; ++repeat) {
      std::size_t before = place > 0 ? place - 1 : place;
      if (repeat > 0) before = (place + 1 + random.index(places.size() - 1)) % places.size();
      visits.push_back({.commanded = places[place],
                        .approach = came_from(places[before], places[place]),
                        .payload_kg = payload_kg,
                        .time_s = scenario.seconds_per_pose * static_cast<double>(visits.size())});
    }
  }
  return visits;
}

/// What is true of a visit, as a row of a data set.
MeasuredPose row_of_visit(const NoiseCase& one, const Scenario& scenario, const Visit& visit,
                          const Eigen::Vector3d& point_m) {
  MeasuredPose pose;
  pose.joints = visit.commanded;
  pose.position_m = point_m;
  pose.approach = visit.approach;
  pose.payload_kg = visit.payload_kg;
  if (one.condition.temperature) pose.temperature_celsius = recorded_celsius(one, scenario, visit.time_s);
  if (one.condition.time) pose.time_s = visit.time_s;
  return pose;
}

JointVector drawn_repeatability_rad(Eigen::Index joints, RandomStream& random) {
  JointVector deviation(joints);
  for (double& joint : deviation) joint = radians(random.real(0.005, 0.01));
  return deviation;
}

JointVector beside(JointVector joints, const JointVector& deviation, RandomStream& random) {
  for (Eigen::Index i = 0; i < deviation.size(); ++i) joints[i] += deviation[i] * random.normal();
  return joints;
}

/// Where the joints of each visit stand: as commanded, or by their repeatability beside it, drawn anew every time.
std::vector<Visit> as_reached(const NoiseCase& one, std::vector<Visit> visits, RandomStream& random) {
  if (one.condition.noise != Noise::joints) return visits;
  const JointVector deviation = drawn_repeatability_rad(visits.front().commanded.size(), random);
  for (Visit& visit : visits) visit.commanded = beside(std::move(visit.commanded), deviation, random);
  return visits;
}

Offsets shared_by_repeats(std::size_t rows, RandomStream& random) {
  const Offsets own = white_noise(rows / kRepeats, kWhite_m, random);
  Offsets all;
  for (std::size_t i = 0; i < rows; ++i) all.push_back(own[i / kRepeats]);
  return all;
}

/// All errors of the measured points, of rows in the order of measuring.
Offsets errors_of_points(const NoiseCase& one, const Scenario& scenario, const Offsets& seen_m, RandomStream& random) {
  const std::size_t rows = seen_m.size();
  Offsets all;
  switch (one.condition.noise) {
    case Noise::joints:
      return white_noise(rows, kWhiteBesideJoints_m, random);
    case Noise::student:
      return student_noise(rows, kWhite_m, random);
    case Noise::tracker:
      return tracker_noise(seen_m, 1.5e-5, 3e-5, random);
    case Noise::repeats:
      all = shared_by_repeats(rows, random);
      break;
    case Noise::correlated:
      all = correlated_noise(rows, kCorrelation, kWhite_m, random);
      break;
    case Noise::warming:
      all =
          settling_drift(rows, kDrift_m * random_direction(random), seconds_to_e(scenario) / scenario.seconds_per_pose);
      break;
    case Noise::drift:
      all = steady_drift(rows, kDrift_m * random_direction(random));
      break;
    case Noise::outliers:
      all = gross_errors(rows, 0.02, 1e-3, 0.1, random);
      break;
    case Noise::white:
    case Noise::rounding:
      return white_noise(rows, kWhite_m, random);
  }
  const bool own_scatter = one.condition.noise == Noise::repeats || one.condition.noise == Noise::correlated;
  add_to(all, white_noise(rows, own_scatter ? kWhiteBesideOthers_m : kWhite_m, random));
  return all;
}

double rounded(double value, double step) {
  return step * std::round(value / step);
}

void round_all(DataSet& data) {
  for (MeasuredPose& pose : data.poses) {
    for (double& joint : pose.joints) joint = radians(rounded(degrees(joint), 0.01));
    for (double& element : *pose.position_m) element = metres(rounded(millimetres(element), 0.1));
  }
}

DataSet without_poses(const Scenario& scenario) {
  DataSet data;
  data.name = scenario.name;
  data.robot = scenario.robot;
  return data;
}

}  // namespace

Scenario noisy_scene(const NoiseCase& one, const std::vector<Robot>& arms) {
  const Robot& robot = arms[one.arm(arms.size())];
  Scenario scenario = varied_scene(one.seed, robot);
  scenario.name = one.condition.name + ' ' + std::to_string(one.number);
  scenario.noise_m = 0.0;
  RandomStream random{one.seed, kWrongArm};
  for (double& error : scenario.tool_error_m) error = 1e-3 * random.normal();
  if (!one.declared(arms.size()).geometry) return scenario;
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    for (const LinkParameter angle : {LinkParameter::theta, LinkParameter::alpha})
      scenario.geometry.push_back({joint, angle, 1e-3 * random.normal()});
    for (const LinkParameter length : {LinkParameter::a, LinkParameter::d})
      scenario.geometry.push_back({joint, length, 3e-4 * random.normal()});
  }
  return scenario;
}

DataSet measured_noisily(const NoiseCase& one, const Scenario& scenario) {
  const bool repeated = one.condition.noise == Noise::repeats;
  const std::size_t places = repeated ? kPosesRepeated : kPosesMeasured, repeats = repeated ? kRepeats : 1;
  RandomStream course{one.seed, kJointCourse}, circumstances{one.seed, kCircumstances}, noise{one.seed, kNoiseDraw};
  const std::vector<Visit> visits = visits_of(joint_course(one.condition.course, scenario.joint_ranges, places, course),
                                              repeats, scenario, circumstances);
  const SimulatedRobot robot(scenario);
  Offsets points_m;
  for (const Visit& visit : as_reached(one, visits, noise)) points_m.push_back(robot.true_pose(visit).translation());
  add_to(points_m, errors_of_points(one, scenario, Offsets(points_m), noise));
  DataSet data = without_poses(scenario);
  for (std::size_t i = 0; i < visits.size(); ++i) {
    data.poses.push_back(row_of_visit(one, scenario, visits[i], points_m[i]));
    data.poses.back().pose_id = std::to_string(i / repeats + 1).insert(0, 1, 'P');
  }
  if (one.condition.noise == Noise::rounding) round_all(data);
  RandomStream dealt{one.seed, kDealt};
  const double fraction = repeated ? 13.0 / 51.0 : 0.25;
  split_by_pose(data.poses, {.validation = fraction, .accept = fraction},
                [&dealt](std::size_t n) { return dealt.index(n); });
  return data;
}

JointVector repeatability_rad(const NoiseCase& one, Eigen::Index joints) {
  if (one.condition.noise != Noise::joints) return {};
  RandomStream noise{one.seed, kNoiseDraw};
  return drawn_repeatability_rad(joints, noise);
}

DataSet fresh_poses(const NoiseCase& one, const Scenario& scenario, const JointVector& stops_beside_rad) {
  RandomStream course{one.seed, kFreshCourse}, circumstances{one.seed, kFreshCircumstances},
      stops{one.seed, kFreshStops};
  const SimulatedRobot robot(scenario);
  DataSet data = without_poses(scenario);
  for (Visit& visit : visits_of(joint_course(one.condition.course, scenario.joint_ranges, kFreshPoses, course), 1,
                                scenario, circumstances)) {
    visit.time_s = circumstances.real(0.0, scenario.seconds_per_pose * static_cast<double>(kPosesMeasured));
    Visit reached = visit;
    reached.commanded = beside(visit.commanded, stops_beside_rad, stops);
    data.poses.push_back(row_of_visit(one, scenario, visit, robot.true_pose(reached).translation()));
  }
  return data;
}

double clean_error_mm(const NoiseCase& one, const CorrectedRobot& robot, const DataSet& fresh) {
  Eigen::Matrix3Xd truth(3, std::ssize(fresh.poses)), predicted = truth;
  for (Eigen::Index i = 0; i < truth.cols(); ++i) {
    const MeasuredPose& pose = fresh.poses[static_cast<std::size_t>(i)];
    truth.col(i) = *pose.position_m;
    predicted.col(i) = robot.predict(Stop(pose), pose.target).translation();
  }
  if (drifts(one)) {
    const Eigen::Matrix4d motion = Eigen::umeyama(predicted, truth, false);
    predicted = (motion.topLeftCorner<3, 3>() * predicted).colwise() + motion.topRightCorner<3, 1>();
  }
  return millimetres(std::sqrt((truth - predicted).colwise().squaredNorm().mean()));
}

}  // namespace demecal::bench
