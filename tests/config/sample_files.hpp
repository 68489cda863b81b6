// Small valid files of every kind, and changes to them.
#pragma once

#include <string>

#include "errors/check.hpp"

namespace demecal {

inline const std::string kRobotText = R"yaml(# an arm of two joints
demecal_robot: 1
name: Two joints
convention: standard_dh
joints:
  - {type: revolute, alpha_deg: 0, a_mm: 400, d_mm: 0, theta_offset_deg: 0, limits_deg: [-170, 170]}
  - {type: prismatic, alpha_deg: 0, a_mm: 300, d_mm: 10, theta_offset_deg: 0, limits_mm: [0, 250]}
tool_mm: [0, 0, 50]
links:
  - {mass_kg: 3, com_mm: [-200, 0, 0]}
  - {mass_kg: 1, com_mm: [-150, 0, 0]}
gravity_mps2: [0, 0, -9.81]
repeatability_mm: 0.05
payload_kg: 10
)yaml";

inline const std::string kDataSetText = R"yaml(# poses of the arm of two joints
demecal_dataset: 1
name: two
robot: robot.yaml
poses: poses.csv
columns:
  joints: [q1_deg, q2_mm]
  position: [x_mm, y_mm, z_mm]
  distances: [l1_mm]
  approach: [s1, s2]
  set: set
  pose: pose_id
  target: target_id
anchors_mm: [[1000, 0, 0]]
tools_mm: {A: [0, 0, 50], B: [0, 30, 50]}
frame: base
)yaml";

inline const std::string kPosesText = R"yaml(q1_deg,q2_mm,x_mm,y_mm,z_mm,l1_mm,s1,s2,set,pose_id,target_id
10,20,1,2,3,500,1,-1,calibration,P1,A
10,20,1,2,3,500,1,-1,calibration,P1,B
-80,200,4,5,6,700,-1,1,validation,P2,A
)yaml";

inline const std::string kJobText = R"yaml(# what to do with the poses
demecal_job: 1
data: dataset.yaml
method: distal
seed: 7
model: {declared: [registration, geometry, joint_corrections]}
gp:
  population_size: 120
  number_generations: 40
  tournament_size: 4
  initial_max_tree_depth1: 3
  initial_max_tree_depth2: 6
  max_tree_depth: 8
  min_tree_depth: 2
  invalid_attempts: 11
  crossover_rate: 0.7
  mutation_rate: 0.25
  terminal_crossover_rate: 0.15
  terminal_mutation_rate: 0.35
  shrink_mutation_rate: 0.1
  functions: ['+', '-', '*', '%', SIN, SQRTp]
  constants_range: [-2, 2.5]
islands:
  per_joint: 3
  topology: full
  migration_interval: 5
  migrants: 2
  between_joints: true
closed_loop:
  max_effects: 4
  family_error: 0.01
  candidates: [backlash, compliance]
  highest_ratio: 90
  ratios: [161, 211.5]
distal: {form: sequential, rounds: 3, amplitudes: fitted}
targets: posterior
joint_error_mrad: 2.5
explanations: {variations: 2000, max_causes: 8}
)yaml";

inline const std::string kScenarioText = R"yaml(# the arm of two joints, simulated
demecal_scenario: 1
name: two
robot: robot.yaml
seed: 5
poses: {calibration: 4, validation: 3, accept: 2, repeats: 2}
joint_ranges: {q1_deg: [-90, 90], q2_mm: [10, 200]}
home: {q1_deg: 5, q2_m: 0.1}
measurement:
  sensor_from_base: {translation_mm: [100, 200, 300], rotation_deg: [0, 0, 90]}
  noise_mm: 0.1
  orientation_noise_deg: 0.02
  approach_recorded: false
  payloads_kg: [0, 2.5]
  interval_s: 20
  temperature: {lower_celsius: 20, upper_celsius: 30, period_s: 3600, reference_celsius: 22}
errors:
  geometry: [{joint: 1, a_mm: 0.4, alpha_deg: 0.1}]
  joint_errors: [{joint: 1, formula: "0.001 * SIN(theta)"}]
  backlash: [{joint: 1, width_deg: 0.02}, {joint: 2, width_mm: 0.1}]
  hysteresis: [{joint: 1, friction_rad: 0.0001, per_nm: 0.01}]
  compliance: [{joint: 1, rad_per_nm: 1e-6}, {joint: 2, m_per_n: 2e-7}]
  link_bending: [{joint: 1, x_rad_per_nm: 1e-6}]
  gear_harmonic: [{joint: 1, ratio: 71, cosine_rad: 1e-4}]
  gain: [{joint: 1, share: 1e-4}]
  eccentricity: [{joint: 1, order: 2, sine_deg: 0.01}]
  coupling: [{joint: 2, from: 1, share: 1e-5, sine_mm: 0.1}]
  axis_wobble: [{joint: 1, cosine_deg: [0.01, 0], sine_rad: [0, 1e-4]}]
  thermal_offset: [{joint: 1, rad_per_kelvin: 1e-5}]
  thermal_length: [{joint: 1, share_per_kelvin: 1.2e-5}]
  symbolic: [{joint: 1, formula: "0.0001 * SIN(q1 + 2 * q2) * s"}]
  balancer: [{joint: 1, fixed_m: 0.25, moving_m: 0.4, shortest_deg: 90, force_n: 2000, n_per_m: 15000, rad_per_nm: 1e-6}]
  drift: {mm_per_s: [0.001, 0, 0], deg_per_s: [0, 0, 1e-5]}
  sensor_scale: {share: 1e-5}
  tool_mm: [0.1, 0, -0.1]
)yaml";

/// `text` with the one occurrence of `from` replaced.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  DEMECAL_CHECK(at != std::string::npos && text.find(from, at + 1) == std::string::npos, "from=" << from);
  return text.replace(at, from.size(), to);
}

}  // namespace demecal
