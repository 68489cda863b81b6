#include "contact_case.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "closed_loop/draw_truth.hpp"
#include "closed_loop/scene.hpp"
#include "closed_loop/score.hpp"
#include "closed_loop/truth.hpp"
#include "data_check/check_data.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "report/evaluation.hpp"
#include "simulation/simulated_robot.hpp"
#include "workflows/workflows.hpp"

namespace demecal::bench {
namespace {

// What the random streams of a case are for; 1 to 53 are those of other benchmarks and of the simulation.
constexpr std::uint64_t kLinks = 61, kPlaces = 62, kExchanged = 63, kInjected = 64;

constexpr double kPlay_m = 5e-5, kLengthSigma_m = 2e-5;
constexpr std::array<int, 3> kPoses{60, 20, 20};
constexpr double kOfLimit = 2.0;
constexpr std::array<const char*, 5> kKinds{"backlash", "compliance", "gear_harmonic", "coupling", "eccentricity"};

/// In place of the lengths of the blocks that are fitted, those between all their sockets, as `contacts.grids` has
/// them.
void know_all_lengths(const SocketArm& arm, RandomStream& random, std::vector<KnownDistance>& known) {
  const std::size_t fitted = arm.sockets.size() - 2;
  std::vector<Eigen::Vector3d> stated_m;
  std::set<std::string> names;
  for (std::size_t i = 0; i < fitted; ++i) {
    const Eigen::Vector3d error = Eigen::Vector3d::NullaryExpr([&] { return random.normal(); });
    stated_m.emplace_back(arm.sockets[i].place_m + kLengthSigma_m / std::sqrt(2.0) * error);
    names.insert(arm.sockets[i].name);
  }
  std::erase_if(known, [&](const KnownDistance& one) { return names.contains(one.first); });
  const double sigma_m = kLengthSigma_m * std::sqrt(0.5 * static_cast<double>(fitted));
  for (std::size_t second = 1; second < fitted; ++second)
    for (std::size_t first = 0; first < second; ++first)
      known.push_back(
          {arm.sockets[first].name, arm.sockets[second].name, (stated_m[second] - stated_m[first]).norm(), sigma_m});
}

Scenario scene_of(const SocketArm& arm, std::uint64_t seed, bool touches) {
  Scenario scenario = varied_scene(seed, arm.robot);
  scenario.joint_errors.clear();
  scenario.poses = kPoses;
  RandomStream random{seed, kLinks};
  for (int joint = 0; joint < arm.robot.chain.size(); ++joint) {
    for (const LinkParameter angle : {LinkParameter::theta, LinkParameter::alpha})
      scenario.geometry.push_back({joint, angle, 1e-3 * random.normal()});
    for (const LinkParameter length : {LinkParameter::a, LinkParameter::d})
      scenario.geometry.push_back({joint, length, 3e-4 * random.normal()});
  }
  for (double& error : scenario.tool_error_m) error = 1e-3 * random.normal();
  scenario.noise_m = kPlay_m;
  if (!touches) return scenario;
  scenario.sensor_from_base.setIdentity();
  scenario.play_m = kPlay_m;
  scenario.known_distances = arm.lengths;
  for (KnownDistance& known : scenario.known_distances) known.length_m += known.sigma_m * random.normal();
  if (arm.on_plate) know_all_lengths(arm, random, scenario.known_distances);
  for (std::size_t i = 0; i < arm.sockets.size(); ++i)
    scenario.touched.push_back({arm.sockets[i].name, arm.sockets[i].place_m, i + 2 >= arm.sockets.size()});
  return scenario;
}

Job job_of(std::uint64_t seed, bool touches) {
  Job job;
  job.method = Method::diagnose;
  job.seed = seed;
  job.declared = {.registration = !touches, .tool = true, .joint_offset = true, .geometry = true};
  return job;
}

/// Places of the workspace with joints inside what the model saw.
std::vector<Visit> visits_in(const std::vector<Interval>& measured, const Scenario& scenario, std::uint64_t seed) {
  constexpr int kCount = 200;
  RandomStream random{seed, kPlaces};
  std::vector<Visit> visits;
  for (int i = 0; i < kCount; ++i) {
    Visit visit{.commanded = JointVector(std::ssize(measured)), .approach = ApproachSigns(std::ssize(measured))};
    for (std::size_t joint = 0; joint < measured.size(); ++joint) {
      visit.commanded[static_cast<Eigen::Index>(joint)] = random.real(measured[joint].lower, measured[joint].upper);
      visit.approach[static_cast<Eigen::Index>(joint)] = random.chance(0.5) ? 1.0 : -1.0;
    }
    visit.payload_kg = scenario.payloads_kg.empty() ? 0.0 : scenario.payloads_kg.front();
    visits.push_back(std::move(visit));
  }
  return visits;
}

Stop stop_of(const Visit& visit, const Scenario& scenario) {
  Stop stop(visit.commanded);
  stop.approach = visit.approach;
  stop.payload_kg = visit.payload_kg;
  stop.temperature_celsius = scenario.reference_celsius;
  return stop;
}

/// How far the model's tool is from the real one, place by place, once either is shifted and turned as a whole, m.
std::vector<double> errors_m(const CorrectedRobot& robot, const Scenario& scenario, const std::vector<Visit>& visits) {
  const SimulatedRobot real(scenario);
  Eigen::Matrix3Xd truth(3, std::ssize(visits)), predicted = truth;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    truth.col(column) = real.true_pose(visits[i]).translation();
    predicted.col(column) = robot.predict(stop_of(visits[i], scenario), "").translation();
  }
  const Eigen::Isometry3d motion(Eigen::umeyama(predicted, truth, false));
  const Eigen::VectorXd lengths = (motion * predicted - truth).colwise().norm().transpose();
  return {lengths.begin(), lengths.end()};
}

double rms_mm(const std::vector<double>& all_m) {
  double squares = 0.0;
  for (const double one_m : all_m) squares += one_m * one_m / static_cast<double>(all_m.size());
  return millimetres(std::sqrt(squares));
}

/// Whether a pose that says another socket than it touched is named.
bool names_wrong_socket(DataSet data, std::uint64_t seed) {
  RandomStream random{seed, kExchanged};
  const std::vector<std::size_t> calibration = poses_of(data, PoseSet::calibration);
  MeasuredPose& pose = data.poses[calibration[random.index(calibration.size())]];
  const std::string id = pose.pose_id;
  std::string other = pose.contact;
  while (other == pose.contact) other = data.poses[calibration[random.index(calibration.size())]].contact;
  pose.contact = other;
  return std::ranges::any_of(check_data(data).findings, [&](const Finding& finding) {
    return finding.kind == FindingKind::wrong_contact && std::ranges::find(finding.poses, id) != finding.poses.end();
  });
}

/// The same arm with an undeclared cause of twice the limit that the arm without it was told.
void inject_and_diagnose(int number, const SocketArm& arm, std::uint64_t seed, const DataSet& clean_data,
                         const LoopOutcome& clean, ContactFigures& figures) {
  std::vector<NotFound> testable;
  std::ranges::copy_if(clean.not_found, std::back_inserter(testable), &NotFound::testable);
  const std::vector<ArmState> states = states_of(clean_data, PoseSet::calibration);
  RandomStream random{seed, kInjected};
  const std::string kind = kKinds[static_cast<std::size_t>(number + number / 20) % kKinds.size()];
  const std::optional<Effect> truth =
      draw_truth(kind, testable, arm.robot, states,
                 [](const NotFound& measure, const Effect& effect) {
                   const bool told = effect.form == measure.effect.form;
                   return told ? measure.smallest_detectable : std::numeric_limits<double>::infinity();
                 },
                 random, {kOfLimit, kOfLimit});
  if (!truth) return;
  figures.injected = kind;
  Scenario scenario = scene_of(arm, seed, true);
  inject(scenario, *truth);
  const DataSet data = simulate(scenario);
  const Diagnosis diagnosis = diagnose(data, job_of(seed, true), std::nullopt, {});
  const Score result = score(diagnosis.result.loop, diagnosis.model.robot.effects, {*truth}, arm.robot, states);
  figures.named = result.named;
  figures.in_class = result.in_class;
}

}  // namespace

