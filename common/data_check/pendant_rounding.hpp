// How far readings of a controller's display may be off by the digits that it shows, and what those that agree leave
// open.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {

/// Where all joints are written to a tenth of a degree or whole degrees, to a thousandth or a hundredth of a radian, or
/// positions to a tenth of a millimetre or more (a millimetre: metres of three decimals), points may stand off by what
/// these digits leave; else by kPendantRounding_m.
class PendantRounding {
 public:
  explicit PendantRounding(const DataSet& data);

  bool is_coarse() const { return !rms_m_.empty(); }
  /// From here on points may stand off by what the digits leave; before, by what joints that were sent to round values
  /// do.
  void believe(bool digits) { believed_ = digits && is_coarse(); }
  bool is_believed() const { return believed_; }

  /// Whether the rows of a trial may be off by so much.
  bool accepts(const std::vector<double>& errors_m, const std::vector<TrialRow>& rows) const;
  /// What a point is off by, root mean square over the poses; kPendantRounding_m where digits are not believed.
  double typical_m() const;
  /// The angle below which nothing is told of frames and zeros.
  double told_rad() const;
  /// To what the readings are written, and what differences that hides.
  std::string sentence() const;

 private:
  void set_angle_digit(const Chain& chain, const std::vector<JointVector>& joints);

  bool in_radians_ = false;                                   ///< angles are written so
  double step_rad_ = 0.0, slide_m_ = 0.0, position_m_ = 0.0;  ///< 0: written finer
  std::vector<double> rms_m_, most_m_;                        ///< of each pose
  bool believed_ = false;
};

/// What poses that agree leave open, a sentence each; `told_m`: what a point must move by to be told.
std::vector<std::string> left_open(const DataSet& data, double told_m);

}  // namespace demecal::inline data_check
