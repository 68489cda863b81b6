// Which of the causes that were found one after another are named: those that really explain what changed.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"
#include "updating/change.hpp"
#include "updating/change_rows.hpp"

namespace demecal::inline updating {

/// Causes found so far.
struct ChangeStep {
  std::vector<ChangeCause> found;
  ChangeRows left;               ///< by them, to first order
  double strain = 0.0;           ///< of the robot with them
  double strain_before = 0.0;    ///< without the last, by the same noise
  double left_m = 0.0;           ///< rms of the tool's errors by the robot with them
  double orientation_rad = 0.0;  ///< noise of orientations as it is then; 0: they are not compared
};

/// Root mean square of rows of unit variance.
double strain_of(const ChangeRows& rows);

/// Whether the robot with the last cause errs less than without it (`before_m`), and not only to first order.
bool really_leaves_less(const ChangeStep& step, double before_m);

/// What an unchanged robot would leave.
struct ExpectedErrors {
  double strain_limit = 0.0;  ///< that one in a thousand exceeds
  double rms_m = 0.0;         ///< of the tool's errors
};

/// The step whose causes are named, the first being that of none. Where errors beyond the limit are left, a cause that
/// lowered them by less than a quarter is not; where most is left of errors that are far beyond it, none is: a joint's
/// sign, or rows of two sets, look like a little of everything.
std::size_t named_step(const std::vector<ChangeStep>& steps, const ExpectedErrors& expected);

/// By pose, what all causes together leave of its rows; empty where they are too few for that.
std::vector<double> norms_beyond_causes(const ChangeRows& rows);

/// The robot with its base found again, where the data are in another frame.
std::optional<CorrectedRobot> set_up_anew(const CorrectedRobot& robot, const DataSet& data,
                                          const std::vector<std::size_t>& poses);

}  // namespace demecal::inline updating
