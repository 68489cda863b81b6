#include "diagnosis/judgement.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "fitting/fit.hpp"
#include "kinematics/chain.hpp"
#include "pieces/pieces.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "products/tall_products.hpp"
#include "random/distributions.hpp"
#include "shared_work/resamplings.hpp"

namespace demecal::inline diagnosis {
namespace {

constexpr std::uint32_t kConfirmationDraws = 1000;

double huber_square(double error, double threshold) {
  return error <= threshold ? error * error : threshold * (2.0 * error - threshold);
}

constexpr std::uint32_t kResamplingsOfPiece = 50;  ///< to begin a stream takes as long as hundreds of numbers

/// Calls each(draw, the sum of as many columns as there are, drawn with replacement) for every draw.
void for_each_resampling(Eigen::MatrixXd columns, std::uint32_t draws, RandomStream random, const DoWork& do_work,
                         const std::function<void(std::size_t, const double*)>& each) {
  const auto numbers = static_cast<std::size_t>(columns.rows());
  const auto sums = do_work(Resamplings(std::move(columns), {draws, random.name(), kResamplingsOfPiece}));
  in_pieces(sums.size(), [&](std::size_t piece) {
    for (std::size_t i = 0; i * numbers < sums[piece].size(); ++i)
      each(piece * kResamplingsOfPiece + i, sums[piece].data() + i * numbers);
  });
}

/// A column for every pose and its repeats: X^T X, and X^T (what X explains and what is left) as its last column. Side
/// by side, since resamplings read them in any order.
Eigen::MatrixXd pose_sums(const ResidualField& field, const Projection::Trial& trial, const Eigen::VectorXd& left) {
  const Eigen::Index m = trial.fitted.cols();
  std::map<std::size_t, Eigen::Index> places;
  for (const std::size_t group : field.group) places.try_emplace(group);
  Eigen::Index place = 0;
  for (auto& [group, own] : places) own = place++;
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(m * (m + 1), place);
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    const auto columns = trial.fitted.middleRows(field.first_row[pose], field.rows_of_pose(pose));
    const auto rows = left.segment(field.first_row[pose], field.rows_of_pose(pose));
    Eigen::Map<Eigen::MatrixXd> own(sums.col(places[field.group[pose]]).data(), m, m + 1);
    own.leftCols(m) += columns.transpose() * columns;
    own.col(m) += columns.transpose() * rows;
  }
  return sums;
}

Eigen::VectorXd solve_normal_equations(const Eigen::MatrixXd& gram, const Eigen::VectorXd& moment) {
  constexpr double kNothing = 1e-9;
  Eigen::VectorXd scale = gram.diagonal().cwiseSqrt();
  for (double& value : scale) value = value > kNoColumn ? 1 / value : 0.0;
  const auto eigen = eigen_system(scale.asDiagonal() * gram * scale.asDiagonal());
  Eigen::VectorXd turned = eigen.vectors.transpose() * scale.cwiseProduct(moment);
  for (Eigen::Index i = 0; i < turned.size(); ++i) {
    turned[i] = eigen.values[i] > kNothing ? turned[i] / eigen.values[i] : 0.0;
  }
  return scale.cwiseProduct(eigen.vectors * turned);
}

/// By place and axis, one motion a state.
using Motions = std::map<std::pair<int, int>, std::vector<double>>;

Motions motions_of(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states) {
  Motions motions;
  std::vector<UnitMotion> units;
  for (std::size_t i = 0; i < states.size(); ++i) {
    units.clear();
    append_unit_motions(effect, robot, states[i], units);
    for (const UnitMotion& unit : units) {
      auto [at, fresh] = motions.try_emplace({unit.place, unit.axis});
      if (fresh) at->second.assign(states.size(), 0.0);
      at->second[i] += unit.size * effect.value(static_cast<std::size_t>(unit.coefficient));
    }
  }
  return motions;
}

constexpr double kLargestTurn_rad = 0.02;  ///< gears, bearings and links that give way more are broken
constexpr double kLargestShift_m = 0.02;
constexpr double kUnitShare = 0.02;  ///< off a whole share: the arm's own errors may hide that much of it

std::string with_three_places(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

double rms_m(const DataSet& data, const std::vector<std::size_t>& poses, const CorrectedRobot& robot) {
  double squares = 0.0;
  for (const double error_m : tool_errors_m(robot, data, poses)) squares += std::pow(error_m, 2);
  return std::sqrt(squares / static_cast<double>(poses.size()));
}

/// The whole share, nearly, that explains most of the error where the joint turns with the other; 0 where none does.
/// Motions of radians are beyond what one linear step can tell: the arm is fitted anew to joints that are sums.
double whole_share(const Effect& effect, const DiagnosisProblem& problem, const DiagnosedModel& model) {
  constexpr int kSteps = 12;
  constexpr double kLeft = 0.2;  ///< of the error, at most
  const auto from = law_of(effect).proportional_to(effect);
  for (const double whole : {1.0, -1.0}) {
    DataSet summed = problem.data;
    for (MeasuredPose& pose : summed.poses) pose.joints[effect.joint] += whole * pose.joints[from];
    const DiagnosisProblem with{summed, problem.declared, problem.fitted, problem.validation};
    const Fit fit = fit_declared(summed, problem.fitted, problem.declared, nominal_robot(summed));
    if (fit.status != FitStatus::converged ||
        rms_m(summed, problem.fitted, fit.robot) > kLeft * rms_m(problem.data, problem.fitted, model.robot))
      continue;
    DiagnosedModel rest = diagnosed_model(with, fit);
    rest.robot.effects.push_back(effect);
    rest.robot.effects.back().values = {0.0};
    const double share = whole + refined(with, std::move(rest), kSteps).robot.effects.back().value(0);
    if (std::abs(share - whole) < kUnitShare) return share;
  }
  return 0.0;
}

/// Controllers that report a joint against the horizontal, or through a parallelogram, give its angle as a sum.
std::string unit_coupling(const Effect& effect, double share) {
  const std::string joint = std::to_string(effect.joint + 1),
                    from = std::to_string(law_of(effect).proportional_to(effect) + 1);
  return "the data show a unit coupling: joint " + joint + " turns with joint " + from + ", by " +
         with_three_places(share) + " of its motion; that is how joint " + joint +
         " is reported, not an error of the arm: write its column as q" + joint + (share > 0 ? " + q" : " - q") + from;
}

}  // namespace

std::vector<double> tool_errors_mm(const ResidualField& field, const Eigen::VectorXd& left, const RowScales& scales,
                                   const DataSet& data) {
  std::vector<double> errors;
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    const Eigen::Index first = field.first_row[pose], count = field.rows_of_pose(pose);
    const MeasuredPose& measured = data.poses[field.poses[pose]];
    const bool position = measures_point(measured) && scales[kPosition] > 0;
    const int points = rows_of(measured).points();
    Eigen::VectorXd rows = left.segment(first, count);
    if (field.within[pose].size() > 0) rows = field.within[pose] * rows;
    const double norm = rows.head(position ? points : count).norm();
    errors.push_back(position ? 1e3 * scales.of(measured, kPosition) * norm
                              : 1e3 * std::max(scales[kDistance], 1e-9) * norm / std::sqrt(static_cast<double>(count)));
  }
  return errors;
}

