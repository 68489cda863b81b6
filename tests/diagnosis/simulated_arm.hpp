// A simulated arm with errors that nobody declared, and the closed loop run on what was measured of it.
#pragma once

#include <cmath>
#include <vector>

#include "diagnosis/loop.hpp"
#include "fitting/known_arm.hpp"
#include "simulation/simulated_robot.hpp"

namespace demecal {

inline constexpr double kNoise_m = 5e-5;  ///< per axis

/// An arm with weight and nothing wrong with it, measured at 60 poses, validated at 40, and at 40 more that no fit
/// sees. Everything is recorded and varies.
inline Scenario perfect_scenario(const Chain& chain, std::uint64_t seed) {
  Scenario scenario;
  scenario.name = "simulated";
  scenario.robot.chain = chain;
  for (int link = 0; link < chain.size(); ++link) scenario.robot.masses.push_back({12.0 - link, {0.0, 0.02, 0.05}});
  scenario.seed = seed;
  scenario.by_joints = true;
  for (const Joint& joint : chain.joints) scenario.joint_ranges.push_back({0.8 * joint.lower, 0.8 * joint.upper});
  scenario.poses = {60, 40, 40};
  scenario.noise_m = kNoise_m;
  scenario.payloads_kg = {0.0, 4.0};
  scenario.seconds_per_pose = 20.0;
  scenario.temperature = {20.0, 32.0, 1100.0};
  return scenario;
}

/// Quick: few draws, few ratios.
inline LoopOptions quick() {
  LoopOptions options;
  options.null_draws = 99;
  options.resamples = 100;
  options.highest_ratio = 12;
  options.formulas = false;
  return options;
}

inline constexpr DeclaredModel kZeroed{.registration = true, .tool = true, .joint_offset = true};

inline LoopResult run_loop(const DataSet& data, const DeclaredModel& declared, const LoopOptions& options,
                           const RoundWatcher& watch = {}) {
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  return close_loop(data, declared, fit_declared(data, poses, declared, nominal_robot(data)), options, watch);
}

/// The effects that the rounds say were added.
inline std::vector<Effect> added(const LoopOutcome& outcome) {
  std::vector<Effect> effects;
  for (const Round& round : outcome.rounds) {
    if (round.verdict == Verdict::added) effects.push_back(round.effect);
  }
  return effects;
}

/// Root mean square distance of the model from the accept poses' measurements over that of pure noise.
inline double over_floor(const CorrectedRobot& model, const DataSet& data) {
  double squares = 0.0;
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::accept);
  for (const std::size_t pose : poses) squares += std::pow(tool_error_m(model, data, data.poses[pose]), 2);
  return std::sqrt(squares / (3.0 * static_cast<double>(poses.size()))) / kNoise_m;
}

/// The one effect that was added; the kind of all where there are others.
inline Effect only(const LoopResult& result) {
  const std::vector<Effect> effects = added(result.outcome);
  EXPECT_EQ(effects.size(), 1u);
  return effects.empty() ? Effect{} : effects.front();
}

}  // namespace demecal
