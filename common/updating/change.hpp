// Whether a robot is still as its model has it, and what has changed: a test of few new poses.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "effects/effect.hpp"

namespace demecal::inline updating {

/// As it was; the base alone stands elsewhere in the instrument's frame; or the robot has changed.
enum class ChangeVerdict { unchanged, registration, changed };
std::string_view to_string(ChangeVerdict verdict);

/// Something that may have happened to the robot.
struct ChangeCause {
  Effect effect;  ///< with its estimated coefficients
  bool is_registration = false;
  double p_value = 1.0;             ///< of this cause alone
  double p_family = 1.0;            ///< of it being the best of all that were tried
  double size = 0.0;                ///< of its coefficients of the first unit, together, SI
  double standard_error = 0.0;      ///< of that, SI
  std::string unit;                 ///< "rad", "m", ...
  double detectable = 0.0;          ///< the size that these poses find nine times in ten, SI; infinite: none
  double power = 0.0;               ///< that the size usually asked for is found: 0.3 mrad, 0.2 mm
  std::vector<std::string> rivals;  ///< causes that these poses cannot tell from it
  std::optional<double>
      by_model{};  ///< how much of it the model has, to which `size` adds; of zeros, tool, base: nothing
};

/// A zero of a joint that these poses do not show: whatever it is, the rows stay as they are.
struct UnseenZero {
  int joint = 0;         ///< from 0
  std::string sentence;  ///< for people: why, and what to do
};

/// The zero of a joint that was found to be off, beside or instead of what the temperature does to it.
struct WarmedZero {
  int joint = 0;                             ///< from 0
  std::optional<double> found_celsius{};     ///< at which it is off by as much as was found
  std::optional<double> unmoved_celsius{};   ///< at which it is where the model has it
  std::optional<double> by_model_celsius{};  ///< the reference of the model's own effect of that joint
  bool may_be_heat = false;                  ///< heat alone would do as much
};

struct ChangeReport {
  ChangeVerdict verdict = ChangeVerdict::unchanged;
  bool set_up_anew = false;           ///< the instrument's frame is another: the base was found again
  double p_any = 1.0;                 ///< of such errors by the model and its noise
  double strain = 0.0;                ///< rms of the errors over what model and noise lead one to expect
  double strain_limit = 0.0;          ///< that one unchanged robot in a thousand exceeds
  double noise_m = 0.0;               ///< per axis, as the model has it, or repeats that scatter more
  double error_m = 0.0;               ///< rms of the tool's errors by the model (base found again where it had to be)
  double left_m = 0.0;                ///< the same once what was found is taken in
  std::size_t poses = 0;              ///< repeats of one count once
  std::size_t measurements = 0;       ///< with all repeats
  std::vector<std::size_t> outliers;  ///< poses (in the data set) that were left out; of repeats, the first
  std::vector<ChangeCause> found;     ///< in the order they were found
  std::vector<ChangeCause> tried;     ///< all, the likeliest first
  double orientation_rad = 0.0;  ///< noise of orientations per axis, as these poses show it; 0: they are not judged
  std::vector<UnseenZero> unseen_zeros;   ///< by joint
  std::vector<WarmedZero> warmed;         ///< of zeros found
  std::vector<std::string> not_testable;  ///< sentences
  std::vector<std::string> lacking;       ///< sentences: what of the model poses do not let it apply
  bool unnamed = false;                   ///< changed, but by nothing that was tried
  bool more = false;                      ///< what was found leaves more than an unchanged robot would
  bool implausible = false;               ///< the check of the data takes them for those of another robot
};

/// Holds the model's predictions against all poses of `data` that measured positions or distances, repeats of one as
/// their mean; with orientations, where the model was fitted to such and these poses show how far they scatter. Errors
/// by the model's covariance and its noise are expected; what explains more than 5 % of such samples would (of all
/// causes tried) has changed. Causes are added one after another, where the robot with them really errs less; where
/// they leave most of errors that are far beyond what is expected, none is named; where they leave more than one
/// unchanged robot in a thousand would, the robot has changed whatever they are. Poses of the names `suspects` are left
/// out where they are a quarter at most. Where joints are written coarsely, and errors are left that nothing explains,
/// their rounding counts as noise; so does what effects of the model may have done at poses that do not state what
/// these depend on, and how far repeats lie apart where that is more than the model's noise. Throws InputError where
/// the poses are too few, or are not of this arm.
ChangeReport find_change(const CalibratedModel& model, const DataSet& data, const std::set<std::string>& suspects = {});

}  // namespace demecal::inline updating
