#include "data/data_set.hpp"
#include "kinematics/angles.hpp"
#include "prediction/corrected_robot.hpp"
#include "report/make_report.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/selection.hpp"
#include "data/spread_poses.hpp"
#include "decompositions/decompositions.hpp"
#include "expression/rounded_constant.hpp"
#include "expression/tree.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline report {
namespace {

constexpr double kMostIncrease = 0.05;  ///< of the error, by the short forms of all joints together
constexpr double kMostIncreaseByLonger = 0.02;
constexpr std::size_t kShortNodes = 20, kMostFormNodes = 30;
constexpr int kHighestWave = 5, kFewestDigits = 2, kMostDigits = 4;
constexpr double kNearCorrection = 0.5;  ///< of the correction's size: a form that differs by more is not tried
constexpr std::size_t kMostJudgingPoses = 300;

/// Waves by their cycles a turn, and whether there are a slope and an offset.
struct Shape {
  std::vector<double> waves{};
  bool slope = false, offset = false;

  std::size_t nodes() const {
    std::size_t count = offset ? 1 : 0, parts = offset ? 1 : 0;
    for (const double wave : waves) count += wave == 1.0 ? 6 : 8, ++parts;
    if (slope) count += 5, ++parts;
    return count + parts - 1;
  }
};

std::vector<Shape> shapes() {
  std::vector<std::vector<double>> sets{{}};
  for (int first = 1; first <= kHighestWave; ++first) {
    sets.push_back({static_cast<double>(first)});
    for (int second = first + 1; second <= kHighestWave; ++second)
      sets.push_back({static_cast<double>(first), static_cast<double>(second)});
  }
  std::vector<Shape> all;
  for (const std::vector<double>& waves : sets) {
    for (const auto& [slope, offset] : {std::pair{false, false}, std::pair{false, true}, std::pair{true, false}}) {
      const Shape shape{waves, slope, offset};
      if (waves.empty() && !slope && !offset) continue;
      if (shape.nodes() <= kMostFormNodes) all.push_back(shape);
    }
  }
  return all;
}

/// An angle in degrees as finely as a size with so many digits asks for.
double degrees_with_digits(double angle_rad, int digits) {
  const double steps = std::pow(10.0, digits - 2);
  return std::round(degrees(angle_rad) * steps) / steps;
}

std::string plus(const std::string& sum, double sign, const std::string& term) {
  if (sum.empty()) return (sign < 0 ? "-" : "") + term;
  return sum + (sign < 0 ? " - " : " + ") + term;
}

/// `name + 14 deg`, or the name alone.
std::string shifted_name(const std::string& name, double shift_deg) {
  if (shift_deg == 0.0) return name;
  return fmt::format("{} {} {} deg", name, shift_deg < 0 ? '-' : '+', std::abs(shift_deg));
}

Tree sum_with(const Tree& sum, const Tree& term) {
  return sum.empty() ? term : apply(Primitive::add, sum, term);
}

/// A formula and its text, term by term.
struct Sum {
  Tree formula{};
  std::string text{};
  std::string angle;  ///< what the text calls the joint's angle

