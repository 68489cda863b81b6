#include "parameters/widening.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "effects/effect.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "parameters/posterior.hpp"

namespace demecal::inline parameters {
namespace {

constexpr double kWorthNaming = 0.02;  ///< of growth
constexpr double kUnstatedWorthNaming_m = 1e-6;

/// With so many decimals at most.
std::string with_decimals(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return number_text(std::round(value * scale) / scale + 0.0);
}

struct BorderUnit {
  const char* name;
  double (*to_border)(double);
  int decimals;
};

double as_it_is(double value) {
  return value;
}

std::string range_words(const Interval& range, const BorderUnit& unit) {
  return with_decimals(unit.to_border(range.lower), unit.decimals) + " .. " +
         with_decimals(unit.to_border(range.upper), unit.decimals) + " " + unit.name;
}

HeldPart held_correction(const JointCorrection& correction, int joint) {
  constexpr int kParts = 128;
  const Interval& range = correction.range_rad();
  const double part = (range.upper - range.lower) / kParts;
  HeldPart held{joint};
  if (part <= 0.0) return held;
  double before = correction(range.lower), least = before, most = before;
  for (int i = 1; i <= kParts; ++i) {
    const double value = correction(std::min(range.lower + i * part, range.upper));
    held.steepest = std::max(held.steepest, std::abs(value - before) / part);
    least = std::min(least, value);
    most = std::max(most, value);
    before = value;
  }
  held.span = most - least;
  return held;
}

class StopWidening {
 public:
  StopWidening(const CorrectedRobot& robot, const MeasuredJoints& measured, const Stop& stop)
      : robot_(robot), measured_(measured), stop_(stop) {}

  Widening made() {
    for (std::size_t joint = 0;
         joint < measured_.ranges.size() && joint < static_cast<std::size_t>(stop_.joints.size()); ++joint)
      add_joint(joint);
    constexpr BorderUnit kKilograms{"kg", as_it_is, 3}, kCelsius{"°C", as_it_is, 1};
    if (robot_.payloads_kg) {
      if (stop_.payload_stated)
        add_outside("payload", stop_.payload_kg, *robot_.payloads_kg, kLeastPayloadRange, kKilograms);
      else
        add_unstated("payload", *robot_.payloads_kg, kKilograms,
                     [](Stop& stop, double payload_kg) { stop.payload_kg = payload_kg; });
    }
    if (robot_.temperatures_celsius) {
      if (stop_.temperature_celsius)
        add_outside("temperature", *stop_.temperature_celsius, *robot_.temperatures_celsius, kLeastTemperatureRange,
                    kCelsius);
      else
        add_unstated("temperature", *robot_.temperatures_celsius, kCelsius,
                     [](Stop& stop, double celsius) { stop.temperature_celsius = celsius; });
    }
    return std::move(widening_);
  }

 private:
  /// `rest`: of the sentence, behind its subject; asked for where it is needed.
  template <typename Rest>
  void add(const std::string& subject, double growth, const Rest& rest) {
    widening_.factor += growth;
    if (growth > kWorthNaming) widening_.reasons.push_back({subject, subject + rest(), growth, 0.0});
  }

  void add_joint(std::size_t joint) {
    const bool turns = robot_.chain.joints[joint].type == JointType::revolute;
    const BorderUnit unit = turns ? BorderUnit{"deg", degrees, 1} : BorderUnit{"mm", millimetres, 1};
    const auto from_centre = [&](const Interval& range) {
      const double away = stop_.joints[static_cast<Eigen::Index>(joint)] - 0.5 * (range.lower + range.upper);
      return std::abs(turns ? std::remainder(away, kTurn_rad) : away);
    };
    const Interval& range = measured_.ranges[joint];
    const double least = std::max(range.upper - range.lower, kLeastJointRange);
    const double outside = std::max(0.0, from_centre(range) - 0.5 * (range.upper - range.lower));
    const double off_by = outside > 0.0 ? add_held(static_cast<int>(joint), outside) : 0.0;
    const std::string subject = "joint " + std::to_string(joint + 1);
    const auto at = [&] {
      return " at " + with_decimals(unit.to_border(stop_.joints[static_cast<Eigen::Index>(joint)]), unit.decimals) +
             " " + unit.name;
    };
    add(subject, kGrowthPerRange * outside / least, [&] {
      const std::string measured = at() + ", measured " + range_words(range, unit);
      if (off_by == 0.0) return measured;
      return measured + ", where its motion may be off by " + with_decimals(1e3 * off_by, 2) +
             (turns ? " mrad" : " mm");
    });
    if (const double unsure = add_unsure(static_cast<int>(joint)); unsure > 0.0)
      widening_.reasons.push_back({subject,
                                   subject + at() + ", where it jumps by " + with_decimals(1e3 * unsure, 2) +
                                       (turns ? " mrad" : " mm") + ": on which side it is, the poses did not tell",
                                   0.0, 0.0});
    const auto gaps = measured_.gaps.find(static_cast<int>(joint));
    if (gaps == measured_.gaps.end()) return;
    for (const Interval& gap : gaps->second)
      add(subject, kGrowthPerRange * std::max(0.0, 0.5 * (gap.upper - gap.lower) - from_centre(gap)) / least,
          [&] { return at() + ", measured nowhere in " + range_words(gap, unit); });
  }

