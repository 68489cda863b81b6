#include "diagnosis/implausible.hpp"

#include <cmath>
#include <cstdio>

#include "diagnosis/judgement.hpp"
#include "effects/measurement.hpp"
#include "fitting/fit.hpp"

namespace demecal {
namespace {

constexpr double kLargestTurn_rad = 0.02;  ///< gears, bearings and links that give way more are broken
constexpr double kLargestShift_m = 0.02;
constexpr double kUnitShare = 0.02;  ///< off a whole share: the arm's own errors may hide that much of it

std::string with_three_places(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

double rms_m(const DataSet& data, const std::vector<std::size_t>& poses, const CorrectedRobot& robot) {
  double squares = 0.0;
  for (const std::size_t pose : poses) squares += std::pow(tool_error_m(robot, data, data.poses[pose]), 2);
  return std::sqrt(squares / static_cast<double>(poses.size()));
}

/// The whole share, nearly, that explains most of the error where the joint turns with the other; 0 where none does.
/// Motions of radians are beyond what one linear step can tell: the arm is fitted anew to joints that are sums.
double whole_share(const Effect& effect, const DiagnosisData& of, const DiagnosedModel& model) {
  constexpr int kSteps = 12;
  constexpr double kLeft = 0.2;  ///< of the error, at most
  const int from = law_of(effect).proportional_to(effect);
  for (const double whole : {1.0, -1.0}) {
    DataSet summed = of.data;
    for (MeasuredPose& pose : summed.poses) pose.joints[effect.joint] += whole * pose.joints[from];
    const DiagnosisData with{summed, of.declared, of.fitted, of.judging};
    const Fit fit = fit_declared(summed, of.fitted, of.declared, nominal_robot(summed));
    if (fit.status != FitStatus::converged ||
        rms_m(summed, of.fitted, fit.robot) > kLeft * rms_m(of.data, of.fitted, model.robot))
      continue;
    DiagnosedModel rest = diagnosed_model(with, fit);
    rest.robot.effects.push_back(effect);
    rest.robot.effects.back().values = {0.0};
    const double share = whole + refined(with, std::move(rest), kSteps).robot.effects.back().value(0);
    if (std::abs(share - whole) < kUnitShare) return share;
  }
  return 0.0;
}

/// Controllers that report a joint against the horizontal, or through a parallelogram, give its angle as a sum.
std::string unit_coupling(const Effect& effect, double share) {
  const std::string joint = std::to_string(effect.joint + 1),
                    from = std::to_string(law_of(effect).proportional_to(effect) + 1);
  return "the data show a unit coupling: joint " + joint + " turns with joint " + from + ", by " +
         with_three_places(share) + " of its motion; that is how joint " + joint +
         " is reported, not an error of the arm: write its column as q" + joint + (share > 0 ? " + q" : " - q") + from;
}

}  // namespace

std::string implausibility(const Effect& effect, const DiagnosisData& of, const DiagnosedModel& model,
                           const std::vector<ArmState>& states) {
  const LargestMotion largest = largest_motion(effect, of.data.robot, states);
  if (largest.turn_rad <= kLargestTurn_rad && largest.shift_m <= kLargestShift_m)
    return law_of(effect).implausibility(effect);
  if (law_of(effect).proportional_to(effect) >= 0) {
    if (const double share = whole_share(effect, of, model); share != 0.0) return unit_coupling(effect, share);
  }
  return "implausibly large for a real arm (> " +
         std::string(largest.turn_rad > kLargestTurn_rad ? "20 mrad" : "20 mm") + "): check signs, units and row order";
}

}  // namespace demecal
