// How much less a model is to be believed at one stop than where it was measured: joints, payload and temperature
// together, with the reasons in words.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "effects/arm_state.hpp"
#include "expression/bound.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline parameters {

/// Where joints stood in the measured poses, rad or m.
struct MeasuredJoints {
  std::span<const Interval> ranges;                  ///< of every joint; none where the model does not say
  const std::map<int, std::vector<Interval>>& gaps;  ///< inside these, of joints, from 0: where none of them stood
};

/// One thing that makes a radius larger.
struct WideningReason {
  std::string subject;      ///< "joint 2", "payload", "temperature"
  std::string sentence;     ///< "joint 2 at 63.0 deg, measured -60.0 .. 60.0 deg"
  double growth = 0.0;      ///< what it adds to the factor; 0 of what is not stated
  double unstated_m = 0.0;  ///< of what is not stated
};

struct Widening {
  double factor = 1.0;  ///< by which the model's part of an error is taken to be larger
  /// Beside that, of the tool's position and turn (m, rad; measurements' frame): by what corrections and effects may be
  /// off that are held at the ends of measured ranges, or jump where the poses did not tell.
  Eigen::Matrix<double, 6, 6> held_covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double unstated_m = 0.0;  ///< how far the tool may stand from its prediction by what the stop does not state
  std::vector<WideningReason> reasons{};

  /// Their sentences.
  std::vector<std::string> sentences() const;
  /// Of held_covariance: the radius that holds the position 95 % of the time, m.
  double held_radius_m() const;
  /// Whether a radius that is `own_m` where the arm was measured is clearly larger.
  bool is_worth_flagging(double own_m) const;
};

/// All that the model holds at the ends of the measured range of joint `of_joint`, from 0: its correction, which may go
/// on as steeply as it is at its steepest inside and goes no farther than it spans there, and effects (HeldMotion).
struct HeldPart {
  int joint = 0;  ///< that it moves, from 0
  double steepest = 0.0, span = 0.0;

  double off_by(double outside) const { return std::min(steepest * outside, span); }
};
std::vector<HeldPart> held_parts(const CorrectedRobot& robot, int of_joint);

/// The growth by a way outside that is as long as the range of what was measured, or as the least that counts for one.
inline constexpr double kGrowthPerRange = 2.0;
inline constexpr double kLeastJointRange = 0.2;         ///< rad or m
inline constexpr double kLeastPayloadRange = 1.0;       ///< kg
inline constexpr double kLeastTemperatureRange = 10.0;  ///< K: halls warm by so much

/// Of a factor: what is less is not worth a flag.
inline constexpr double kWorthFlagging = 1.1;

/// Factors grow with the way outside of what was measured, in shares of its range, and add up: of joints outside their
/// ranges or inside of gaps (whole turns aside), of a payload or a temperature outside those that poses stated. Nothing
/// was seen there: the growth is a judgement, not a measurement. What corrections and effects may be off by outside
/// comes beside them (see HeldPart; two standard deviations). What the stop does not state may be anything that was
/// measured, as far as the robot's effects depend on it.
Widening widening(const CorrectedRobot& robot, const MeasuredJoints& measured, const Stop& stop);

}  // namespace demecal::inline parameters
