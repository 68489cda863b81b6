// A report as a calibration of a six-joint arm would leave it, with figures made up from a literal seed.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "expression/bound.hpp"
#include "expression/text.hpp"
#include "random/random_stream.hpp"
#include "report/history.hpp"
#include "report/make_report.hpp"

namespace demecal {

inline SetErrors figures_about(double mean_mm, RandomStream& random) {
  return {mean_mm, mean_mm * random.real(1.05, 1.15), mean_mm * random.real(1.6, 1.9), mean_mm * random.real(2.0, 2.6)};
}

inline ErrorBySet errors_about(double mean_mm, RandomStream& random) {
  ErrorBySet errors;
  errors.calibration = figures_about(mean_mm * random.real(0.85, 0.95), random);
  errors.validation = figures_about(mean_mm, random);
  return errors;
}

inline JointEntry kept_joint(std::uint64_t joint, const std::string& expression, double before_rad, double after_rad,
                             Interval range_rad) {
  const Tree formula = parse(expression);
  JointEntry entry;
  entry.joint = joint;
  entry.kept = true;
  entry.mean_abs_error_rad = {before_rad, after_rad};
  entry.bound_rad = if_finite(magnitude_bound(formula, range_rad));
  entry.discontinuities_rad = discontinuities(formula, range_rad, 1e-5);
  entry.expression = expression;
  entry.range_rad = range_rad;
  return entry;
}

inline JointEntry neutral_joint(std::uint64_t joint, double error_rad, const std::string& note) {
  JointEntry entry;
  entry.joint = joint;
  entry.mean_abs_error_rad = {error_rad, error_rad};
  entry.bound_rad = 0.0;
  entry.note = note;
  entry.expression = to_string(neutral_tree());
  entry.range_rad = Interval{-1.5, 1.7};
  return entry;
}

inline std::vector<JointEntry> made_up_joints() {
  return {kept_joint(1, "0.00042 * SIN(theta + 0.7) + 0.00011 * COS(4.1 * theta)", 4.6e-4, 1.4e-4, {-2.62, 2.44}),
          kept_joint(2,
                     "0.00093 * COS(theta + 0.31) - 0.00018 * SIGN(theta + 0.85) + 0.00007 * SIN(theta * theta * 1.7 - "
                     "0.2) + SQRTp(theta * 0.0000000612 + 0.00000000214) * (0.21 - COS(theta % 1.9 + 0.4) * 0.17)",
                     1.12e-3, 2.7e-4, {-2.3, 1.1}),
          kept_joint(3, "0.00061 * SIN(1.02 * theta + 1.4)", 7.1e-4, 2.9e-4, {-0.9, 3.1}),
          neutral_joint(4, 5.2e-4, "no evolved correction earned its place on the validation poses"),
          kept_joint(5, "0.00002 % (theta - 0.4) - 0.0003 * theta", 6.6e-4, 4.1e-4, {-1.6, 1.8}),
          neutral_joint(6, 8.9e-4, "the joint hardly moves over the calibration poses")};
}

inline ParameterEstimate estimate_of(ParameterId::Kind kind, int index, double nominal, double value, double error) {
  ParameterEstimate estimate;
  estimate.id.kind = kind;
  estimate.id.index = index;
  estimate.nominal = nominal;
  estimate.value = value;
  estimate.standard_error = error;
  return estimate;
}

inline ParameterEstimate link_estimate(int joint, LinkParameter link, RandomStream& random) {
  const bool angle = link == LinkParameter::theta || link == LinkParameter::alpha;
  const double nominal = angle ? (joint % 2 == 0 ? -std::numbers::pi / 2 : 0.0) : 0.1 * joint;
  const double moved = random.real(-8e-4, 8e-4), error = random.real(2e-5, 9e-5);
  const bool seen = joint != 0 || link != LinkParameter::d;
  ParameterEstimate estimate =
      estimate_of(ParameterId::Kind::link, joint, nominal, nominal + (seen ? moved : 0.0), seen ? error : 0.0);
  estimate.id.link = link;
  return estimate;
}

inline std::vector<ParameterEstimate> made_up_estimates(RandomStream& random) {
  std::vector<ParameterEstimate> estimates;
  for (const auto kind : {ParameterId::Kind::base_translation, ParameterId::Kind::base_rotation}) {
    for (int axis = 0; axis < 3; ++axis) {
      estimates.push_back(estimate_of(kind, axis, 0.0, random.real(-1.5, 1.5), random.real(5e-5, 9e-5)));
    }
  }
  for (int joint = 0; joint < 6; ++joint) {
    for (const LinkParameter link : {LinkParameter::theta, LinkParameter::d, LinkParameter::a, LinkParameter::alpha}) {
      estimates.push_back(link_estimate(joint, link, random));
    }
  }
  return estimates;
}

inline Report made_up_report() {
  RandomStream random{20240611};
  Report report;
  report.job = "puma761-demo";
  report.robot = "PUMA 761";
  report.method = "direct";
  report.data_sha256 = "5f70bf18a086007016e948b04aed3b82103a36bea41755b6cddfaf10ace3c6ef";
  report.version = "0.1.0";
  report.seed = 18446744073709551557u;
  report.poses = {60, 30, 0, {"P17", "P41"}, {}, {}};
  report.poses.near_singular = {"P03", "P22", "P58"};
  report.nominal = errors_about(1523.4, random);
  report.registered = errors_about(1.852, random);
  report.declared = errors_about(1.114, random);
  report.before = errors_about(0.771, random);
  report.after = report.before;
  report.noise_floor_mm = 0.0513;
  report.fitted_sets = {"calibration"};
  report.performance_index_mm2 = {81.27, 39.91};
  report.joints = made_up_joints();
  report.joints[0].origin = "evolved";
  report.joints[1].origin = "evolved_and_smooth_terms";
  report.joints[2].origin = report.joints[4].origin = "smooth_terms";
  report.joints[0].limit_rad = 1.01 * *report.joints[0].bound_rad;
  report.joints[1].limit_rad = 0.5 * *report.joints[1].bound_rad;
  report.joints[2].short_form = "0.61 mrad sin(q3 + 80 deg)";
  for (JointEntry& joint : report.joints) {
    joint.as_evolved = "0.0003 * SIN(theta)";
    joint.as_evolved_error_rad = 3.1e-4;
  }
  report.as_evolved = report.before;
  for (const ParameterEstimate& estimate : made_up_estimates(random))
    report.parameters.push_back(parameter_entry(estimate));
  report.unidentified = {
      "joint 1 d_mm and base_z_mm have the same effect in these poses: only their combination is identified (1 : -1 by "
      "effect)"};
  report.runtime.wall_s = 754.3;
  report.runtime.workers = 4;
  report.runtime.islands = 24;
  report.runtime.generations = 6000;
  report.runtime.evaluations = 48123456;
  report.runtime.migrations = 2304;
  return report;
}

/// The same whose joints share functions, of which two call the first and none the second.
inline Report made_up_sharing_report() {
  Report report = made_up_report();
  report.shared_functions = {{"F1(c1, c2, a1) = c1 * SIN(a1 + c2)", {1, 3}}, {"F2(a1) = TANH(ATAN(a1))", {}}};
  report.joints[0].with_functions = "F1(0.00042, 0.7, theta) + 0.00011 * COS(4.1 * theta)";
  report.joints[2].with_functions = "F1(0.00061, 1.4, 1.02 * theta)";
  return report;
}

/// Rows of `joints` joints with `demes` islands each, whose best fitness falls from epoch to epoch.
inline std::vector<HistoryRow> made_up_history(std::uint32_t joints, std::uint32_t demes, std::uint32_t epochs) {
  RandomStream random{77};
  std::vector<HistoryRow> rows;
  for (std::uint32_t joint = 0; joint < joints; ++joint) {
    for (std::uint32_t deme = 0; deme < demes; ++deme) {
      double best = random.real(14.0, 22.0);
      for (std::uint32_t epoch = 0; epoch <= epochs; ++epoch) {
        HistoryRow row;
        row.island = {joint, deme};
        row.generation = 10 * epoch;
        row.figures = {best, 1.3 * best, 5 + epoch % 30};
        row.evaluations = 2000u * (epoch + 1);
        row.migrants_taken = 3u * epoch;
        row.worker = deme % 2 == 0 ? "cell-a" : "cell-b";
        rows.push_back(row);
        const double floor = 2.0 + 2.0 * joint;
        if (random.real() < 0.5) best = floor + (best - floor) * random.real(0.55, 1.0);
      }
    }
  }
  return rows;
}

}  // namespace demecal
