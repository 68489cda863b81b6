#include <fmt/format.h>
#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "data_check/check_data.hpp"
#include "data_check/searches.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "trials/explanations.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {

void check_declared(const DataSet& data, const DeclaredModel& declared, DataCheck& check) {
  if (declared.registration || check.verdict() == DataVerdict::contradiction) return;
  Trial trial = measured_trial(data);
  std::erase_if(trial.rows, [&](const TrialRow& row) { return data.poses[row.pose].set != PoseSet::calibration; });
  if (trial.rows.empty() || trial.stations > 1) return;
  // A tool that is fitted may be anywhere: it is no other frame.
  const std::vector<Eigen::Vector3d> tools_m = declared.tool ? fit_base_and_tools(trial).tools_m : trial.tools_m;
  std::vector<Eigen::Vector3d> predicted, measured;
  for (const TrialRow& row : trial.rows) {
    predicted.emplace_back(forward(trial.chain, row.joints) * tools_m[static_cast<std::size_t>(row.target)]);
    measured.push_back(row.point_m);
  }
  const auto other = find_other_frame(predicted, measured);
  if (!other || other->as_given_m < kImplausibleShare * trial.reach_m()) return;
  check.findings.push_back(
      {.kind = FindingKind::undeclared_registration,
       .as_given_mm = millimetres(other->as_given_m),
       .if_changed_mm = millimetres(other->if_changed_m),
       .sentence =
           fmt::format("The points were measured in another frame than the robot's base, {} away in the median, "
                       "and no base is fitted: `registration` is not declared {}. Add it to `model.declared` of "
                       "the job (or --declare).",
                       distance_text(other->shift_m), before_and_after(other->as_given_m, other->if_changed_m))});
}

}  // namespace demecal::inline data_check