  void add_wave(double cycles, double cosine, double sine, int digits) {
    const double size_mrad = rounded_constant(1e3 * std::hypot(cosine, sine), digits);
    double phase_rad = std::atan2(cosine, sine);
    const double sign = std::abs(phase_rad) > 0.5 * std::numbers::pi ? -1.0 : 1.0;
    if (sign < 0) phase_rad -= std::copysign(std::numbers::pi, phase_rad);
    const double phase_deg = degrees_with_digits(phase_rad, digits);
    Tree turned = variable_tree(0);
    if (cycles != 1.0) turned = apply(Primitive::multiply, constant_tree(cycles), turned);
    turned = apply(Primitive::add, turned, constant_tree(radians(phase_deg)));
    formula = sum_with(
        formula, apply(Primitive::multiply, constant_tree(1e-3 * sign * size_mrad), apply(Primitive::sine, turned)));
    const std::string argument = (cycles == 1.0 ? "" : fmt::format("{} ", cycles)) + angle;
    text = plus(text, sign, fmt::format("{} mrad sin({})", size_mrad, shifted_name(argument, phase_deg)));
  }
  /// `slope` is in mrad per rad, zero at `zero_rad`.
  void add_slope(double slope, double zero_rad, int digits) {
    const double zero_deg = degrees_with_digits(zero_rad, digits),
                 rounded_slope = rounded_constant(1e3 * slope, digits);
    formula = sum_with(formula, apply(Primitive::multiply, constant_tree(1e-3 * rounded_slope),
                                      apply(Primitive::subtract, variable_tree(0), constant_tree(radians(zero_deg)))));
    const std::string from_zero = zero_deg == 0.0 ? angle : "(" + shifted_name(angle, -zero_deg) + ")";
    text = plus(text, rounded_slope, fmt::format("{} mrad/rad {}", std::abs(rounded_slope), from_zero));
  }
  void add_offset(double offset_rad, int digits) {
    const double offset_mrad = rounded_constant(1e3 * offset_rad, digits);
    formula = sum_with(formula, constant_tree(1e-3 * offset_mrad));
    text = plus(text, offset_mrad, fmt::format("{} mrad", std::abs(offset_mrad)));
  }
};

/// The shape's columns: cosine and sine of every wave, then slope, then offset.
Eigen::MatrixXd columns_of_shape(const Shape& shape, const Eigen::VectorXd& angles) {
  const auto waves = static_cast<Eigen::Index>(shape.waves.size());
  const bool constant = shape.slope || shape.offset;
  Eigen::MatrixXd columns(angles.size(), 2 * waves + (shape.slope ? 1 : 0) + (constant ? 1 : 0));
  for (Eigen::Index i = 0; i < waves; ++i) {
    const Eigen::ArrayXd turned = shape.waves[static_cast<std::size_t>(i)] * angles.array();
    columns.col(2 * i) = turned.cos().matrix();
    columns.col(2 * i + 1) = turned.sin().matrix();
  }
  if (shape.slope) columns.col(2 * waves) = angles;
  if (constant) columns.rightCols(1).setOnes();
  return columns;
}

/// Shapes with waves of any half number of cycles, each the one that leaves least beside those before.
std::vector<Shape> pursued_shapes(const Eigen::VectorXd& angles, const Eigen::VectorXd& values) {
  constexpr double kHighestCycles = 20.0, kStep = 0.5;
  const double range_rad = angles.maxCoeff() - angles.minCoeff();
  std::vector<Shape> all;
  for (const bool slope : {false, true}) {
    Shape shape{.slope = slope, .offset = !slope};
    while (true) {
      double least = std::numeric_limits<double>::infinity(), best = 0.0;
      shape.waves.push_back(0.0);
      // A wave of which the range holds less than half is a slope or an offset once more.
      for (double cycles = kStep; cycles <= kHighestCycles; cycles += kStep) {
        if (cycles * range_rad < std::numbers::pi) continue;
        shape.waves.back() = cycles;
        const Eigen::MatrixXd columns = columns_of_shape(shape, angles);
        const double left = (values - columns * PivotedQr(columns).solve(values)).norm();
        if (left < least) least = left, best = cycles;
      }
      shape.waves.back() = best;
      if (best == 0.0 || shape.nodes() > kMostFormNodes) break;
      all.push_back(shape);
    }
  }
  return all;
}

/// Coefficients of a shape, in the order of its columns; none where it is far from the correction, or comes to it by
/// waves much larger than it.
Eigen::VectorXd fitted_coefficients(const Shape& shape, const Eigen::VectorXd& angles, const Eigen::VectorXd& values) {
  constexpr double kMostOverCorrection = 3.0;
  const Eigen::MatrixXd columns = columns_of_shape(shape, angles);
  const Eigen::VectorXd coefficients = PivotedQr(columns).solve(values);
  const double largest = kMostOverCorrection * values.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < shape.waves.size(); ++i)
    if (coefficients.segment<2>(2 * static_cast<Eigen::Index>(i)).norm() > largest) return {};
  const double left = (values - columns * coefficients).norm();
  return left < kNearCorrection * values.norm() ? coefficients : Eigen::VectorXd();
}