  /// A joint's motion that may be off: two standard deviations.
  struct OffBy {
    int joint;
    double most;
  };

  /// What is held where the joint stands so far outside; by how much its own motion may be off.
  double add_held(int of_joint, double outside) {
    std::vector<OffBy> held;
    for (const HeldPart& part : held_parts(robot_, of_joint)) held.push_back({part.joint, part.off_by(outside)});
    return add_off_by(held, of_joint);
  }

  /// What jumps where the joint may stand on either side; by how much its own motion may be off.
  double add_unsure(int joint) {
    std::vector<OffBy> unsure;
    for (const Effect& effect : robot_.effects)
      if (effect.joint == joint)
        if (const double most = law_of(effect).unsure_motion(effect, stop_.joints[joint]); most > 0.0)
          unsure.push_back({joint, most});
    return add_off_by(unsure, joint);
  }

  double add_off_by(const std::vector<OffBy>& motions, int of_joint) {
    if (motions.empty()) return 0.0;
    const Eigen::Vector3d tool_m = robot_.tool(own_target()).translation();
    const Jacobian drives = differential_kinematics(robot_.chain, robot_.actual_joints(stop_), tool_m).drives;
    const Eigen::Matrix3d& base = robot_.sensor_from_base.linear();
    double own_square = 0.0;
    for (const auto& [joint, most] : motions) {
      if (joint == of_joint) own_square += most * most;
      Eigen::Matrix<double, 6, 1> motion;
      motion << base * drives.col(joint).head<3>(), base * drives.col(joint).tail<3>();
      motion *= most / kCoverageFactor;
      widening_.held_covariance += motion * motion.transpose();
    }
    return std::sqrt(own_square);
  }

  /// A model of several targets on the tool need not hold the robot's own.
  std::string own_target() const { return robot_.tools.contains("") ? "" : robot_.tools.begin()->first; }

  void add_outside(const std::string& subject, double value, const Interval& range, double least,
                   const BorderUnit& unit) {
    const double outside = std::max({0.0, value - range.upper, range.lower - value});
    add(subject, kGrowthPerRange * outside / std::max(range.upper - range.lower, least), [&] {
      return " at " + with_decimals(value, unit.decimals) + " " + unit.name + ", measured " + range_words(range, unit);
    });
  }

  template <typename State>
  void add_unstated(const std::string& subject, const Interval& range, const BorderUnit& unit, const State& state) {
    const std::string target = own_target();
    const Eigen::Vector3d taken_m = robot_.predict(stop_, target).translation();
    double most_m = 0.0;
    for (const double end : {range.lower, range.upper}) {
      Stop stated = stop_;
      state(stated, end);
      most_m = std::max(most_m, (robot_.predict(stated, target).translation() - taken_m).norm());
    }
    widening_.unstated_m += most_m;
    if (most_m > kUnstatedWorthNaming_m)
      widening_.reasons.push_back({subject,
                                   subject + " not stated, measured " + range_words(range, unit) + ": " +
                                       with_decimals(millimetres(most_m), 3) + " mm",
                                   0.0, most_m});
  }

  const CorrectedRobot& robot_;
  const MeasuredJoints& measured_;
  const Stop& stop_;
  Widening widening_;
};

}  // namespace

std::vector<std::string> Widening::sentences() const {
  std::vector<std::string> all;
  for (const WideningReason& reason : reasons) all.push_back(reason.sentence);
  return all;
}

double Widening::held_radius_m() const {
  return kCoverageFactor * std::sqrt(held_covariance.topLeftCorner<3, 3>().trace());
}

bool Widening::is_worth_flagging(double own_m) const {
  return std::hypot(factor * own_m, held_radius_m()) > kWorthFlagging * own_m;
}

std::vector<HeldPart> held_parts(const CorrectedRobot& robot, int of_joint) {
  std::vector<HeldPart> parts;
  const JointCorrection& correction = robot.corrections[static_cast<std::size_t>(of_joint)];
  if (!correction.is_neutral()) parts.push_back(held_correction(correction, of_joint));
  for (const Effect& effect : robot.effects) {
    if (!effect.ranges.contains(of_joint)) continue;
    const std::optional<HeldMotion> held = law_of(effect).held_motion(effect);
    if (held && held->of_joint == of_joint) parts.push_back({effect.joint, held->steepest, held->span});
  }
  std::erase_if(parts, [](const HeldPart& part) { return part.steepest == 0.0; });
  return parts;
}

Widening widening(const CorrectedRobot& robot, const MeasuredJoints& measured, const Stop& stop) {
  return StopWidening(robot, measured, stop).made();
}

}  // namespace demecal::inline parameters
