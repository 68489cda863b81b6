// Whether the radii that a model states hold the share of new positions that they should, how wide they are, and how
// often a tolerance as large as the true error is said to be kept.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "../run_cases.hpp"
#include "acceptance/verdict.hpp"
#include "errors/input_error.hpp"
#include "mistaken_case.hpp"
#include "noise/noisy_measurement.hpp"
#include "prediction/measurement.hpp"
#include "workflows/workflows.hpp"

namespace {

using namespace demecal;
using namespace demecal::bench;

// Never changed, so that figures of two builds are compared case by case.
constexpr std::uint64_t kSeed = 20'261'125'000;
constexpr std::uint64_t kSize = 51, kEffects = 52, kAccepted = 53;  ///< of the case's random streams
constexpr std::array<const char*, 6> kConditions{"ideal", "joint_noise", "student", "tracker", "path", "outliers"};
constexpr std::size_t kFewest = 30, kMost = 200;
constexpr int kDrawsOfFresh = 5;  ///< of 200 new poses
constexpr std::size_t kAccept = 100;
constexpr double kAcceptNoise_m = 5e-5;

struct CoverageCase {
  std::string condition{}, arm{};
  std::size_t poses = 0;
  bool effects = false;       ///< undeclared ones are in the arm
  int fresh = 0, within = 0;  ///< new positions inside the measured range, and those within their radius
  double mean_radius_mm = 0.0, oracle_mm = 0.0;  ///< oracle: the radius of 95 % of the true errors
  bool judged = false, falsely_accepted = false;
  bool failed = false;
};

/// Backlash of one joint.
void add_undeclared(Scenario& scenario, RandomStream& random) {
  const auto joints = static_cast<std::size_t>(scenario.robot.chain.size());
  scenario.backlash.push_back({static_cast<int>(random.index(joints)), random.real(2e-4, 6e-4)});
}

/// As many of the poses, dealt to calibration and validation.
DataSet first_poses(DataSet data, std::size_t count, RandomStream& random) {
  data.poses.resize(count);
  split_by_pose(data.poses, {.validation = 0.25, .accept = 0.0}, [&](std::size_t n) { return random.index(n); });
  return data;
}

bool is_inside(const std::vector<Interval>& measured, const MeasuredPose& pose) {
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double joint = pose.joints[static_cast<Eigen::Index>(i)];
    if (joint < measured[i].lower || joint > measured[i].upper) return false;
  }
  return true;
}