Sum rounded_sum(const Shape& shape, const Eigen::VectorXd& coefficients, const std::string& angle, int digits) {
  Sum sum{.angle = angle};
  Eigen::Index at = 0;
  for (const double cycles : shape.waves) {
    sum.add_wave(cycles, coefficients[at], coefficients[at + 1], digits);
    at += 2;
  }
  if (shape.slope) sum.add_slope(coefficients[at], -coefficients[at + 1] / coefficients[at], digits);
  if (shape.offset) sum.add_offset(coefficients[at], digits);
  return sum;
}

class Shortening {
 public:
  Shortening(const DataSet& data, const CorrectedRobot& robot)
      : data_(data),
        robot_(robot),
        judging_(data, spread_poses(selection_poses(data, robot), kMostJudgingPoses), robot),
        square_(left(robot)) {}

  std::vector<std::optional<ShortForm>> run();

 private:
  double left(const CorrectedRobot& robot) const { return sum(judging_.squared_errors(robot)); }
  /// `share`: of what all forms may add to the error.
  std::optional<ShortForm> shortest(std::size_t joint, double share);

  const DataSet& data_;
  CorrectedRobot robot_;  ///< with the short forms so far
  PoseEvaluator judging_;
  double square_;
};

std::optional<ShortForm> Shortening::shortest(std::size_t joint, double share) {
  const JointCorrection present = robot_.corrections[joint];
  const std::vector<std::size_t> poses = poses_of(data_, PoseSet::calibration);
  Eigen::VectorXd angles(std::ssize(poses)), values(std::ssize(poses));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double theta = data_.poses[poses[i]].joints[static_cast<Eigen::Index>(joint)];
    angles[static_cast<Eigen::Index>(i)] = present.branch()(theta);
    values[static_cast<Eigen::Index>(i)] = present(theta);
  }
  const std::string angle = "q" + std::to_string(joint + 1);
  std::vector<Shape> tried = shapes();
  std::ranges::move(pursued_shapes(angles, values), std::back_inserter(tried));
  std::ranges::stable_sort(tried, {}, &Shape::nodes);
  for (const Shape& shape : tried) {
    const Eigen::VectorXd coefficients = fitted_coefficients(shape, angles, values);
    if (coefficients.size() == 0 || !coefficients.allFinite()) continue;
    const double increase = share * (shape.nodes() <= kShortNodes ? kMostIncrease : kMostIncreaseByLonger);
    for (int digits = kFewestDigits; digits <= kMostDigits; ++digits) {
      const Sum sum = rounded_sum(shape, coefficients, angle, digits);
      robot_.corrections[joint] = JointCorrection(sum.formula, present.branch(), present.range_rad());
      if (left(robot_) <= std::pow(1.0 + increase, 2) * square_)
        return ShortForm{sum.text, sum.formula.size(), robot_.corrections[joint]};
    }
  }
  robot_.corrections[joint] = present;
  return std::nullopt;
}

std::vector<std::optional<ShortForm>> Shortening::run() {
  std::vector<std::optional<ShortForm>> forms(robot_.corrections.size());
  const auto corrected = std::ranges::count_if(
      robot_.corrections, [](const JointCorrection& correction) { return !correction.is_neutral(); });
  double done = 0.0;
  for (std::size_t joint = 0; joint < forms.size(); ++joint) {
    if (robot_.corrections[joint].is_neutral() || !is_revolute(robot_.chain, static_cast<int>(joint))) continue;
    // Of what all may add, the first joints take no more than their share.
    forms[joint] = shortest(joint, ++done / static_cast<double>(corrected));
  }
  return forms;
}

}  // namespace

std::vector<std::optional<ShortForm>> short_forms(const DataSet& data, const CorrectedRobot& robot) {
  return Shortening(data, robot).run();
}

}  // namespace demecal::inline report
