// A report with everything that a report can have, for tests that walk its keys.
#pragma once

#include "report/made_up_loop.hpp"

namespace demecal {

/// The loop with every kind of entry: effects with forms, settings and standard errors wherever effects stand.
inline LoopOutcome full_loop() {
  LoopOutcome loop = made_up_loop(2);
  const Effect backlash = made_up_backlash(), harmonic = made_up_harmonic(2, 24.0, 1e-4, -2e-4);
  for (const Effect& effect : {backlash, harmonic}) {
    loop.rounds.front().rivals.push_back({effect, 0.99, 0.1});  // near enough to be of one class
    loop.dropped.push_back(effect);
    loop.not_found.push_back({effect, 3e-5, "rad"});
  }
  loop.noise = {.joint_rad = 2e-4, .repeats = 0.5, .order = 0.3, .correlation = 0.8};
  loop.independent_m = 5e-5;
  return loop;
}

/// Of the method "distal", with shared functions.
inline Report full_report() {
  Report report = made_up_sharing_report();
  set_loop(full_loop(), made_up_arm(), report);
  CorrectedRobot robot;
  robot.effects = {made_up_backlash(), made_up_harmonic(0, 11.0, 1e-4, 0.0)};
  set_causes(made_up_budget(robot), robot, made_up_arm(), report);
  report.method = "distal";
  report.data_check = {"suspicious", {{"outlier", 0, {"P17"}, 3.1, 0.2, "Pose P17 is 3.1 mm off."}}};
  report.poses.excluded = {{"P31", "validation", 0.4}};
  report.unseen_validation_rms_mm = {0.37, 0.17};
  report.pose_errors = {{"P01", "A", "calibration", 0.5, 0.3, 0.8, {"outlier"}}};
  report.pose_errors.front().place = {{10, 20}, {1, 2, 3}, {0.3, 0, 0.4}, {0.3, 0, 0}, 21.5, 60.0};
  report.arm = ArmEntry{std::vector<double>(12),
                        {{"revolute", std::vector<double>(12)}},
                        std::vector<double>(12),
                        {0, 0, 50},
                        {{3, 2, 1.0}}};
  report.stations = {{"north", 30, report.registered, report.before, report.after, {}, {}}};
  report.unexplained = UnexplainedEntry{.error_mm = 0.26, .left_mm = 0.3, .noise_mm = 0.15, .advice = "Measure more."};
  report.length_errors = {{{"left", "right"}, "accept", 50.0, 0.05, 0.4, 0.06, 0.07}};
  report.contacts = {{"left", "accept", "point", 30, 8.1, 0.7, 0.5}};
  report.contact_notes = {"No length is known."};
  report.prediction_interval = {2.1, 0.05, 0.0, 0.02, "accept", 30, 1, "a remark"};
  report.workspace_error = {0.2, 0.4, true};
  report.distal = {{1, 10, "0.001 * SIN(theta)", 40.0}};
  report.runtime.waited_share = {{"cell-a-1", 0.04}};
  return report;
}

}  // namespace demecal