double share_of(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

/// A verdict on measured errors of some of the new poses, at a tolerance that is the true error's.
bool is_falsely_accepted(const std::vector<Eigen::Vector3d>& errors_m, double tolerance_m, RandomStream& random) {
  std::vector<double> measured_m;
  for (std::size_t i = 0; i < kAccept; ++i) {
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    measured_m.push_back((errors_m[random.index(errors_m.size())] + kAcceptNoise_m * noise).norm());
  }
  return judge(measured_m, tolerance_m, 0.0, kAcceptNoise_m).verdict == Conformity::conformity;
}

void judge_fresh(const NoiseCase& one, const Scenario& scenario, const CalibratedModel& model,
                 const JointVector& repeats_to_rad, CoverageCase& result) {
  std::vector<Eigen::Vector3d> errors_m;
  std::vector<double> lengths_m;
  double radii_m = 0.0;
  for (int draw = 1; draw <= kDrawsOfFresh; ++draw) {
    NoiseCase course = one;
    course.seed += 1'000'000 * static_cast<std::uint64_t>(draw);
    const DataSet fresh = fresh_poses(course, scenario, repeats_to_rad);
    for (const MeasuredPose& pose : fresh.poses) {
      if (!is_inside(model.measured, pose)) continue;
      const Stop stop(pose);
      errors_m.emplace_back(*pose.position_m - model.robot.predict(stop, "").translation());
      lengths_m.push_back(errors_m.back().norm());
      const double radius_m = real_radius95_m(*model.interval, *model.posterior, model.robot, stop);
      radii_m += radius_m;
      result.within += lengths_m.back() <= radius_m ? 1 : 0;
    }
  }
  result.fresh = static_cast<int>(errors_m.size());
  if (errors_m.size() < kAccept) return;
  result.mean_radius_mm = 1e3 * radii_m / static_cast<double>(errors_m.size());
  const double true_m = share_of(lengths_m, kAcceptedShare);
  result.oracle_mm = 1e3 * true_m;
  result.judged = true;
  RandomStream random{one.seed, kAccepted};
  result.falsely_accepted = is_falsely_accepted(errors_m, true_m, random);
}

CoverageCase run_case(int number, const std::vector<Robot>& arms, bool as_commanded) {
  const auto place = static_cast<std::size_t>(number);
  NoiseCase one = noise_cases(kConditions[place / arms.size() % kConditions.size()], number + 1).back();
  one.seed = kSeed + place;
  CoverageCase result{.condition = one.condition.name};
  RandomStream size{one.seed, kSize}, effects{one.seed, kEffects};
  Scenario scenario = noisy_scene(one, arms);
  result.arm = scenario.robot.name;
  result.poses = kFewest + size.index(kMost - kFewest + 1);
  result.effects = place / (arms.size() * kConditions.size()) % 2 == 1;
  if (result.effects) add_undeclared(scenario, effects);
  const DataSet data = first_poses(measured_noisily(one, scenario), result.poses, size);
  Job job;
  job.method = Method::diagnose;
  job.seed = one.seed;
  job.declared = one.declared(arms.size());
  try {
    const Diagnosis diagnosis = diagnose(data, job, std::nullopt, {});
    const CalibratedModel& model = diagnosis.result.model;
    if (!model.interval || !model.posterior || !std::isfinite(model.interval->quantile)) {
      result.failed = true;
      return result;
    }
    const Eigen::Index joints = scenario.robot.chain.size();
    judge_fresh(one, scenario, model, as_commanded ? JointVector() : repeatability_rad(one, joints), result);
  } catch (const InputError&) {
    result.failed = true;
  }
  return result;
}

struct Sum {
  std::string name{};
  int cases = 0, without = 0, judged = 0, accepted = 0;
  long fresh = 0, within = 0;
  std::vector<double> widths{};

  void add(const CoverageCase& one) {
    ++cases;
    without += one.failed ? 1 : 0;
    fresh += one.fresh;
    within += one.within;
    judged += one.judged ? 1 : 0;
    accepted += one.falsely_accepted ? 1 : 0;
    if (one.oracle_mm > 0.0) widths.push_back(one.mean_radius_mm / one.oracle_mm);
  }
  double coverage() const { return fresh > 0 ? static_cast<double>(within) / static_cast<double>(fresh) : 0.0; }
  double width() const {
    return widths.empty() ? 0.0
                          : std::accumulate(widths.begin(), widths.end(), 0.0) / static_cast<double>(widths.size());
  }
  double false_acceptance() const { return judged > 0 ? static_cast<double>(accepted) / judged : 0.0; }
};

std::vector<Sum> sums_of(const std::vector<CoverageCase>& cases) {
  std::vector<Sum> sums{
      {"all"}, {"nothing undeclared"}, {"backlash undeclared"}, {"30 to 80 poses"}, {"81 to 200 poses"}};
  for (const char* condition : kConditions) sums.push_back({condition});
  for (const CoverageCase& one : cases) {
    sums[0].add(one);
    sums[one.effects ? 2 : 1].add(one);
    sums[one.poses <= 80 ? 3 : 4].add(one);
    for (std::size_t i = 0; i < kConditions.size(); ++i)
      if (one.condition == kConditions[i]) sums[5 + i].add(one);
  }
  return sums;
}

void write(const std::vector<CoverageCase>& cases, bool json) {
  if (!json)
    fmt::print("{:22} {:>6} {:>9} {:>9} {:>12} {:>15}\n", "", "cases", "coverage", "width", "no interval",
               "falsely kept");
  for (const Sum& sum : sums_of(cases)) {
    if (json) {
      fmt::print("{}\n", nlohmann::ordered_json{{"cases_of", sum.name},
                                                {"cases", sum.cases},
                                                {"positions", sum.fresh},
                                                {"coverage", sum.coverage()},
                                                {"width_over_oracle", sum.width()},
                                                {"without_interval", sum.without},
                                                {"false_acceptance", sum.false_acceptance()}}
                             .dump());
    } else {
      fmt::print("{:22} {:6} {:9.4f} {:9.3f} {:12} {:15.3f}\n", sum.name, sum.cases, sum.coverage(), sum.width(),
                 sum.without, sum.false_acceptance());
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Whether radii of 95 % hold 95 % of new real positions inside the measured range (wanted .935 to .965), how wide "
      "they are against the radius that holds 95 % of the true errors (wanted at most 1.3 times), and how often a "
      "tolerance equal to the true error is said to be kept (wanted at most .025)."};
  int count = 300, threads = 2;
  bool json = false, each = false, as_commanded = false;
  app.add_option("--cases", count, "simulated calibrations of 30 to 200 poses")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", threads, "cases at a time; figures do not depend on it")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_flag("--json", json, "one JSON object a line instead of the table");
  app.add_flag("--as-commanded", as_commanded,
               "new poses stand where they are sent, also of arms whose joints repeat no better than to 0.01 deg");
  app.add_flag("--each", each, "also one line a case on standard error");
  CLI11_PARSE(app, argc, argv);
  const std::vector<Robot> arms = mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots");
  std::vector<CoverageCase> cases(static_cast<std::size_t>(count));
  const auto run = [&](std::size_t number) { cases[number] = run_case(static_cast<int>(number), arms, as_commanded); };
  run_cases(cases.size(), threads, run, [&](std::size_t number) {
    if (!each) return;
    const CoverageCase& one = cases[number];
    std::cerr << fmt::format("{} {} {} {} poses{}: {} of {}, {:.4f} over {:.4f} mm{}\n", number, one.condition, one.arm,
                             one.poses, one.effects ? " backlash" : "", one.within, one.fresh, one.mean_radius_mm,
                             one.oracle_mm, one.failed ? " no interval" : "");
  });
  write(cases, json);
  return 0;
}
