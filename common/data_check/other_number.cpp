#include "data_check/other_number.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "trials/sign_sets.hpp"

namespace demecal::inline data_check {
namespace {

constexpr int kBaseAndTool = 9;  ///< parameters before those of links

/// Gauss-Newton steps of base, tool and one number.
std::optional<TrialFit> fit_with(const Trial& trial, TrialFit fit, int joint, LinkParameter which) {
  constexpr int kSteps = 15;
  constexpr double kHeld = 1e-9;  ///< information that holds what no pose sees
  const int column = kBaseAndTool + kLinkParameters * joint + static_cast<int>(which);
  for (int step = 0; step < kSteps; ++step) {
    const LinearizedTrial linear = linearized(trial, fit);
    Eigen::MatrixXd jacobian(linear.jacobian.rows(), kBaseAndTool + 1);
    jacobian << linear.jacobian.leftCols(kBaseAndTool), linear.jacobian.col(column);
    const Eigen::MatrixXd information =
        jacobian.transpose() * jacobian + kHeld * Eigen::MatrixXd::Identity(kBaseAndTool + 1, kBaseAndTool + 1);
    const Eigen::VectorXd change = PivotedCholesky(information).solve(jacobian.transpose() * linear.error_m);
    if (!change.allFinite()) return std::nullopt;
    Eigen::Isometry3d& base = fit.sensor_from_base.front();
    base.translation() += change.head<3>();
    base.linear() = rotation_of(change.segment<3>(3)) * base.linear();
    fit.tools_m.front() += change.segment<3>(6);
    fit.chain.joints[static_cast<std::size_t>(joint)].parameter(which) += change[kBaseAndTool];
  }
  for (std::size_t i = 0; i < trial.rows.size(); ++i)
    fit.error_m[i] = (trial.rows[i].point_m - predicted_point(fit, trial.rows[i])).norm();
  return fit;
}

}  // namespace

std::vector<OtherNumber> numbers_that_explain(const Trial& trial,
                                              const std::function<bool(const std::vector<double>&)>& accepts) {
  constexpr double kAsNear_m = 2e-3;
  const TrialFit placed = fit_base_and_tools(trial);
  std::vector<std::pair<double, OtherNumber>> found;
  for (const LinkParameter which : {LinkParameter::theta, LinkParameter::a, LinkParameter::d, LinkParameter::alpha}) {
    for (int joint = 0; joint < trial.chain.size(); ++joint) {
      auto fit = fit_with(trial, placed, joint, which);
      if (!fit || !accepts(fit->error_m)) continue;
      const auto at = static_cast<std::size_t>(joint);
      const double by = fit->chain.joints[at].parameter(which) - trial.chain.joints[at].parameter(which);
      const ParameterId id{.kind = ParameterId::Kind::link, .index = joint, .link = which};
      OtherNumber number{which == moving_parameter(trial.chain.joints[at]),
                         fmt::format("{} differs by {:.2f}.", id.name(), id.is_angle() ? degrees(by) : millimetres(by)),
                         std::move(*fit)};
      found.emplace_back(distance_from_description_m(trial, number.fit, true), std::move(number));
    }
  }
  std::ranges::stable_sort(found, [](const auto& one, const auto& other) { return one.first < other.first; });
  std::vector<OtherNumber> numbers;
  for (auto& [distance_m, number] : found)
    if (distance_m < found.front().first + kAsNear_m) numbers.push_back(std::move(number));
  return numbers;
}

}  // namespace demecal::inline data_check
