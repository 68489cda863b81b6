#include "diagnosis/experiments.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "effects/law_terms.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

constexpr int kPoses = 200;             ///< of every experiment
constexpr double kOwnPayload_kg = 2.0;  ///< where none was recorded
constexpr double kStep_kelvin = 10.0;
constexpr double kWorthwhile = 1.1;  ///< range within the limits over the measured one

class Drafting {
 public:
  Drafting(const DiagnosisData& of, RandomStream random)
      : of_(of), feasible_(of.data, of.fitted), random_(std::move(random)) {}

  /// A pose at hand sent elsewhere.
  MeasuredPose somewhere(const std::vector<Interval>& ranges) {
    MeasuredPose pose = of_.data.poses[of_.fitted[random_.index(of_.fitted.size())]];
    pose.joints = feasible_.draw(ranges, random_);
    return pose;
  }

  Experiment more() {
    Experiment experiment{"more ", " at joints drawn at random from their measured ranges", 1, -1, {}};
    for (int i = 0; i < kPoses; ++i) experiment.stops.push_back(somewhere(feasible_.measured()));
    return experiment;
  }

  /// Pairs of stops that differ in what `change` does to the first and to the second.
  template <typename Change>
  Experiment pairs(std::string after, const Change& change) {
    Experiment experiment{"", std::move(after), 2, -1, {}};
    for (int i = 0; i < kPoses; ++i) {
      const MeasuredPose pose = somewhere(feasible_.measured());
      for (const bool second : {false, true}) change(experiment.stops.emplace_back(pose), second);
    }
    return experiment;
  }

  Experiment both_sides(int joint) {
    const Eigen::Index n = of_.data.robot.chain.size();
    return pairs(" approached from both sides of joint " + std::to_string(joint + 1), [&](MeasuredPose& pose, bool up) {
      if (!pose.approach) pose.approach = ApproachSigns::Zero(n);
      (*pose.approach)[joint] = up ? 1.0 : -1.0;
    });
  }

  Experiment payload() {
    double most_kg = 0.0;
    for (const std::size_t i : of_.fitted) most_kg = std::max(most_kg, of_.data.poses[i].payload_kg.value_or(0.0));
    const double mass_kg = most_kg > 0 ? most_kg : kOwnPayload_kg;
    return pairs(" measured both without and with a payload of " + rounded_text(mass_kg) + " kg",
                 [&](MeasuredPose& pose, bool laden) { pose.payload_kg = laden ? mass_kg : 0.0; });
  }

  Experiment heat() {
    return pairs(" measured both as warm as the present ones and " + rounded_text(kStep_kelvin) + " K warmer",
                 [&](MeasuredPose& pose, bool warmer) {
                   if (warmer && pose.temperature_celsius) *pose.temperature_celsius += kStep_kelvin;
                 });
  }

  bool can_widen(int joint) const {
    const auto at = static_cast<std::size_t>(joint);
    const Interval &may = feasible_.allowed()[at], &did = feasible_.measured()[at];
    const double both = std::max(may.upper, did.upper) - std::min(may.lower, did.lower);
    return both > kWorthwhile * (did.upper - did.lower);
  }

  Experiment wider(int joint) {
    const auto at = static_cast<std::size_t>(joint);
    std::vector<Interval> ranges = feasible_.measured();
    const Interval did = ranges[at], may = feasible_.allowed()[at];
    ranges[at] = {std::min(may.lower, did.lower), std::max(may.upper, did.upper)};
    Experiment experiment{"",
                          " with joint " + std::to_string(joint + 1) + " anywhere from " + words(joint, ranges[at]) +
                              ", not only from " + words(joint, did),
                          1,
                          joint,
                          {}};
    for (int i = 0; i < kPoses; ++i) experiment.stops.push_back(somewhere(ranges));
    return experiment;
  }

 private:
  std::string words(int joint, const Interval& range) const {
    const bool turns = is_revolute(of_.data.robot.chain, joint);
    const auto number = [&](double value) {
      return rounded_text(std::round(turns ? degrees(value) : millimetres(value)));
    };
    return number(range.lower) + " to " + number(range.upper) + (turns ? " deg" : " mm");
  }

  const DiagnosisData& of_;
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

std::vector<Experiment> experiments(const DiagnosisData& of, const std::vector<Effect>& asked, RandomStream random) {
  const auto any = [&](const auto& has) {
    return std::ranges::any_of(of.fitted, [&](std::size_t i) { return has(of.data.poses[i]); });
  };
  Drafting draft(of, std::move(random));
  std::vector<Experiment> all{draft.more()};
  if (any([](const MeasuredPose& pose) { return pose.approach.has_value(); })) {
    for (const int joint : joints_of(asked)) all.push_back(draft.both_sides(joint));
  }
  all.push_back(draft.payload());
  for (int joint = 0; joint < of.data.robot.chain.size(); ++joint) {
    if (draft.can_widen(joint)) all.push_back(draft.wider(joint));
  }
  if (any([](const MeasuredPose& pose) { return pose.temperature_celsius.has_value(); })) all.push_back(draft.heat());
  return all;
}

}  // namespace demecal
