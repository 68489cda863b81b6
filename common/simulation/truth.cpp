#include "simulation/truth.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "data/data_set.hpp"
#include "expression/evaluate.hpp"
#include "simulation/stance.hpp"

namespace demecal::inline simulation {
namespace {

double harmonic(double angle, double cosine, double sine) {
  return cosine * std::cos(angle) + sine * std::sin(angle);
}

}  // namespace

void deform(Chain& chain, const GeometryError& error) {
  chain.joints[static_cast<std::size_t>(error.joint)].parameter(error.parameter) += error.value;
}

Eigen::Vector3d tilt(const AxisWobble& error, const Situation& situation) {
  const double angle = error.order * situation.commanded[error.joint];
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  vector.head<2>() = std::cos(angle) * error.cosine_rad + std::sin(angle) * error.sine_rad;
  return vector;
}

VariableNames symbolic_variables(int joints) {
  VariableNames names;
  for (int joint = 1; joint <= joints; ++joint) names.push_back(std::to_string(joint).insert(0, 1, 'q'));
  names.insert(names.end(), {"tau", "s", "T"});
  return names;
}

double deviation(const JointError& error, const Situation& situation) {
  const std::array<double, 1> theta{situation.commanded[error.joint]};
  return evaluate(error.formula, theta);
}

double deviation(const GearHarmonic& error, const Situation& situation) {
  return harmonic(error.ratio * situation.commanded[error.joint], error.cosine_rad, error.sine_rad);
}

double deviation(const Gain& error, const Situation& situation) {
  return error.per_rad * situation.commanded[error.joint];
}

double deviation(const Eccentricity& error, const Situation& situation) {
  return harmonic(error.order * situation.commanded[error.joint], error.cosine_rad, error.sine_rad);
}

double deviation(const Coupling& error, const Situation& situation) {
  const double q = situation.commanded[error.from];
  return error.per_rad * q + harmonic(q, error.cosine_rad, error.sine_rad);
}

double deviation(const SymbolicError& error, const Situation& situation) {
  std::vector<double> values(situation.commanded.begin(), situation.commanded.end());
  values.insert(values.end(), {situation.loads[static_cast<std::size_t>(error.joint)].effort,
                               situation.approach[error.joint], situation.warming_kelvin});
  return evaluate(error.formula, values);
}

double deviation(const Backlash& error, const Situation& situation) {
  return -0.5 * error.width_rad * situation.approach[error.joint];
}

double deviation(const Hysteresis& error, const Situation& situation) {
  const double load = std::abs(situation.loads[static_cast<std::size_t>(error.joint)].effort);
  return -error.friction_rad * situation.approach[error.joint] * (1.0 + error.per_nm * load);
}

double deviation(const Compliance& error, const Situation& situation) {
  return error.rad_per_nm * situation.loads[static_cast<std::size_t>(error.joint)].effort;
}

double deviation(const BalanceSpring& error, const Situation& situation) {
  const Eigen::Rotation2Dd turn(situation.commanded[error.joint] - error.shortest_rad);
  const Eigen::Vector2d fixed_m(error.fixed_m, 0.0), moving_m = turn * Eigen::Vector2d(error.moving_m, 0.0);
  const Eigen::Vector2d along_m = fixed_m - moving_m;
  const double shortest_m = std::abs(error.fixed_m - error.moving_m);
  const Eigen::Vector2d pull_n = (error.force_n + error.n_per_m * (along_m.norm() - shortest_m)) * along_m.normalized();
  return error.rad_per_nm * (moving_m.x() * pull_n.y() - moving_m.y() * pull_n.x());
}

Eigen::Vector3d tilt(const LinkBending& error, const Situation& situation) {
  const Eigen::Vector3d& moment = situation.loads[static_cast<std::size_t>(error.joint)].moment_nm;
  return {error.x_rad_per_nm * moment.x(), error.y_rad_per_nm * moment.y(), 0.0};
}

double temperature_celsius(const TemperatureCourse& course, double time_s) {
  const double middle = 0.5 * (course.lower_celsius + course.upper_celsius);
  const double swing = 0.5 * (course.upper_celsius - course.lower_celsius);
  return middle + swing * std::sin(2.0 * std::numbers::pi * time_s / course.period_s);
}

double deviation(const ThermalOffset& error, const Situation& situation) {
  return error.rad_per_kelvin * situation.warming_kelvin;
}

void deform(Chain& chain, const ThermalLength& error, const Situation& situation) {
  Joint& link = chain.joints[static_cast<std::size_t>(error.joint)];
  const double growth = 1.0 + error.per_kelvin * situation.warming_kelvin;
  link.a_m *= growth;
  link.d_m *= growth;
}

Eigen::Isometry3d drifted(const Eigen::Isometry3d& pose, const Drift& drift, double time_s) {
  Eigen::Isometry3d crept = Eigen::Isometry3d::Identity();
  crept.linear() = rotation_by(time_s * drift.rad_per_s).toRotationMatrix();
  crept.translation() = time_s * drift.metres_per_s;
  return crept * pose;
}

Eigen::Vector3d scaled(const Eigen::Vector3d& point_m, const SensorScale& scale) {
  return (1.0 + scale.share) * point_m;
}

}  // namespace demecal::inline simulation
