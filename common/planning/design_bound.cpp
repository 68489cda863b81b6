#include "planning/design_bound.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "planning/moved_pose.hpp"
#include "planning/travel.hpp"

namespace demecal::inline planning {
namespace {

constexpr int kSearches = 4, kWeightSteps = 60;
constexpr std::size_t kClimbs = 30;  ///< of a search, from the steepest poses so far
constexpr int kClimbTries = 100;
constexpr double kFirstWidth = 0.15, kClimbNarrowing = 0.97;  ///< of a joint's range
constexpr double kShareOfFound = 0.1;                         ///< of all weights, for the poses that a search found

/// Poses that are measured any number of times each, fractions of one included.
class WeightedDesign {
 public:
  WeightedDesign(Eigen::MatrixXd known, Eigen::MatrixXd weight, double count)
      : known_(std::move(known)), weight_(std::move(weight)), count_(count) {}

  /// Further poses, one after another, `per_pose` rows each; they share `share` of the measurements.
  void add(const Eigen::MatrixXd& rows, int per_pose, double share) {
    per_pose_ = per_pose;
    const Eigen::Index before = times_.size(), added = rows.rows() / per_pose;
    rows_.conservativeResize(rows_.rows() + rows.rows(), rows.cols());
    rows_.bottomRows(rows.rows()) = rows;
    times_ *= 1.0 - share;
    times_.conservativeResize(before + added);
    times_.tail(added).setConstant(share * count_ / static_cast<double>(added));
    learn();
  }

  void improve(int steps) {
    for (int step = 0; step < steps; ++step) {
      const Eigen::VectorXd wanted = times_.cwiseProduct(slopes_.cwiseSqrt());
      if (!(wanted.sum() > 0.0)) return;
      times_ = wanted * (count_ / wanted.sum());
      learn();
    }
  }

  /// By how much the expected squared error falls with a pose, for each small share of a measurement.
  double slope(const Eigen::MatrixXd& rows) const { return (rows * falls_).cwiseProduct(rows).sum(); }
  const Eigen::VectorXd& slopes() const { return slopes_; }
  /// What no weights of any poses get below of which none is steeper than `steepest`.
  double bound_m2(double steepest) const {
    const double left = std::max(0.0, count_ * steepest - times_.dot(slopes_));
    return square_m2_ / (1.0 + left / square_m2_);
  }

 private:
  void learn() {
    Eigen::MatrixXd scaled = rows_;
    for (Eigen::Index i = 0; i < times_.size(); ++i)
      scaled.middleRows(i * per_pose_, per_pose_) *= std::sqrt(times_[i]);
    Eigen::MatrixXd information = known_ + Eigen::MatrixXd::Identity(known_.rows(), known_.cols());
    information.noalias() += scaled.transpose() * scaled;
    const Eigen::MatrixXd covariance = Cholesky(information).inverse();
    square_m2_ = weight_.cwiseProduct(covariance).sum();
    falls_ = covariance * weight_ * covariance;
    const Eigen::VectorXd of_rows = (rows_ * falls_).cwiseProduct(rows_).rowwise().sum();
    slopes_ = of_rows.reshaped(per_pose_, times_.size()).colwise().sum().transpose();
  }

  Eigen::MatrixXd known_, weight_;
  double count_;
  int per_pose_ = 1;
  Eigen::MatrixXd rows_;
  Eigen::VectorXd times_;  ///< how often each pose is measured
  Eigen::MatrixXd falls_;  ///< the error's derivative by the information, sign changed
  Eigen::VectorXd slopes_;
  double square_m2_ = 0.0;
};

/// The pose that a climb from `pose` leads to, and its slope.
std::pair<PlannedPose, double> climbed(const WeightedDesign& design, const InformationModel& model,
                                       const FeasibleSpace& space, PlannedPose pose, RandomStream& random) {
  double steepest = design.slope(model.measured_rows(pose));
  double width = kFirstWidth;
  for (int attempt = 0; attempt < kClimbTries; ++attempt, width *= kClimbNarrowing) {
    auto tried = moved_pose(space, model.model().sockets, pose, width, random);
    if (!tried) continue;
    const double slope = design.slope(model.measured_rows(*tried));
    if (!(slope > steepest) || !is_feasible(space, *tried)) continue;
    steepest = slope;
    pose = std::move(*tried);
  }
  return {std::move(pose), steepest};
}

/// Indices of the largest values, the largest first.
std::vector<std::size_t> indices_of_largest(const Eigen::VectorXd& values, std::size_t count) {
  std::vector<std::size_t> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t one, std::size_t other) {
    return values[static_cast<Eigen::Index>(one)] > values[static_cast<Eigen::Index>(other)];
  });
  order.resize(std::min(count, order.size()));
  return order;
}

}  // namespace

double least_square_m2(const InformationModel& model, const FeasibleSpace& space, std::vector<PlannedPose> poses,
                       const Eigen::MatrixXd& known, const Eigen::MatrixXd& weight, std::size_t count,
                       RandomStream random) {
  WeightedDesign design(known, weight, static_cast<double>(count));
  design.add(stacked_rows(model, poses), model.rows_per_pose(), 1.0);
  double bound_m2 = 0.0;
  for (int search = 0; search < kSearches; ++search) {
    design.improve(kWeightSteps);
    double steepest = design.slopes().maxCoeff();
    std::vector<PlannedPose> found;
    for (const std::size_t i : indices_of_largest(design.slopes(), kClimbs)) {
      auto [pose, slope] = climbed(design, model, space, poses[i], random);
      steepest = std::max(steepest, slope);
      found.push_back(std::move(pose));
    }
    bound_m2 = design.bound_m2(steepest);
    if (search + 1 == kSearches) break;
    design.add(stacked_rows(model, found), model.rows_per_pose(), kShareOfFound);
    std::ranges::move(found, std::back_inserter(poses));
  }
  return bound_m2;
}

}  // namespace demecal::inline planning
