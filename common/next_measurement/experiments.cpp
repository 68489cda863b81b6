#include "next_measurement/experiments.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "effects/arm_state.hpp"
#include "effects/law_terms.hpp"
#include "errors/check.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline next_measurement {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kBelow_m = 0.05;
constexpr double kBeyond = 0.1;
constexpr int kAttempts = 500;

Eigen::Vector3d upwards(const Eigen::Vector3d& gravity_mps2) {
  if (gravity_mps2.isZero()) return Eigen::Vector3d::UnitZ();
  return -gravity_mps2.normalized();
}

/// Height of the lowest of the arm's joints but the first, and of its flange, m.
double lowest_of(const ArmState& state, const Eigen::Vector3d& up) {
  double lowest = kInfinite;
  for (std::size_t i = 1; i < state.places.size(); ++i)
    lowest = std::min(lowest, up.dot(state.places[i].translation()));
  return lowest;
}

constexpr int kPoses = 200;             ///< of every experiment
constexpr double kOwnPayload_kg = 2.0;  ///< where none was recorded
constexpr double kStep_kelvin = 10.0;
constexpr double kWorthwhile = 1.1;  ///< range within the limits over the measured one

class ExperimentDesign {
 public:
  ExperimentDesign(const DiagnosisProblem& problem, RandomStream random)
      : problem_(problem), feasible_(problem.data, problem.fitted), random_(std::move(random)) {}

  /// A pose at hand sent elsewhere.
  MeasuredPose random_stop(const std::vector<Interval>& ranges) {
    MeasuredPose pose = problem_.data.poses[problem_.fitted[random_.index(problem_.fitted.size())]];
    pose.joints = feasible_.draw(ranges, random_);
    pose.torque = std::nullopt;
    return pose;
  }

  Experiment more_poses() {
    Experiment experiment{"more ", " at joints drawn at random from their measured ranges", 1, -1, {}};
    for (int i = 0; i < kPoses; ++i) experiment.stops.push_back(random_stop(feasible_.measured()));
    return experiment;
  }

  /// Pairs of stops that differ in what `change` does to the first and to the second.
  template <typename Change>
  Experiment pairs(std::string after, const Change& change) {
    Experiment experiment{"", std::move(after), 2, -1, {}};
    for (int i = 0; i < kPoses; ++i) {
      const MeasuredPose pose = random_stop(feasible_.measured());
      for (const bool second : {false, true}) change(experiment.stops.emplace_back(pose), second);
    }
    return experiment;
  }

  Experiment from_both_sides(int joint) {
    const Eigen::Index n = problem_.data.robot.chain.size();
    return pairs(" approached from both sides of joint " + std::to_string(joint + 1), [&](MeasuredPose& pose, bool up) {
      if (!pose.approach) pose.approach = ApproachSigns::Zero(n);
      (*pose.approach)[joint] = up ? 1.0 : -1.0;
    });
  }

  Experiment with_payload() {
    double most_kg = 0.0;
    for (const std::size_t i : problem_.fitted)
      most_kg = std::max(most_kg, problem_.data.poses[i].payload_kg.value_or(0.0));
    const double mass_kg = most_kg > 0 ? most_kg : kOwnPayload_kg;
    return pairs(" measured both without and with a payload of " + rounded_text(mass_kg) + " kg",
                 [&](MeasuredPose& pose, bool laden) { pose.payload_kg = laden ? mass_kg : 0.0; });
  }

  Experiment temperature_step() {
    return pairs(" measured both as warm as the present ones and " + rounded_text(kStep_kelvin) + " K warmer",
                 [&](MeasuredPose& pose, bool warmer) {
                   if (warmer && pose.temperature_celsius) *pose.temperature_celsius += kStep_kelvin;
                 });
  }

  bool can_widen(int joint) const {
    const auto index = static_cast<std::size_t>(joint);
    const Interval &allowed_range = feasible_.allowed()[index], &measured_range = feasible_.measured()[index];
    const double both =
        std::max(allowed_range.upper, measured_range.upper) - std::min(allowed_range.lower, measured_range.lower);
    return both > kWorthwhile * (measured_range.upper - measured_range.lower);
  }

  Experiment with_wider_range(int joint) {
    const auto index = static_cast<std::size_t>(joint);
    std::vector<Interval> ranges = feasible_.measured();
    const Interval measured_range = ranges[index], allowed_range = feasible_.allowed()[index];
    ranges[index] = {std::min(allowed_range.lower, measured_range.lower),
                     std::max(allowed_range.upper, measured_range.upper)};
    Experiment experiment{"",
                          " with joint " + std::to_string(joint + 1) + " anywhere from " + words(joint, ranges[index]) +
                              ", not only from " + words(joint, measured_range),
                          1,
                          joint,
                          {}};
    for (int i = 0; i < kPoses; ++i) experiment.stops.push_back(random_stop(ranges));
    return experiment;
  }

