#include "simulation/scenario.hpp"

#include <cstddef>
#include <utility>

#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"

namespace demecal::inline simulation {
namespace {

void require(bool holds, const std::string& value, const std::string& rule) {
  if (!holds) throw InputError({}, value, rule);
}

void require_joint(int joint, int joints, const std::string& key) {
  require(joint >= 0 && joint < joints, std::to_string(joint + 1),
          key + ": joint must be from 1 to " + std::to_string(joints));
}

/// Visits the fields of an error, and refuses what contradicts the robot.
class ErrorCheck {
 public:
  ErrorCheck(std::string key, int joints) : key_(std::move(key)), joints_(joints) {}

  int joints() const { return joints_; }
  void joint(const char* /*key*/, int joint) const { require_joint(joint, joints_, key_); }
  void formula(const char* /*key*/, const Tree& formula, const VariableNames& names) const {
    require(is_valid(formula, static_cast<int>(names.size())), "",
            key_ + ": the formula must be complete and know " +
                (names.size() == 1 ? "theta alone" : "q1 .. qn, tau, s, T"));
  }
  void number(const char*, double) const {}
  void optional(const char*, double) const {}
  void positive(const char*, double) const {}
  void order(const char*, int) const {}
  void motion(const char*, double) const {}
  void optional_motion(const char*, double) const {}
  void per_load(const char*, const char*, double) const {}
  void tilts(const char*, const Eigen::Vector2d&) const {}

 private:
  std::string key_;
  int joints_;
};

void check_truth(const Scenario& scenario, int joints) {
  visit_joint_errors(scenario, [joints](const char* key, const auto& errors) {
    for (auto error : errors) {
      require_joint(error.joint, joints, key);
      if constexpr (requires { error.visit_fields(ErrorCheck(key, joints)); }) {
        error.visit_fields(ErrorCheck(key, joints));
      }
    }
  });
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

void check_contacts(const Scenario& scenario) {
  if (scenario.touched.empty()) return;
  require(scenario.sensor_from_base.matrix().isIdentity(0.0), "",
          "contacts: nothing measures where the base stands; leave sensor_from_base out");
  require(!scenario.orientation_measured, "", "contacts: no instrument measures orientation");
  require(scenario.play_m >= 0.0, number_text(scenario.play_m), "play: must not be negative");
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
  check_contacts(scenario);
  require(scenario.noise_m >= 0.0, number_text(scenario.noise_m), "noise: must not be negative");
  require(scenario.orientation_noise_rad >= 0.0, number_text(scenario.orientation_noise_rad),
          "orientation noise: must not be negative");
  require(scenario.seconds_per_pose >= 0.0, number_text(scenario.seconds_per_pose),
          "seconds_per_pose: must not be negative");
  require(!scenario.temperature || scenario.temperature->period_s > 0.0, "",
          "temperature: the period must be positive");
}

}  // namespace demecal::inline simulation