SocketArm socket_arm(const Robot& robot, double length_m, bool on_plate) {
  PlanRequest request;
  request.robot = robot;
  request.poses = kPoses[0];
  request.places = 2;
  request.cell = assumed_cell_of_sockets(robot);
  request.cell->sockets.length_m = length_m;
  request.cell->sockets.length_sigma_m = kLengthSigma_m;
  Plan plan = make_plan(request);
  return {robot, std::move(plan.sockets), std::move(plan.lengths), on_plate};
}

ContactFigures run_contact_case(int number, const std::vector<SocketArm>& arms) {
  const SocketArm& arm = arms[static_cast<std::size_t>(number) % arms.size()];
  const std::uint64_t seed = kContactSeed + static_cast<std::uint64_t>(number);
  ContactFigures figures{.arm = arm.robot.name};
  try {
    const Scenario scenario = scene_of(arm, seed, true);
    const DataSet data = simulate(scenario);
    figures.wrong_socket_named = names_wrong_socket(data, seed);
    const Diagnosis touched = diagnose(data, job_of(seed, true), std::nullopt, {});
    const CalibratedModel& model = touched.result.model;
    figures.false_effects = static_cast<int>(touched.model.robot.effects.size());
    const Scenario seen = scene_of(arm, seed, false);
    const Diagnosis tracked = diagnose(simulate(seen), job_of(seed, false), std::nullopt, {});
    const std::vector<Visit> visits = visits_in(model.measured, scenario, seed);
    const std::vector<double> touched_m = errors_m(model.robot, scenario, visits);
    figures.touched_mm = rms_mm(touched_m);
    figures.tracked_mm = rms_mm(errors_m(tracked.result.model.robot, seen, visits));
    if (const auto predicted = workspace_entry(model, false)) figures.predicted_mm = predicted->rms_mm.value_or(0.0);
    figures.places = static_cast<int>(visits.size());
    for (std::size_t i = 0; i < visits.size(); ++i)
      figures.within +=
          touched_m[i] <= real_radius95_m(*model.interval, *model.posterior, model.robot, stop_of(visits[i], scenario))
              ? 1
              : 0;
    inject_and_diagnose(number, arm, seed, data, touched.result.loop, figures);
  } catch (const InputError&) {
    figures.failed = true;
  }
  return figures;
}

}  // namespace demecal::bench
