// What planned poses are worth beside random ones, whether predictions come true, and whether changes are named.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "fleets.hpp"
#include "planning/candidates.hpp"
#include "planning/plan.hpp"
#include "prediction/measurement.hpp"
#include "priors.hpp"
#include "random/distributions.hpp"
#include "scene.hpp"
#include "updating/change.hpp"
#include "workflows/workflows.hpp"

namespace {

using namespace demecal;
using namespace demecal::bench;
using Json = nlohmann::ordered_json;

struct Options {
  int seeds = 5, cases = 60;
  std::vector<int> poses{15, 30};
  int fleet_seeds = 3;
  std::string only;
  PriorOptions prior;
  bool json = false;
};

std::vector<PlannedPose> calibration_poses(const Plan& plan) {
  std::vector<PlannedPose> poses;
  for (const PlannedStop& stop : plan.stops)
    if (stop.set == PoseSet::calibration) poses.push_back(stop.pose);
  return poses;
}

PlanRequest request_for(const Robot& robot, int poses, int seed) {
  PlanRequest request;
  request.robot = robot;
  request.cell = assumed_cell(robot);
  request.cell->noise_m = kNoise_m;
  request.poses = poses;
  request.seed = static_cast<std::uint64_t>(seed);
  return request;
}

void bench_plans(const Robot& robot, int poses, const Options& options) {
  std::vector<double> ratio, prediction, seconds;
  for (int seed = 1; seed <= options.seeds; ++seed) {
    RandomStream random{777, static_cast<std::uint64_t>(seed)};
    const CorrectedRobot truth = truth_of(robot, random);
    const PlanRequest request = request_for(robot, poses, seed);
    const auto begin = std::chrono::steady_clock::now();
    const Plan plan = make_plan(request);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    const FeasibleSpace space(robot, *request.cell);
    const auto places = draw_poses(space, 200, RandomStream{778, static_cast<std::uint64_t>(seed)}).poses;
    const auto twice =
        draw_poses(space, 2 * static_cast<std::size_t>(poses), RandomStream{779, static_cast<std::uint64_t>(seed)})
            .poses;
    const double planned_m =
        true_error_m(fitted(measured(robot, truth, calibration_poses(plan), random)), truth, places);
    const double random_m = true_error_m(fitted(measured(robot, truth, twice, random)), truth, places);
    ratio.push_back(planned_m / random_m);
    prediction.push_back(planned_m / plan.predicted.rms_m);
  }
  if (options.json) {
    fmt::print("{}\n", Json{{"workload", "plan"},
                            {"robot", robot.name},
                            {"poses", poses},
                            {"seeds", options.seeds},
                            {"error_over_twice_random_median", median(ratio)},
                            {"found_over_predicted_median", median(prediction)},
                            {"seconds_median", median(seconds)}}
                           .dump());
  } else {
    fmt::print("{:<14} {:>5} {:>28.3f} {:>22.3f} {:>9.2f}\n", robot.name, poses, median(ratio), median(prediction),
               median(seconds));
  }
}

CalibratedModel model_of(const Robot& robot, const CorrectedRobot& truth, int seed) {
  RandomStream random{780, static_cast<std::uint64_t>(seed)};
  PlanRequest request = request_for(robot, 60, seed);
  request.validation = 30;
  const Plan plan = make_plan(request);
  std::vector<PlannedPose> poses;
  std::vector<PoseSet> sets;
  for (const PlannedStop& stop : plan.stops) {
    poses.push_back(stop.pose);
    sets.push_back(stop.set);
  }
  DataSet data = measured(robot, truth, poses, random);
  for (std::size_t i = 0; i < sets.size(); ++i) data.poses[i].set = sets[i];
  Job job;
  job.name = "bench";
  job.method = Method::diagnose;
  job.declared = kLinks;
  job.closed_loop.max_effects = 0;
  return diagnose(data, job, std::nullopt, {}).result.model;
}

enum class Change { none, offset, tool, base };

/// Whether the answer is right.
bool answered(const ChangeReport& report, Change change, int joint) {
  const auto is = [&](bool DeclaredModel::*flag, const ChangeCause& cause) {
    return declared_flag(cause.effect.kind) == flag;
  };
  if (change == Change::none) return report.verdict == ChangeVerdict::unchanged;
  if (report.found.empty()) return false;
  const ChangeCause& first = report.found.front();
  if (change == Change::base) return is(&DeclaredModel::registration, first);
  if (change == Change::tool) return is(&DeclaredModel::tool, first);
  return is(&DeclaredModel::joint_offset, first) && first.effect.joint == joint;
}

/// An arm, its model and the few poses that are to tell whether it has changed.
struct Watched {
  CorrectedRobot truth;
  CalibratedModel model;
  std::vector<PlannedPose> poses;
};

Watched watched(const Robot& robot, int seed) {
  constexpr int kPoses = 12;
  RandomStream random{781, static_cast<std::uint64_t>(seed)};
  const CorrectedRobot truth = truth_of(robot, random);
  return {truth, model_of(robot, truth, seed), calibration_poses(make_plan(request_for(robot, kPoses, 100 + seed)))};
}

/// What was answered of many arms with one kind of change.
struct Answers {
  int cases = 0, right = 0, powerless = 0;
};

void ask(const Robot& robot, const Watched& arm, Change change, int i, RandomStream& random, Answers& answers) {
  CorrectedRobot now = arm.truth;
  const int joint = 1 + i % (robot.chain.size() - 2);  // the first cannot be told from the base, the last from the tool
  const Eigen::Vector3d way = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  if (change == Change::offset) now.chain.joints[static_cast<std::size_t>(joint)].theta_rad += 3e-4;
  if (change == Change::tool) now.tools.at("").translation() += 2e-4 * way;
  if (change == Change::base) now.sensor_from_base.translation() += 1e-3 * way;
  const ChangeReport report = find_change(arm.model, measured(robot, now, arm.poses, random));
  ++answers.cases;
  if (answered(report, change, joint)) ++answers.right;
  for (const ChangeCause& cause : report.tried)
    if (change == Change::offset && cause.effect.joint == joint && cause.power < 0.9 &&
        declared_flag(cause.effect.kind) == &DeclaredModel::joint_offset)
      ++answers.powerless;
}

void bench_changes(const Robot& robot, const Options& options) {
  constexpr int kCasesOfAModel = 10;
  constexpr const char* kNames[] = {"none", "joint_offset_0.3_mrad", "tool_0.2_mm", "base_1_mm"};
  std::array<Answers, 4> all;
  std::optional<Watched> arm;
  for (int i = 0; i < options.cases; ++i) {
    if (i % kCasesOfAModel == 0) arm = watched(robot, 1 + i / kCasesOfAModel);
    for (const Change change : {Change::none, Change::offset, Change::tool, Change::base}) {
      RandomStream random{782 + static_cast<std::uint64_t>(change), static_cast<std::uint64_t>(i)};
      ask(robot, *arm, change, i, random, all[static_cast<std::size_t>(change)]);
    }
  }
  for (std::size_t change = 0; change < all.size(); ++change) {
    const Answers& answers = all[change];
    if (options.json) {
      fmt::print("{}\n", Json{{"workload", "check"},
                              {"robot", robot.name},
                              {"change", kNames[change]},
                              {"cases", answers.cases},
                              {"right", answers.right},
                              {"said_to_lack_power", answers.powerless}}
                             .dump());
    } else {
      fmt::print("{:<14} {:<22} {:>4} of {:>4} answered rightly ({} said to lack power)\n", robot.name, kNames[change],
                 answers.right, answers.cases, answers.powerless);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int kNoData = 10;
  Options options;
  CLI::App app{"planned poses beside random ones, predictions beside what is found, and changes named"};
  app.add_option("--seeds", options.seeds, "of truth, noise and plan")->capture_default_str();
  app.add_option("--cases", options.cases, "of each change")->capture_default_str();
  app.add_option("--poses", options.poses, "numbers of poses, LIST")->delimiter(',')->capture_default_str();
  app.add_option("--only", options.only, "plan, check, fleet or prior")
      ->check(CLI::IsMember({"plan", "check", "fleet", "prior"}));
  app.add_option("--fleet-seeds", options.fleet_seeds, "of types, their robots and noise")->capture_default_str();
  app.add_option("--model", options.prior.model, "MODEL.yaml, the old one (default: of series A, without evolution)")
      ->check(CLI::ExistingFile);
  app.add_option("--draws", options.prior.draws, "of new poses for the old model")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--drift", options.prior.drift,
               "series C after a model of B alone and with that of A, in place of B and C");
  app.add_flag("--stations", options.prior.stations,
               "series C after a model of A and B as stations, in place of B and C");
  app.add_option("--first-draw", options.prior.first_draw, "its number")->capture_default_str();
  app.add_flag("--json", options.json, "one JSON object a line");
  CLI11_PARSE(app, argc, argv);
  const auto asked = [&](const char* word) { return options.only.empty() || options.only == word; };
  const bool plans = asked("plan"), checks = asked("check");
  if (!options.json && plans)
    fmt::print("{:<14} {:>5} {:>28} {:>22} {:>9}\n", "robot", "poses", "error / of twice as random",
               "found / predicted", "seconds");
  for (const Robot& robot : arms())
    for (const int poses : options.poses)
      if (plans) bench_plans(robot, poses, options);
  for (const Robot& robot : arms())
    if (checks) bench_changes(robot, options);
  if (asked("fleet")) bench_fleets(options.fleet_seeds, options.json);
  options.prior.json = options.json;
  if (asked("prior") && !bench_priors(options.prior) && !options.only.empty()) return kNoData;
  return 0;
}
