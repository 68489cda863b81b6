// Joint angles without jumps: where a joint's data straddle +-pi they are moved onto one side (thesis 6.2.2).
#pragma once

#include <span>

namespace demecal::inline kinematics {

/// `angle_rad` moved by whole turns to within half a turn of `centre_rad`.
double wrap_near(double angle_rad, double centre_rad);

/// The branch a joint's data are unwrapped to: every datum is taken as wrap_near(angle, centre) when `wraps`.
struct AngleBranch {
  bool wraps = false;  ///< false: the data are continuous as they stand and are used unchanged
  double centre_rad = 0.0;

  double operator()(double angle_rad) const { return wraps ? wrap_near(angle_rad, centre_rad) : angle_rad; }
};

/// Chooses the branch for a revolute joint's angles: data that all lie within [-pi, pi] (a controller that reports
/// quadrants) and whose widest empty arc does not contain +-pi are re-centred opposite to that arc; data beyond +-pi
/// come from a controller that counts turns and stay as they are.
AngleBranch choose_branch(std::span<const double> angles_rad);

/// The same where the joint's limits are known. Limits less than a turn apart say by themselves where the joint moves,
/// however its data happen to be spread: it does not wrap if they lie within [-pi, pi], and is centred between them
/// otherwise. Limits that are equal (not given) or wider say nothing, and the data decide.
AngleBranch choose_branch(std::span<const double> angles_rad, double lower_rad, double upper_rad);

}  // namespace demecal::inline kinematics
