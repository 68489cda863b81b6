// A closed loop as it would run on a six-joint arm, with figures made up from a literal seed.
#pragma once

#include <numbers>

#include "made_up_report.hpp"
#include "report/make_report.hpp"

namespace demecal {

/// Six revolute joints; the effects stand by it.
inline Robot made_up_arm() {
  Robot robot;
  robot.name = "PUMA 761";
  for (int joint = 0; joint < 6; ++joint) {
    Joint link;
    link.alpha_rad = (joint % 2 == 0 ? -1.0 : 1.0) * std::numbers::pi / 2;
    link.a_m = 0.1 * joint;
    link.lower = -2.5;
    link.upper = 2.5;
    robot.chain.joints.push_back(link);
  }
  return robot;
}

inline Effect made_up_backlash() {
  Effect effect{.kind = "backlash", .joint = 1, .settings = {}, .form = "approach"};
  effect.values = {4.12e-4};
  effect.standard_errors = {1.3e-5};
  return effect;
}

inline Effect made_up_harmonic(int joint, double ratio, double cosine_rad, double sine_rad) {
  Effect effect{.kind = "gear_harmonic", .joint = joint, .settings = {{"ratio", ratio}}};
  effect.values = {cosine_rad, sine_rad};
  effect.standard_errors = {4e-6, 5e-6};
  return effect;
}

inline Effect without_values(Effect effect) {
  effect.values.clear();
  effect.standard_errors.clear();
  return effect;
}

/// The next round of a loop that has taken the error to `from_mm`.
inline Round made_up_round(const LoopOutcome& loop, const Effect& effect, double from_mm, double to_mm) {
  Round round;
  round.number = static_cast<int>(loop.rounds.size()) + 1;
  round.group = 1 + static_cast<int>(loop.rounds.size()) / 4;
  round.verdict = Verdict::added;
  round.effect = effect;
  round.diagnosis = "Something is the matter with round " + std::to_string(round.number) + ".";
  round.formula = "dq" + std::to_string(effect.joint + 1) + " = formula " + std::to_string(round.number);
  round.p_structure = 0.001;
  round.p_family = 0.002;
  round.gain_nats = 31.7 / round.number;
  round.confirmed = 0.97;
  round.confirmed_lower = 0.61;
  round.sign_stability = 0.995;
  for (const double value : effect.values) round.interval.push_back({0.9 * value, 1.1 * value});
  round.validation_before_mm = from_mm;
  round.validation_after_mm = to_mm;
  return round;
}

inline void add_harmonics(LoopOutcome& loop, int count, RandomStream& random) {
  for (int i = 0; i < count; ++i) {
    const double from = loop.rounds.empty() ? 0.771 : loop.rounds.back().validation_after_mm;
    const double size = random.real(2e-5, 2e-4);
    loop.rounds.push_back(
        made_up_round(loop, made_up_harmonic(i % 3, 11.0 + i, 0.6 * size, -0.8 * size), from, 0.97 * from));
  }
}

inline void add_limits(LoopOutcome& loop) {
  for (int joint = 0; joint < 6; ++joint) {
    loop.not_found.push_back(
        {{.kind = "compliance", .joint = joint, .settings = {}, .form = "masses"}, 1e-7 * (joint + 1), "rad/Nm"});
    if (joint == 1) continue;
    loop.not_found.push_back(
        {{.kind = "backlash", .joint = joint, .settings = {}, .form = "approach"}, 3.9e-5 * (joint + 1), "rad"});
  }
  loop.not_found.push_back({{.kind = "sensor_scale", .joint = -1, .settings = {}}, 2.5e-5, "1"});
  loop.untestable = {{"thermal_offset", "no temperature column"},
                     {"thermal_length", "no temperature column"},
                     {"drift", "no time column"}};
  loop.decoys = {{"backlash of joint 2 by shuffled approach signs", 1.25, false},
                 {"a gear ratio no gear has", -0.5, false}};
}

/// A backlash with a rival, so many gear harmonics at joints 1 to 3, and a gain that was rejected.
inline LoopOutcome made_up_loop(int harmonics) {
  RandomStream random{831};
  LoopOutcome loop;
  loop.stopped = StopReason::no_gain;
  loop.noise_estimated = true;
  Round first = made_up_round(loop, made_up_backlash(), 0.771, 0.642);
  Effect hysteresis{.kind = "hysteresis", .joint = 1, .settings = {}};
  first.rivals = {{hysteresis, 0.931, 3.2}};
  first.next_measurement =
      NextMeasurement{"14 poses from both sides, with and without a payload, would tell the two apart.", 14};
  loop.rounds.push_back(first);
  add_harmonics(loop, harmonics, random);
  Effect gain{.kind = "gain", .joint = 3, .settings = {}};
  gain.values = {2.1e-5};
  const double left = loop.rounds.back().validation_after_mm;
  Round last = made_up_round(loop, gain, left, left);
  last.verdict = Verdict::rejected;
  last.reason = "The bound of its gain on the validation poses is below zero.";
  last.p_family = 0.31;
  loop.rounds.push_back(last);
  loop.dropped = {without_values(made_up_harmonic(4, 77.0, 0.0, 0.0))};
  add_limits(loop);
  loop.repeat_scatter_m = 5.13e-5;
  loop.lack_of_fit_p = 0.0004;
  loop.explained_share = 0.873;
  loop.p_structure_left = 0.42;
  loop.candidates = 1312;
  loop.null_draws = 999;
  return loop;
}

/// What every cause of the added effects costs, by made-up figures.
inline ErrorBudget made_up_budget(const CorrectedRobot& robot) {
  ErrorBudget budget;
  double without_mm = 0.52;
  for (const ErrorCause& cause : causes_of(robot)) {
    budget.front.push_back(
        {.causes = budget.front.size(), .validation_rms_mm = without_mm + 0.1, .accept_rms_mm = without_mm + 0.11});
    budget.causes.push_back({.cause = cause,
                             .without_mm = without_mm,
                             .with_mm = 0.311,
                             .share = without_mm - 0.311,
                             .interval_mm = {0.9 * without_mm, 1.1 * without_mm}});
    without_mm = 0.311 + 0.6 * (without_mm - 0.311);
  }
  budget.front.push_back(
      {.causes = budget.front.size(), .validation_rms_mm = 0.311, .accept_rms_mm = 0.32, .chosen = true});
  return budget;
}

inline Report made_up_looped_report(const LoopOutcome& loop) {
  Report report = made_up_report();
  RandomStream random{832};
  CorrectedRobot robot;
  for (const Round& round : loop.rounds) {
    if (round.verdict == Verdict::added) robot.effects.push_back(round.effect);
  }
  set_loop(loop, made_up_arm(), report);
  set_causes(made_up_budget(robot), robot, made_up_arm(), report);
  report.after = errors_about(0.311, random);
  return report;
}

inline Report made_up_looped_report(int harmonics = 5) {
  return made_up_looped_report(made_up_loop(harmonics));
}

}  // namespace demecal