 private:
  std::string words(int joint, const Interval& range) const {
    const bool turns = is_revolute(problem_.data.robot.chain, joint);
    const auto number = [&](double value) {
      return rounded_text(std::round(turns ? degrees(value) : millimetres(value)));
    };
    return number(range.lower) + " to " + number(range.upper) + (turns ? " deg" : " mm");
  }

  const DiagnosisProblem& problem_;
  FeasiblePoses feasible_;
  RandomStream random_;
};

/// The joints that the effects are of, or come from.
std::set<int> joints_of(const std::vector<Effect>& effects) {
  std::set<int> joints;
  for (const Effect& effect : effects) {
    if (effect.joint >= 0) joints.insert(effect.joint);
    const auto from = effect.settings.find("from");
    if (from != effect.settings.end()) joints.insert(static_cast<int>(from->second) - 1);
  }
  return joints;
}

}  // namespace

FeasiblePoses::FeasiblePoses(const DataSet& data, std::span<const std::size_t> poses)
    : data_(data),
      measured_(data.robot.chain.joints.size(), Interval{kInfinite, -kInfinite}),
      up_(upwards(data.robot.gravity_mps2)),
      lowest_tool_m_(kInfinite),
      lowest_m_(kInfinite),
      nearest_m_(kInfinite),
      farthest_m_(0.0) {
  DEMECAL_CHECK(!poses.empty(), "no poses");
  for (const std::size_t pose : poses) {
    const JointVector& joints = joints_.emplace_back(data.poses[pose].joints);
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      const double value = joints[static_cast<Eigen::Index>(i)];
      measured_[i] = {std::min(measured_[i].lower, value), std::max(measured_[i].upper, value)};
    }
    const ArmState state = arm_state(data.robot, Stop(joints));
    const double height = up_.dot(state.payload_point_m), reach = state.payload_point_m.norm();
    lowest_tool_m_ = std::min(lowest_tool_m_, height);
    lowest_m_ = std::min({lowest_m_, height, lowest_of(state, up_)});
    nearest_m_ = std::min(nearest_m_, reach);
    farthest_m_ = std::max(farthest_m_, reach);
  }
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    const Joint& joint = data.robot.chain.joints[i];
    const double margin = kLimitMargin * (joint.upper - joint.lower);
    allowed_.push_back(margin > 0 ? Interval{joint.lower + margin, joint.upper - margin} : measured_[i]);
  }
}

bool FeasiblePoses::contains(const JointVector& joints) const {
  const ArmState state = arm_state(data_.robot, Stop(joints));
  const double reach = state.payload_point_m.norm();
  return up_.dot(state.payload_point_m) >= lowest_tool_m_ - kBelow_m && lowest_of(state, up_) >= lowest_m_ - kBelow_m &&
         reach <= (1.0 + kBeyond) * farthest_m_ && reach >= (1.0 - kBeyond) * nearest_m_;
}

JointVector FeasiblePoses::draw(const std::vector<Interval>& ranges, RandomStream& random) const {
  JointVector joints(static_cast<Eigen::Index>(ranges.size()));
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      joints[static_cast<Eigen::Index>(i)] = random.real(ranges[i].lower, ranges[i].upper);
    }
    if (contains(joints)) return joints;
  }
  return joints_[random.index(joints_.size())];
}

std::vector<Experiment> experiments(const DiagnosisProblem& problem, const std::vector<Effect>& asked,
                                    RandomStream random) {
  const auto any = [&](const auto& has) {
    return std::ranges::any_of(problem.fitted, [&](std::size_t i) { return has(problem.data.poses[i]); });
  };
  ExperimentDesign design(problem, std::move(random));
  std::vector<Experiment> all{design.more_poses()};
  if (any([](const MeasuredPose& pose) { return pose.approach.has_value(); })) {
    for (const int joint : joints_of(asked)) all.push_back(design.from_both_sides(joint));
  }
  all.push_back(design.with_payload());
  for (int joint = 0; joint < problem.data.robot.chain.size(); ++joint) {
    if (design.can_widen(joint)) all.push_back(design.with_wider_range(joint));
  }
  if (any([](const MeasuredPose& pose) { return pose.temperature_celsius.has_value(); }))
    all.push_back(design.temperature_step());
  return all;
}

}  // namespace demecal::inline next_measurement
