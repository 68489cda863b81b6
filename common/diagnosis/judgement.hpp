// Whether a candidate is real: on validation poses, under resampling, and by how far it would move the arm.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "parameters/observation.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline diagnosis {

/// The tool error of every validation pose, mm, less what it shares with its neighbours: of its position rows or, where
/// there are none, the root mean square of all.
std::vector<double> tool_errors_mm(const ResidualField& field, const Eigen::VectorXd& left, const RowScales& scales,
                                   const DataSet& data);

/// The same of everything a pose measured, whitened: as far off as position alone would be were all its rows positions.
std::vector<double> pose_errors_mm(const ResidualField& field, const Eigen::VectorXd& left, const RowScales& scales);

/// What the validation poses say of a change of the model.
struct Confirmation {
  double share = 0.0;  ///< of the change that their residuals bear out; above one half their errors decrease
  double lower = 0.0;  ///< its one-sided 95 % bootstrap bound
};

/// Of a change that moves the prediction of each pose by `moved_mm`: residuals' regression on it. Poses with one number
/// in `group` are drawn together. Errors beyond four times the median (before) count linearly, so that one outlier does
/// not decide. Zero where nothing moves.
Confirmation confirmation(const std::vector<double>& before_mm, const std::vector<double>& after_mm,
                          const std::vector<double>& moved_mm, const std::vector<std::size_t>& group,
                          RandomStream random, const DoWork& do_work = demecal::do_work);

/// The largest motion that an effect's ripple, load or side makes of any place over the states: how far it strays from
/// its own mean there, rad for turns, m for shifts.
struct LargestMotion {
  double turn_rad = 0.0, shift_m = 0.0;
};
LargestMotion largest_motion(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states);
/// The same of what stays the same too: how far the effect moves any place at most.
LargestMotion farthest_motion(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states);

inline constexpr double kStableSign = 0.95;  ///< share of resamples that must agree with a sign

/// How coefficients scatter when the fitted poses are drawn anew with replacement.
struct Resampled {
  double sign_stability = 1.0;                  ///< share of draws that agree with the sign of the whole effect
  std::vector<std::array<double, 2>> interval;  ///< 2.5 % and 97.5 % of every coefficient
};
Resampled resampled(const ResidualField& field, const Projection::Trial& trial, const Eigen::VectorXd& left, int draws,
                    RandomStream random, const DoWork& do_work = demecal::do_work);

/// Nats by which one description must be shorter than another to be preferred.
inline constexpr double kNatsToDistinguish = 5.0;

/// Why no real arm has this effect, and what to look at; empty where one may. `states` are those of the fitted poses. A
/// joint that moves by a whole share of another's motion, which `model` with it bears out, is how the controller
/// reports its joints: the sentence says so.
std::string implausibility(const Effect& effect, const DiagnosisProblem& problem, const DiagnosedModel& model,
                           const std::vector<ArmState>& states);

/// Whether it moves a place by more than any real arm's effects do.
bool is_implausibly_large(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states);

/// Whether its coefficients are no real arm's (EffectLaw::implausibility), so that the effect is another one in truth:
/// gravity that leans by more than a mount may, a link that grows by more than any metal does.
bool has_impossible_coefficients(const Effect& effect);

}  // namespace demecal::inline diagnosis
