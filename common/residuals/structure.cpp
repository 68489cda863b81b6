#include "residuals/structure.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "effects/arm_state.hpp"
#include "products/tall_products.hpp"
#include "random/distributions.hpp"
#include "residuals/found_noise.hpp"
#include "shared_work/agreement_draws.hpp"
#include "shared_work/null_noise.hpp"

namespace demecal::inline residuals {
namespace {

constexpr std::size_t kMostPosesTested = 1000;
constexpr std::size_t kFewLevels = 6;

/// A number a pose.
using Circumstance = std::vector<double>;

std::vector<std::size_t> evenly_spaced(std::size_t count) {
  const std::size_t taken = std::min(count, kMostPosesTested);
  std::vector<std::size_t> poses(taken);
  for (std::size_t i = 0; i < taken; ++i) poses[i] = i * count / taken;
  return poses;
}

std::vector<std::size_t> ascending_by(const Circumstance& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

Pairs neighbours(const Circumstance& values) {
  const std::vector<std::size_t> order = ascending_by(values);
  Pairs pairs;
  for (std::size_t i = 1; i < order.size(); ++i) pairs.push_back({order[i - 1], order[i]});
  return pairs;
}

/// Of few levels: everybody of a level in a ring, in steps that make every pose meet several others.
Pairs of_equal_level(const Circumstance& values) {
  std::map<double, std::vector<std::size_t>> levels;
  for (std::size_t i = 0; i < values.size(); ++i) levels[values[i]].push_back(i);
  Pairs pairs;
  constexpr std::size_t kSteps = 4;
  for (const auto& [level, poses] : levels) {
    for (std::size_t step = 1; step <= kSteps && 2 * step < poses.size(); ++step) {
      for (std::size_t i = 0; i < poses.size(); ++i) pairs.push_back({poses[i], poses[(i + step) % poses.size()]});
    }
  }
  return pairs;
}

Circumstance in_units_of_range(const Circumstance& values) {
  const auto [lower, upper] = std::minmax_element(values.begin(), values.end());
  const double offset = *lower, range = *upper - *lower;
  Circumstance scaled = values;
  for (double& value : scaled) value = range > 0 ? (value - offset) / range : 0.0;
  return scaled;
}

Pairs nearest_in_plane(const Circumstance& first, const Circumstance& second) {
  const Circumstance x = in_units_of_range(first), y = in_units_of_range(second);
  Pairs pairs;
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::size_t nearest = i;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double distance = std::pow(x[i] - x[k], 2) + std::pow(y[i] - y[k], 2);
      if (k != i && distance < least) {
        least = distance;
        nearest = k;
      }
    }
    if (nearest != i) pairs.push_back({i, nearest});
  }
  return pairs;
}

bool varies(const Circumstance& values) {
  const auto [lower, upper] = std::minmax_element(values.begin(), values.end());
  return lower != values.end() && *upper - *lower > 1e-9;
}

void add_circumstance(std::vector<Pairs>& all, const Circumstance& values) {
  if (!varies(values)) return;
  const std::set<double> levels(values.begin(), values.end());
  all.push_back(levels.size() <= kFewLevels ? of_equal_level(values) : neighbours(values));
}

std::vector<Pairs> circumstances(const ResidualField& field, const std::vector<std::size_t>& poses,
                                 const Chain& chain) {
  std::vector<Pairs> all;
  const auto take = [&](auto value) {
    Circumstance values;
    for (const std::size_t pose : poses) values.push_back(value(field.states[pose]));
    return values;
  };
  std::vector<Circumstance> joints;
  for (int i = 0; i < chain.size(); ++i) {
    joints.push_back(take([&](const ArmState& state) { return state.joints()[i]; }));
    add_circumstance(all, joints.back());
    add_circumstance(all, take([&](const ArmState& state) { return state.approach(i); }));
    add_circumstance(all, take([&](const ArmState& state) { return state.torque(chain, i); }));
    add_circumstance(all, take([&](const ArmState& state) { return state.drive_torque(i); }));
  }
  add_circumstance(all, take([](const ArmState& state) { return state.stop.payload_kg; }));
  add_circumstance(all, take([](const ArmState& state) { return state.stop.temperature_celsius.value_or(0.0); }));
  add_circumstance(all, take([](const ArmState& state) { return state.stop.time_s.value_or(0.0); }));
  for (std::size_t i = 0; i < joints.size(); ++i) {
    for (std::size_t k = i + 1; k < joints.size(); ++k) {
      if (varies(joints[i]) && varies(joints[k])) all.push_back(nearest_in_plane(joints[i], joints[k]));
    }
  }
  return all;
}

/// What a radian (or metre) of each joint does to the rows of some poses, one pose after another, and how long these
/// columns are, pose by pose.
struct JointColumns {
  RowMatrix columns, lengths;
};
JointColumns moved_by_joints(const ResidualField& field, const std::vector<std::size_t>& poses, const Chain& chain) {
  Eigen::Index rows = 0;
  for (const std::size_t pose : poses) rows += field.rows_of_pose(pose);
  JointColumns joints{RowMatrix(rows, chain.size()), RowMatrix(static_cast<Eigen::Index>(poses.size()), chain.size())};
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Index first = field.first_row[poses[i]], count = field.rows_of_pose(poses[i]);
    for (int joint = 0; joint < chain.size(); ++joint) {
      const int axis = is_revolute(chain, joint) ? kTurnAboutZ : 2;
      const auto column = field.motions.block(first, motion_column(joint, axis), count, 1);
      joints.columns.block(at, joint, count, 1) = column;
      joints.lengths(static_cast<Eigen::Index>(i), joint) = column.norm();
    }
    at += count;
  }
  return joints;
}

}  // namespace

