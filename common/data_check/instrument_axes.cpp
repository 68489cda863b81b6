#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data/spread_poses.hpp"
#include "data_check/searches.hpp"
#include "decompositions/decompositions.hpp"
#include "kinematics/units.hpp"
#include "trials/explanations.hpp"
#include "trials/finding.hpp"
#include "trials/joint_side.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kFullWeightOff = 3.0;  ///< deviations up to which rows count in full
constexpr double kAxesGain = 20.0;      ///< log likelihood that wrong axes must gain, for each row of a pose
constexpr double kClearGain = 8.0;      ///< that a further number must gain
constexpr double kAxesFall = 0.9;       ///< of the median error, where axes are at fault
constexpr double kLeastStretch = 3e-4;  ///< instruments' axes agree to a tenth of this
constexpr double kMostStretch = 0.1;
constexpr int kAxesRefits = 3;
constexpr std::size_t kAxesRows = 1000;      ///< calibration rows that are looked at
constexpr std::size_t kFewestAxesRows = 20;  ///< below which gears and elasticity alone explain anything

using AxesStretch = Eigen::Matrix<double, 6, 1>;  ///< xx, yy, zz, xy, xz, yz of a symmetric map less the identity

Eigen::Matrix3d map_of(const AxesStretch& stretch) {
  Eigen::Matrix3d map;
  map << 1.0 + stretch[0], stretch[3], stretch[4], stretch[3], 1.0 + stretch[1], stretch[5], stretch[4], stretch[5],
      1.0 + stretch[2];
  return map;
}

/// How a measured point moves with each of the six numbers.
Eigen::Matrix<double, 3, 6> stretch_columns(const Eigen::Vector3d& point) {
  Eigen::Matrix<double, 3, 6> columns = Eigen::Matrix<double, 3, 6>::Zero();
  columns(0, 0) = point.x(), columns(1, 1) = point.y(), columns(2, 2) = point.z();
  columns(0, 3) = point.y(), columns(1, 3) = point.x();
  columns(0, 4) = point.z(), columns(2, 4) = point.x();
  columns(1, 5) = point.z(), columns(2, 5) = point.y();
  return columns;
}

/// The six numbers that suit errors best beside base, tools, links, gears and elasticity.
struct StretchEstimate {
  AxesStretch size = AxesStretch::Zero();
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
};

Eigen::Vector3d middle_of(const Trial& trial) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const TrialRow& row : trial.rows) sum += row.point_m;
  return sum / static_cast<double>(trial.rows.size());
}

/// The same equations whatever rows scatter by: columns of base, tools, links, gears and elasticity, then the six.
class StretchEquations {
 public:
  StretchEquations(const Trial& trial, const TrialFit& fit, const Eigen::Vector3d& gravity)
      : linear_(linearized(trial, fit)) {
    const JointSide side(trial, fit, gravity);
    const Eigen::Index declared = linear_.jacobian.cols(), sides = side.columns(trial.rows.front()).cols();
    size_ = declared + sides;
    columns_.resize(linear_.jacobian.rows(), size_ + 6);
    prior_ = Eigen::VectorXd::Zero(size_ + 6);
    prior_.head(declared) = linear_.prior;
    prior_.segment(declared, sides).setConstant(1.0 / (kJointSideDeviation * kJointSideDeviation));
    const Eigen::Vector3d middle = middle_of(trial);
    for (std::size_t i = 0; i < trial.rows.size(); ++i) {
      const auto at = 3 * static_cast<Eigen::Index>(i);
      columns_.block(at, 0, 3, declared) = linear_.jacobian.middleRows<3>(at);
      columns_.block(at, declared, 3, sides) = side.columns(trial.rows[i]);
      columns_.block<3, 6>(at, size_) = stretch_columns(trial.rows[i].point_m - middle);
    }
  }

