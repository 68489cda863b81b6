#include "updating/change_steps.hpp"

#include <Eigen/Core>
#include <cmath>

#include "decompositions/decompositions.hpp"
#include "fitting/fit.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"

namespace demecal::inline updating {
namespace {

double squared_size(double value) {
  return value * value;
}

}  // namespace

double strain_of(const ChangeRows& rows) {
  return std::sqrt(rows.values.squaredNorm() / static_cast<double>(rows.values.size()));
}

bool really_leaves_less(const ChangeStep& step, double before_m) {
  constexpr double kReal = 0.5;  ///< of the mean square that the cause takes away to first order
  /// A change that orientations show may leave positions as they are but for noise.
  constexpr double kAlike = 1.1;
  const double before = squared_size(step.strain_before), promised = before - squared_size(strain_of(step.left));
  return before - squared_size(step.strain) > kReal * promised &&
         step.left_m < (step.orientation_rad > 0.0 ? kAlike : 1.0) * before_m;
}

std::size_t named_step(const std::vector<ChangeStep>& steps, const ExpectedErrors& expected) {
  constexpr double kFar = 1.5, kMost = 0.5, kLittle = 0.75;
  std::size_t last = steps.size() - 1;
  if (steps[last].strain > expected.strain_limit)
    while (last > 0 && steps[last].strain > kLittle * steps[last].strain_before) --last;
  const ChangeStep &none = steps.front(), &named = steps[last];
  const double far = kFar * expected.strain_limit, far_m = far * expected.rms_m;
  const bool strained = named.strain >= far && named.strain >= kMost * none.strain;
  // A tool that is taken far away leaves errors that a model may well have there.
  const bool errs = named.orientation_rad == 0.0 && named.left_m >= far_m && named.left_m >= kMost * none.left_m;
  return strained || errs ? 0 : last;
}

std::vector<double> norms_beyond_causes(const ChangeRows& rows) {
  Eigen::MatrixXd all(rows.values.size(), 0);
  for (const Eigen::MatrixXd& columns : rows.columns) {
    all.conservativeResize(Eigen::NoChange, all.cols() + columns.cols());
    all.rightCols(columns.cols()) = columns;
  }
  std::vector<double> norms;
  if (all.cols() >= all.rows() / 2) return norms;
  const Eigen::VectorXd left = rows.values - all * least_norm_solution(all, rows.values);
  for (std::size_t i = 0; i + 1 < rows.first_row.size(); ++i)
    norms.push_back(left.segment(rows.first_row[i], rows.first_row[i + 1] - rows.first_row[i]).norm());
  return norms;
}

std::optional<CorrectedRobot> set_up_anew(const CorrectedRobot& robot, const DataSet& data,
                                          const std::vector<std::size_t>& poses) {
  constexpr double kElsewhere_m = 5e-3;
  std::vector<double> errors;
  for (const std::size_t pose : poses) errors.push_back(tool_error_m(robot, data, data.poses[pose]));
  if (!(median(errors) > kElsewhere_m) || data.frame != Frame::sensor) return std::nullopt;
  const Fit fit = fit_registration(data, poses, {.registration = true}, robot);
  return fit.status == FitStatus::converged ? std::optional(fit.robot) : std::nullopt;
}

}  // namespace demecal::inline updating
