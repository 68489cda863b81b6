#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "kinematics/forward.hpp"
#include "random/distributions.hpp"
#include "trials/explanations.hpp"
#include "trials/point_pairs.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline trials {
namespace {

constexpr double kFarDeviationsOff = 6.0;  ///< deviations at a set's median that ask for a reason; 1.5 are expected
constexpr double kOtherFrameFall = 0.25;   ///< kLeastFall where a fitted model must hold in another frame

/// The tool points that bring the rows' predictions nearest to what was measured, large errors counting less.
std::vector<Eigen::Vector3d> own_tools(const TrialFit& fit, std::span<const TrialRow> rows) {
  std::vector<Eigen::Isometry3d> flanges;
  const FixedTurns turns(fit.chain);
  for (const TrialRow& row : rows)
    flanges.push_back(fit.sensor_from_base[static_cast<std::size_t>(row.station)] * forward(turns, row.joints));
  std::vector<Eigen::Vector3d> tools = fit.tools_m;
  for (std::size_t target = 0; target < tools.size(); ++target) {
    for (int repetition = 0; repetition < 8; ++repetition) {
      Eigen::Matrix3d information = 1e-9 * Eigen::Matrix3d::Identity();
      Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const TrialRow& row = rows[i];
        if (static_cast<std::size_t>(row.target) != target) continue;
        const Eigen::Isometry3d& flange = flanges[i];
        const Eigen::Vector3d error = row.point_m - flange * tools[target];
        const double weight = 1.0 / std::max(error.norm(), 1e-5);
        information += weight * Eigen::Matrix3d::Identity();
        gradient += weight * flange.linear().transpose() * error;
      }
      tools[target] += solve_positive(information, gradient);
    }
  }
  return tools;
}

std::vector<Eigen::Vector3d> predictions(const TrialFit& fit, std::span<const TrialRow> rows) {
  std::vector<Eigen::Vector3d> points;
  for (const TrialRow& row : rows) points.push_back(predicted_point(fit, row));
  return points;
}

double median_error(const std::vector<Eigen::Vector3d>& predicted, std::span<const TrialRow> rows) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < rows.size(); ++i) errors.push_back((rows[i].point_m - predicted[i]).norm());
  return median(std::move(errors));
}

double root_mean_square(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to) {
  double squares = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) squares += (from[i] - to[i]).squaredNorm();
  return std::sqrt(squares / static_cast<double>(from.size()));
}

}  // namespace

Eigen::Isometry3d registration(const PointPairs& pairs, std::size_t begin, std::size_t end) {
  const auto n = static_cast<Eigen::Index>(end - begin);
  Eigen::Matrix3Xd from(3, n), to(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    from.col(i) = pairs.arm[begin + static_cast<std::size_t>(i)];
    to.col(i) = pairs.measured[begin + static_cast<std::size_t>(i)];
  }
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
  for (int repetition = 0; repetition < 6; ++repetition) {
    base = weighted_registration(from, to, weights);
    weights =
        ((base.linear() * from).colwise() + base.translation() - to).colwise().norm().cwiseMax(1e-5).cwiseInverse();
  }
  return base;
}

std::optional<OtherSet> find_other_set(const TrialFit& fit, std::vector<TrialRow>& rows) {
  constexpr std::size_t kFewest = 4;
  if (rows.size() < kFewest) return std::nullopt;
  const std::vector<Eigen::Vector3d> given = predictions(fit, rows);
  const double as_given_m = median_error(given, rows);
  std::vector<double> off;
  for (const TrialRow& row : rows) off.push_back(fit.deviations_off(row));
  if (median(off) < kFarDeviationsOff || as_given_m < kSmallestShift_m) return std::nullopt;

  TrialFit with_tools = fit;
  with_tools.tools_m = own_tools(fit, rows);
  const std::vector<Eigen::Vector3d> by_tool = predictions(with_tools, rows);

  PointPairs pairs;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    pairs.arm.push_back(given[i]);
    pairs.measured.push_back(rows[i].point_m);
  }
  const Eigen::Isometry3d motion = registration(pairs, 0, rows.size());
  std::vector<Eigen::Vector3d> by_frame;
  for (const Eigen::Vector3d& point : given) by_frame.push_back(motion * point);

  const double tool_m = median_error(by_tool, rows), frame_m = median_error(by_frame, rows);
  // Three numbers that do as well as six are the likelier reason.
  const bool is_tool = tool_m < 1.15 * frame_m;
  const std::vector<Eigen::Vector3d>& better = is_tool ? by_tool : by_frame;
  const OtherSet other{is_tool, root_mean_square(given, better), as_given_m, is_tool ? tool_m : frame_m};
  const bool fits = other.if_changed_m < std::min(kLeastFall * as_given_m, kMostOverUsual * fit.usual_m);
  if (!fits) return std::nullopt;
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].point_m += given[i] - better[i];
  return other;
}

std::optional<OtherSet> find_other_frame(const std::vector<Eigen::Vector3d>& predicted,
                                         const std::vector<Eigen::Vector3d>& measured) {
  constexpr std::size_t kFewest = 6;
  if (predicted.size() < kFewest) return std::nullopt;
  const PointPairs pairs{predicted, measured};
  const Eigen::Isometry3d motion = registration(pairs, 0, predicted.size());
  std::vector<double> given, moved, shift;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    given.push_back((measured[i] - predicted[i]).norm());
    moved.push_back((measured[i] - motion * predicted[i]).norm());
    shift.push_back((motion * predicted[i] - predicted[i]).norm());
  }
  const OtherSet other{false, median(shift), median(given), median(moved)};
  if (other.as_given_m < kSmallestShift_m || other.if_changed_m > kOtherFrameFall * other.as_given_m)
    return std::nullopt;
  return other;
}

}  // namespace demecal::inline trials