  /// First with the deviation that the fit has, then with the one that gears and elasticity leave.
  StretchEstimate solve(double deviation_m) const {
    StretchEstimate found;
    Eigen::VectorXd error_m = linear_.error_m;
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd weights = weights_of(error_m, deviation_m);
      const Eigen::MatrixXd by_points = columns_.transpose() * weights.asDiagonal() * columns_;
      Eigen::MatrixXd information = by_points;
      information.diagonal() += prior_;
      const Eigen::VectorXd gradient = columns_.transpose() * weights.cwiseProduct(linear_.error_m);
      const PivotedCholesky others(information.topLeftCorner(size_, size_));
      const Eigen::MatrixXd shared = information.topRightCorner(size_, 6);
      found.information = information.bottomRightCorner<6, 6>() - shared.transpose() * others.solve(shared);
      found.size = PivotedCholesky(found.information)
                       .solve(gradient.tail<6>() - shared.transpose() * others.solve(gradient.head(size_)));
      const PivotedCholesky factor(information);
      error_m = linear_.error_m - columns_ * factor.solve(gradient);
      const double determined = factor.solve(by_points).trace(), rows = static_cast<double>(error_m.size());
      const double squares = error_m.dot(weights.cwiseProduct(error_m)) * deviation_m * deviation_m;
      deviation_m = std::sqrt(squares / std::max(rows - determined, 0.1 * rows));
    }
    return found;
  }

 private:
  /// Full up to three deviations of a row.
  static Eigen::VectorXd weights_of(const Eigen::VectorXd& error_m, double deviation_m) {
    Eigen::VectorXd weights(error_m.size());
    for (Eigen::Index i = 0; i < error_m.size(); i += 3) {
      const double off = error_m.segment<3>(i).norm() / deviation_m;
      weights.segment<3>(i).setConstant(std::min(1.0, kFullWeightOff / off) / (deviation_m * deviation_m));
    }
    return weights;
  }

  LinearizedTrial linear_;
  Eigen::Index size_ = 0;
  Eigen::MatrixXd columns_;
  Eigen::VectorXd prior_;
};

/// What some of the six numbers gain beside one scale of all: that is no matter of axes.
class AxesGain {
 public:
  explicit AxesGain(const StretchEstimate& estimate) : estimate_(estimate), scale_(of({})) {}

  double by(const std::vector<int>& numbers) const { return of(numbers) - scale_; }

  /// Scale, then the numbers, as they suit the estimate best.
  Eigen::VectorXd sizes(const std::vector<int>& numbers) const {
    const Eigen::MatrixXd chosen = columns(numbers);
    return PivotedCholesky(chosen.transpose() * estimate_.information * chosen)
        .solve(chosen.transpose() * estimate_.information * estimate_.size);
  }

 private:
  static Eigen::MatrixXd columns(const std::vector<int>& numbers) {
    Eigen::MatrixXd chosen(6, 1 + std::ssize(numbers));
    chosen.col(0) << 1, 1, 1, 0, 0, 0;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      chosen.col(1 + static_cast<Eigen::Index>(i)) = AxesStretch::Unit(numbers[i]);
    return chosen;
  }
  double of(const std::vector<int>& numbers) const {
    const Eigen::MatrixXd chosen = columns(numbers);
    return 0.5 * sizes(numbers).dot(chosen.transpose() * estimate_.information * estimate_.size);
  }

  const StretchEstimate& estimate_;
  double scale_;
};

/// One of the six numbers, and others as long as each gains clearly beside those before.
std::vector<int> telling_numbers(const AxesGain& gain) {
  std::vector<int> chosen;
  for (double before = 0.0; chosen.size() < 5;) {
    std::vector<int> best = chosen;
    for (int number = 0; number < 6; ++number) {
      std::vector<int> with = chosen;
      with.push_back(number);
      if (std::ranges::count(chosen, number) == 0 && (best == chosen || gain.by(with) > gain.by(best))) best = with;
    }
    if (!chosen.empty() && gain.by(best) < before + kClearGain) break;
    chosen = best;
    before = gain.by(chosen);
  }
  return chosen;
}

std::string axis_in_words(int number, double size) {
  constexpr std::array<const char*, 6> kAxes{"x", "y", "z", "x and y", "x and z", "y and z"};
  const char* const axes = kAxes.at(static_cast<std::size_t>(number));
  if (number < 3)
    return fmt::format("{} of the measured positions is {:.2g} % ({:.0f} ppm) too {} against the other axes", axes,
                       100.0 * std::abs(size), 1e6 * std::abs(size), size > 0.0 ? "long" : "short");
  return fmt::format("{} of the measured positions are not square: their axes enclose {:.3f} deg", axes,
                     90.0 - degrees(2.0 * size));
}

