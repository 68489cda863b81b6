#include "diagnosis/evidence.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace demecal {
namespace {

constexpr double kVaried = 1e-9;

struct Course {
  bool everywhere = true;
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();
  double sum = 0.0;

  void take(const std::optional<double>& value) {
    if (!value) {
      everywhere = false;
      return;
    }
    lower = std::min(lower, *value);
    upper = std::max(upper, *value);
    sum += *value;
  }
  bool varied() const { return everywhere && upper - lower > kVaried; }
};

bool came_from_both_sides(const DataSet& data, std::span<const std::size_t> poses) {
  std::vector<bool> up(data.robot.chain.joints.size()), down(up.size());
  for (const std::size_t pose : poses) {
    if (!data.poses[pose].approach) continue;
    for (std::size_t i = 0; i < up.size(); ++i) {
      const double sign = (*data.poses[pose].approach)[static_cast<Eigen::Index>(i)];
      up[i] = up[i] || sign > 0;
      down[i] = down[i] || sign < 0;
    }
  }
  for (std::size_t i = 0; i < up.size(); ++i) {
    if (up[i] && down[i]) return true;
  }
  return false;
}

}  // namespace

Evidence evidence_of(const DataSet& data, std::span<const std::size_t> poses) {
  Evidence evidence;
  Course payload, temperature, time;
  std::vector<Course> joints(data.robot.chain.joints.size());
  for (const std::size_t index : poses) {
    const MeasuredPose& pose = data.poses[index];
    payload.take(pose.payload_kg);
    temperature.take(pose.temperature_celsius);
    time.take(pose.time_s);
    evidence.orientation = evidence.orientation || pose.orientation.has_value();
    for (std::size_t i = 0; i < joints.size(); ++i) joints[i].take(pose.joints[static_cast<Eigen::Index>(i)]);
  }
  evidence.approach = came_from_both_sides(data, poses);
  evidence.payload = payload.varied();
  evidence.temperature = temperature.varied();
  evidence.time = time.varied();
  evidence.masses = !data.robot.masses.empty();
  for (const Course& joint : joints) evidence.joint_ranges.push_back({joint.lower, joint.upper});
  const auto count = static_cast<double>(poses.size());
  if (evidence.temperature) evidence.mean_temperature_celsius = temperature.sum / count;
  if (evidence.time) evidence.mean_time_s = time.sum / count;
  return evidence;
}

std::vector<Unseen> unseen_kinds(const Evidence& evidence, const std::vector<std::string>& kinds) {
  std::vector<Unseen> unseen;
  const auto add_lacking = [&](Circumstance circumstance, bool recorded, const char* reason) {
    if (recorded) return;
    for (const EffectLaw* law : catalogue()) {
      const bool wanted = kinds.empty() || std::find(kinds.begin(), kinds.end(), law->kind()) != kinds.end();
      if (wanted && law->prerequisite() == circumstance) unseen.push_back({std::string(law->kind()), reason});
    }
  };
  add_lacking(Circumstance::approach, evidence.approach, "no approach columns, or every joint always came from one side");
  add_lacking(Circumstance::temperature, evidence.temperature, "no temperature column, or one temperature only");
  add_lacking(Circumstance::time, evidence.time, "no time column");
  add_lacking(Circumstance::masses, evidence.masses, "no link masses in the robot's file");
  return unseen;
}

}  // namespace demecal
