#include "parameters/widening.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"

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
    const std::string subject = "joint " + std::to_string(joint + 1);
    const auto at = [&] {
      return " at " + with_decimals(unit.to_border(stop_.joints[static_cast<Eigen::Index>(joint)]), unit.decimals) +
             " " + unit.name;
    };
    add(subject, kGrowthPerRange * std::max(0.0, from_centre(range) - 0.5 * (range.upper - range.lower)) / least,
        [&] { return at() + ", measured " + range_words(range, unit); });
    const auto gaps = measured_.gaps.find(static_cast<int>(joint));
    if (gaps == measured_.gaps.end()) return;
    for (const Interval& gap : gaps->second)
      add(subject, kGrowthPerRange * std::max(0.0, 0.5 * (gap.upper - gap.lower) - from_centre(gap)) / least,
          [&] { return at() + ", measured nowhere in " + range_words(gap, unit); });
  }

  void add_outside(const std::string& subject, double value, const Interval& range, double least,
                   const BorderUnit& unit) {
    const double outside = std::max({0.0, value - range.upper, range.lower - value});
    add(subject, kGrowthPerRange * outside / std::max(range.upper - range.lower, least), [&] {
      return " at " + with_decimals(value, unit.decimals) + " " + unit.name + ", measured " + range_words(range, unit);
    });
  }

  template <typename State>
  void add_unstated(const std::string& subject, const Interval& range, const BorderUnit& unit, const State& state) {
    // A model of several targets on the tool need not hold the robot's own.
    const std::string target = robot_.tools.contains("") ? "" : robot_.tools.begin()->first;
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

Widening widening(const CorrectedRobot& robot, const MeasuredJoints& measured, const Stop& stop) {
  return StopWidening(robot, measured, stop).made();
}

}  // namespace demecal::inline parameters
