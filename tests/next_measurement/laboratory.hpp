// A simulated arm, measured wherever a test sends it, and a model of it that lacks what the test asks about.
#pragma once

#include <cmath>
#include <numeric>

#include "fitting/fit.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/residual_field.hpp"
#include "simulation/planar_arm.hpp"

namespace demecal {

/// The PUMA 761 with so many times its weight, joints 2 and 3 kept within `elbow_deg` (lower and upper limits of both).
inline Robot laden_puma(std::array<double, 4> elbow_deg, double weight = 1.0) {
  Robot robot = puma_761();
  const std::array<double, 6> masses_kg{150, 110, 60, 12, 6, 2};
  for (const double mass_kg : masses_kg) robot.masses.push_back({weight * mass_kg, {0.0, 0.0, 0.02}});
  robot.masses[1].centre_m = {-0.38, 0.0, 0.02};
  for (std::size_t i = 0; i < 4; ++i) {
    Joint& joint = robot.chain.joints[1 + i / 2];
    (i % 2 == 0 ? joint.lower : joint.upper) = radians(elbow_deg[i]);
  }
  return robot;
}

/// Joint 1 and the wrist anywhere within a third of a turn, the elbow within its limits; every joint from either side.
inline Visit random_visit(const Robot& robot, RandomStream& random) {
  Visit visit{.commanded = JointVector(6), .approach = ApproachSigns(6)};
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Joint& joint = robot.chain.joints[static_cast<std::size_t>(i)];
    const bool elbow = i == 1 || i == 2;
    const double middle = 0.5 * (joint.lower + joint.upper), half = 0.5 * (joint.upper - joint.lower);
    visit.commanded[i] = middle + (elbow ? half : radians(60.0)) * random.real(-1.0, 1.0);
    visit.approach[i] = random.chance(0.5) ? 1.0 : -1.0;
  }
  return visit;
}

class Laboratory {
 public:
  Laboratory(Robot robot, std::uint64_t seed) : random_{seed} {
    scenario.robot = std::move(robot);
    scenario.home = JointVector::Zero(6);
    scenario.noise_m = 5e-5;
    declared.registration = declared.joint_offset = true;
  }

  Visit visit() { return random_visit(scenario.robot, random_); }

  /// Adds a measurement of every visit to `data`, with the arm so many kelvin warmer than it would be.
  void measure(DataSet& data, const std::vector<Visit>& visits, double warmer_kelvin = 0.0) {
    Scenario now = scenario;
    if (now.temperature) {
      now.temperature->lower_celsius += warmer_kelvin;
      now.temperature->upper_celsius += warmer_kelvin;
    }
    const SimulatedRobot robot(now);
    for (const Visit& each : visits) {
      data.poses.push_back(robot.measure(each, random_));
      if (each.payload_kg > 0.0) data.poses.back().payload_kg = each.payload_kg;
    }
  }

  DataSet data_set() const {
    DataSet data;
    data.robot = scenario.robot;
    data.frame = Frame::base;
    return data;
  }

  /// All poses fit.
  DiagnosisProblem diagnosed(const DataSet& data) const {
    std::vector<std::size_t> all(data.poses.size());
    std::iota(all.begin(), all.end(), 0);
    return {data, declared, all, {}};
  }

  /// What is declared and `effect`, at their least-squares values.
  DiagnosedModel model_with(const DiagnosisProblem& problem, Effect effect) const {
    const Fit fit = fit_declared(problem.data, problem.fitted, declared, nominal_robot(problem.data), {.starts = 0});
    DiagnosedModel model;
    model.robot = fit.robot;
    model.smooth = smooth_corrections(problem.data, problem.fitted, fit.robot, declared.joint_corrections);
    model.scales = {fit.sigma_position_m, fit.sigma_orientation_rad, fit.sigma_distance_m};
    effect.values.assign(law_of(effect).coefficients(effect, problem.data.robot).size(), 0.0);
    model.robot.effects.push_back(std::move(effect));
    return refined(problem, std::move(model), 4);
  }

  /// How many standard deviations of `named` (with its values) the data show beyond all that `instead` explains.
  double shown_beyond(const DataSet& data, const Effect& named, const Effect& instead) const {
    const DiagnosisProblem problem = diagnosed(data);
    const Linearization linearization = linearize(problem, model_with(problem, instead));
    EffectColumns columns;
    columns.append({named}, data.robot, linearization.fitted.states);
    columns.pack();
    const Eigen::VectorXd values =
        Eigen::VectorXd::Map(named.values.data(), static_cast<Eigen::Index>(named.values.size()));
    const RowMatrix signal = columns.dense(linearization.fitted, 0) * values;
    const Projection::Trial trial = linearization.projection.trial(signal, RowMatrix(0, 1));
    return std::copysign(std::sqrt(trial.drop), trial.coefficients[0]);
  }

  Scenario scenario;
  DeclaredModel declared;

 private:
  RandomStream random_;
};

}  // namespace demecal
