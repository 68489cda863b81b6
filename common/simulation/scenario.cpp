#include "simulation/scenario.hpp"

#include "data/text.hpp"
#include "errors/input_error.hpp"

namespace demecal {
namespace {

void require(bool holds, const std::string& value, const std::string& rule) {
  if (!holds) throw InputError({}, value, rule);
}

void require_joint(int joint, int joints, const std::string& key) {
  require(joint >= 0 && joint < joints, std::to_string(joint + 1),
          key + ": joint must be from 1 to " + std::to_string(joints));
}

template <typename Error>
void require_joints(const std::vector<Error>& errors, int joints, const std::string& key) {
  for (const Error& error : errors) require_joint(error.joint, joints, key);
}

void check_formulas(const Scenario& scenario, int joints) {
  for (const JointError& error : scenario.joint_errors) {
    require(is_valid(error.formula, 1), "", "joint_errors: the formula must be complete and know theta alone");
  }
  const auto symbols = static_cast<int>(symbolic_variables(joints).size());
  for (const SymbolicError& error : scenario.symbolic) {
    require(is_valid(error.formula, symbols), "",
            "symbolic: the formula must be complete and know q1 .. qn, tau, s, T");
  }
}

void check_truth(const Scenario& scenario, int joints) {
  require_joints(scenario.geometry, joints, "geometry");
  require_joints(scenario.joint_errors, joints, "joint_errors");
  require_joints(scenario.backlash, joints, "backlash");
  require_joints(scenario.compliance, joints, "compliance");
  require_joints(scenario.gear_harmonics, joints, "gear_harmonics");
  require_joints(scenario.gains, joints, "gains");
  require_joints(scenario.eccentricities, joints, "eccentricities");
  require_joints(scenario.couplings, joints, "couplings");
  for (const Coupling& error : scenario.couplings) require_joint(error.from, joints, "couplings");
  require_joints(scenario.hysteresis, joints, "hysteresis");
  require_joints(scenario.link_bending, joints, "link_bending");
  require_joints(scenario.axis_wobble, joints, "axis_wobble");
  require_joints(scenario.thermal_offsets, joints, "thermal_offsets");
  require_joints(scenario.thermal_lengths, joints, "thermal_lengths");
  require_joints(scenario.symbolic, joints, "symbolic");
  check_formulas(scenario, joints);
}

void check_poses(const Scenario& scenario, std::size_t joints) {
  const std::string number = " must be one for each of the " + std::to_string(joints) + " joints";
  const auto home = static_cast<std::size_t>(scenario.home.size());
  const bool home_needed = !scenario.by_joints && joints >= 6;
  require(home == joints || (home == 0 && !home_needed), std::to_string(home), "home: the values" + number);
  const std::size_t ranges = scenario.joint_ranges.size();
  require(ranges == 0 || ranges == joints, std::to_string(ranges), "joint_ranges: the ranges" + number);
  for (const auto& [lower, upper] : scenario.joint_ranges) {
    require(lower <= upper, number_text(lower), "joint_ranges: the lower end must not be above the upper one");
  }
  require((scenario.box_size_m.array() >= 0.0).all(), "", "box: the size must not be negative");
  for (const int count : scenario.poses) {
    require(count >= 0, std::to_string(count), "poses: the number must not be negative");
  }
  require(scenario.repeats >= 1, std::to_string(scenario.repeats), "repeats: must be 1 or more");
}

}  // namespace

void check(const Scenario& scenario) {
  const std::size_t joints = scenario.robot.chain.joints.size();
  require(joints >= 1 && joints <= static_cast<std::size_t>(kMaxJoints), std::to_string(joints),
          "robot: must have from 1 to " + std::to_string(kMaxJoints) + " joints");
  const std::size_t masses = scenario.robot.masses.size();
  require(masses == 0 || masses == joints, std::to_string(masses), "robot: links must be as many as joints");
  check_poses(scenario, joints);
  check_truth(scenario, static_cast<int>(joints));
  require(scenario.noise_m >= 0.0, number_text(scenario.noise_m), "noise: must not be negative");
  require(scenario.orientation_noise_rad >= 0.0, number_text(scenario.orientation_noise_rad),
          "orientation noise: must not be negative");
  require(scenario.seconds_per_pose >= 0.0, number_text(scenario.seconds_per_pose),
          "seconds_per_pose: must not be negative");
  require(!scenario.temperature || scenario.temperature->period_s > 0.0, "",
          "temperature: the period must be positive");
}

}  // namespace demecal