std::vector<double> pose_errors_mm(const ResidualField& field, const Eigen::VectorXd& left, const RowScales& scales) {
  const double unit_mm = 1e3 * (scales[kPosition] > 0 ? scales[kPosition] : std::max(scales[kDistance], 1e-9));
  std::vector<double> errors;
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    const Eigen::Index first = field.first_row[pose], count = field.rows_of_pose(pose);
    errors.push_back(unit_mm * left.segment(first, count).norm() * std::sqrt(3.0 / static_cast<double>(count)));
  }
  return errors;
}

Confirmation confirmation(const std::vector<double>& before_mm, const std::vector<double>& after_mm,
                          const std::vector<double>& moved_mm, const std::vector<std::size_t>& group,
                          RandomStream random, const DoWork& do_work) {
  struct Sums {
    double borne_out_mm2 = 0.0;
    double moved_mm2 = 0.0;
    double share() const { return moved_mm2 > 0.0 ? borne_out_mm2 / moved_mm2 : 0.0; }
    void operator+=(const Sums& other) {
      borne_out_mm2 += other.borne_out_mm2;
      moved_mm2 += other.moved_mm2;
    }
  };
  if (before_mm.empty()) return {};
  const double threshold = 4.0 * median(before_mm);
  std::map<std::size_t, Sums> sums_of_groups;
  Sums all;
  for (std::size_t i = 0; i < before_mm.size(); ++i) {
    const double weight = std::min(1.0, threshold / std::max({before_mm[i], after_mm[i], 1e-12}));
    const double moved = weight * moved_mm[i] * moved_mm[i];
    const double fall = huber_square(before_mm[i], threshold) - huber_square(after_mm[i], threshold);
    const Sums pose{0.5 * (fall + moved), moved};
    sums_of_groups[group[i]] += pose;
    all += pose;
  }
  Eigen::MatrixXd columns(2, static_cast<Eigen::Index>(sums_of_groups.size()));
  Eigen::Index next = 0;
  for (const auto& [first, sums] : sums_of_groups)
    columns.col(next++) = Eigen::Vector2d(sums.borne_out_mm2, sums.moved_mm2);
  std::vector<double> shares(kConfirmationDraws);
  for_each_resampling(std::move(columns), kConfirmationDraws, random, do_work,
                      [&](std::size_t draw, const double* sums) {
                        shares[draw] = Sums{sums[0], sums[1]}.share();
                      });
  return {all.share(), quantile(shares, 0.05)};
}