std::string numbers_in_words(const std::vector<int>& numbers, const Eigen::VectorXd& sizes) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double size = sizes[1 + static_cast<Eigen::Index>(i)];
    if (std::abs(size) < kLeastStretch) continue;
    text += (text.empty() ? "" : ", and ") + axis_in_words(numbers[i], size);
  }
  return text;
}

Trial many_rows(const DataSet& data, const Trial& whole) {
  Trial trial{whole.chain, whole.tools_m, {}, 1};
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < whole.rows.size(); ++i)
    if (data.poses[whole.rows[i].pose].set == PoseSet::calibration) rows.push_back(i);
  for (const std::size_t i : spread_indices(rows.size(), kAxesRows)) trial.rows.push_back(whole.rows[rows[i]]);
  return trial;
}

void take_stretch_away(const AxesStretch& stretch, const Eigen::Vector3d& middle, Trial& trial) {
  const Eigen::Matrix3d back = map_of(stretch).inverse();
  for (TrialRow& row : trial.rows) row.point_m = middle + back * (row.point_m - middle);
}

}  // namespace

std::optional<Finding> find_wrong_axes(const DataSet& data, CheckedRows& rows, TrialFit& placed, TrialFit& fit) {
  const Trial given = many_rows(data, rows.whole);
  if (given.rows.size() < kFewestAxesRows) return std::nullopt;
  const Eigen::Vector3d middle = middle_of(given);
  StretchEstimate estimate;
  AxesStretch sum = AxesStretch::Zero();
  Trial trial = given;
  TrialFit fitted = fit;
  for (int i = 0; i < kAxesRefits; ++i) {
    estimate = StretchEquations(trial, fitted, data.robot.gravity_mps2).solve(fitted.deviation_m);
    // What all axes have in common is left to the links, and to the scale of the instrument.
    sum += estimate.size;
    sum.head<3>().array() -= sum.head<3>().mean();
    if (!sum.allFinite() || sum.cwiseAbs().maxCoeff() > kMostStretch) return std::nullopt;
    if (i == 0 && sum.cwiseAbs().maxCoeff() < 0.5 * kLeastStretch) return std::nullopt;
    trial = given;
    take_stretch_away(sum, middle, trial);
    fitted = fit_arm(trial, fit_base_and_tools(trial));
  }
  estimate.size = sum;
  const AxesGain gain(estimate);
  const std::vector<int> numbers = telling_numbers(gain);
  const Eigen::VectorXd sizes = gain.sizes(numbers);
  const std::string words = numbers_in_words(numbers, sizes);
  if (gain.by(numbers) < kAxesGain * fitted.rows_per_pose || words.empty()) return std::nullopt;
  if (fitted.median_m > std::min(kImplausibleShare * rows.trial.reach_m(), kAxesFall * fit.median_m))
    return std::nullopt;
  AxesStretch named = AxesStretch::Zero();
  for (std::size_t i = 0; i < numbers.size(); ++i) named[numbers[i]] = sizes[1 + static_cast<Eigen::Index>(i)];
  take_stretch_away(named, middle, rows.trial);
  take_stretch_away(named, middle, rows.whole);
  const double as_given_m = fit.median_m;
  placed = fit_base_and_tools(rows.trial);
  fit = fit_arm(rows.trial, placed);
  return Finding{.kind = FindingKind::wrong_axes,
                 .as_given_mm = millimetres(as_given_m),
                 .if_changed_mm = millimetres(fit.median_m),
                 .sentence = words + " " + before_and_after(as_given_m, fit.median_m) +
                             ". Links, gears and elasticity of the arm do not explain it. Check the conversion of "
                             "units and temperature of these columns, and the instrument's scale bar and axes; as "
                             "given, errors of the instrument are taken for the arm's."};
}

}  // namespace demecal::inline data_check