double structure_p_value(const ResidualField& field, const Projection& model, const Chain& chain, int draws,
                         RandomStream random, const DoWork& make) {
  const std::vector<std::size_t> poses = evenly_spaced(field.poses.size());
  if (poses.size() < 4) return 1.0;
  const std::vector<Pairs> all = circumstances(field, poses, chain);
  if (all.empty()) return 1.0;
  NullResiduals of_noise = null_residuals(field, model, poses);
  const Eigen::VectorXd residual = model.residual()(of_noise.rows());
  JointColumns joints = moved_by_joints(field, poses, chain);
  const AgreementDraws work(std::move(of_noise), std::move(joints.columns), std::move(joints.lengths), all,
                            DrawCount{static_cast<std::uint32_t>(draws), random.name()});
  const Eigen::VectorXd seen = work.agreements(residual);
  Eigen::MatrixXd null(seen.size(), draws);
  double* next = null.data();
  for (const std::vector<double>& piece : make(work)) next = std::ranges::copy(piece, next).out;
  const Eigen::VectorXd mean = null.rowwise().mean();
  const Eigen::VectorXd deviation =
      ((null.colwise() - mean).rowwise().squaredNorm() / std::max(1, draws - 1)).cwiseSqrt().cwiseMax(1e-12);
  const double largest = ((seen - mean).cwiseQuotient(deviation)).maxCoeff();
  int beyond = 0;
  for (int i = 0; i < draws; ++i) {
    beyond += (null.col(i) - mean).cwiseQuotient(deviation).maxCoeff() >= largest;
  }
  return (1.0 + beyond) / (1.0 + draws);
}

std::optional<PureError> pure_error(const DataSet& data, std::span<const std::size_t> poses, const RowScales& scales) {
  // What repeats from either side differ by is lost motion, and no noise.
  std::map<std::tuple<std::string, std::string, std::string, std::vector<double>>, std::vector<std::size_t>> repeats;
  for (const std::size_t pose : poses) {
    const MeasuredPose& at = data.poses[pose];
    if (!at.position_m || at.pose_id.empty()) continue;
    std::vector<double> sides;
    if (at.approach) sides.assign(at.approach->begin(), at.approach->end());
    repeats[{at.pose_id, at.target, at.station, sides}].push_back(pose);
  }
  PureError error;
  for (const auto& [id, group] : repeats) {
    if (group.size() < 2) continue;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const std::size_t pose : group) mean += *data.poses[pose].position_m / static_cast<double>(group.size());
    const double factor = scales.factor(data.poses[group.front()], kPosition);  // of one station
    for (const std::size_t pose : group)
      error.squares += ((*data.poses[pose].position_m - mean) / factor).squaredNorm();
    error.freedom += 3.0 * static_cast<double>(group.size() - 1);
  }
  if (error.freedom == 0.0) return std::nullopt;
  error.deviation_m = std::sqrt(error.squares / error.freedom);
  return error;
}

double lack_of_fit_p_value(const PureError& pure, double squares_m2, double freedom) {
  const double more = freedom - pure.freedom, excess = squares_m2 - pure.squares;
  if (more <= 0.0 || excess <= 0.0) return 1.0;
  if (pure.squares <= 0.0) return 0.0;
  const double ratio = (excess / more) / (pure.squares / pure.freedom);
  return fisher_p_value(ratio, more, pure.freedom);
}

}  // namespace demecal::inline residuals