LargestMotion largest_motion(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states) {
  LargestMotion largest;
  for (const auto& [place, sizes] : motions_of(effect, robot, states)) {
    const double mean = std::accumulate(sizes.begin(), sizes.end(), 0.0) / static_cast<double>(sizes.size());
    double& most = place.second < 3 ? largest.shift_m : largest.turn_rad;
    for (const double size : sizes) most = std::max(most, std::abs(size - mean));
  }
  return largest;
}

LargestMotion farthest_motion(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states) {
  LargestMotion farthest;
  for (const auto& [place, sizes] : motions_of(effect, robot, states)) {
    double& most = place.second < 3 ? farthest.shift_m : farthest.turn_rad;
    for (const double size : sizes) most = std::max(most, std::abs(size));
  }
  return farthest;
}

Resampled resampled(const ResidualField& field, const Projection::Trial& trial, const Eigen::VectorXd& left, int draws,
                    RandomStream random, const DoWork& do_work) {
  const Eigen::Index m = trial.coefficients.size();
  const Eigen::MatrixXd whole = square_product(trial.fitted);
  Eigen::MatrixXd drawn(m, draws);
  for_each_resampling(pose_sums(field, trial, left), static_cast<std::uint32_t>(draws), random, do_work,
                      [&](std::size_t draw, const double* sums) {
                        const Eigen::Map<const Eigen::MatrixXd> sum(sums, m, m + 1);
                        drawn.col(static_cast<Eigen::Index>(draw)) =
                            solve_normal_equations(sum.leftCols(m), sum.col(m));
                      });
  Resampled result;
  const Eigen::RowVectorXd along = (whole * trial.coefficients).transpose() * drawn;
  result.sign_stability = static_cast<double>((along.array() > 0.0).count()) / draws;
  for (Eigen::Index i = 0; i < m; ++i) {
    std::vector<double> values(drawn.row(i).begin(), drawn.row(i).end());
    result.interval.push_back({quantile(values, 0.025), quantile(values, 0.975)});
  }
  return result;
}

bool has_impossible_coefficients(const Effect& effect) {
  return !law_of(effect).implausibility(effect).empty();
}

bool is_implausibly_large(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states) {
  const LargestMotion largest = largest_motion(effect, robot, states);
  return largest.turn_rad > kLargestTurn_rad || largest.shift_m > kLargestShift_m;
}

std::string implausibility(const Effect& effect, const DiagnosisProblem& problem, const DiagnosedModel& model,
                           const std::vector<ArmState>& states) {
  const LargestMotion largest = largest_motion(effect, problem.data.robot, states);
  if (largest.turn_rad <= kLargestTurn_rad && largest.shift_m <= kLargestShift_m)
    return law_of(effect).implausibility(effect);
  if (law_of(effect).proportional_to(effect) >= 0) {
    if (const double share = whole_share(effect, problem, model); share != 0.0) return unit_coupling(effect, share);
  }
  return "implausibly large for a real arm (> " +
         std::string(largest.turn_rad > kLargestTurn_rad ? "20 mrad" : "20 mm") + "): check signs, units and row order";
}

}  // namespace demecal::inline diagnosis
