#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "data/spread_poses.hpp"
#include "kinematics/chain.hpp"
#include "parameters/observation.hpp"
#include "parameters/posterior.hpp"
#include "pieces/pieces.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "prediction/only_places.hpp"
#include "random/distributions.hpp"
#include "residuals/structure.hpp"

namespace demecal::inline closed_calibration {
namespace {

/// Axes in which a pose's tool error has noise: of a touched plane one, of a measured point three.
int point_axes(const MeasuredPose& pose) {
  const MeasurementRows rows = rows_of(pose);
  if (rows.contact > 0) return rows.contact;
  return rows.position > 0 ? 3 : std::min(3, rows.distances);
}

/// Of one pose: the square of its tool error, what the posterior adds to it, and in how many axes noise does. m^2.
struct ScoredPose {
  std::size_t pose = 0;
  std::size_t group = 0;
  int axes = 0;
  double error_m2 = 0.0, posterior_m2 = 0.0;
};

constexpr std::size_t kFewestSeen = 20, kMostSeen = 1000;

struct CappedMean {
  double mean = 0.0, variance = 0.0;  ///< of the values up to `most`, and of that mean
};

CappedMean capped_mean(const std::vector<double>& values, double most) {
  const auto count = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double value : values) {
    const double capped = std::min(value, most);
    sum += capped;
    squares += capped * capped;
  }
  const double mean = sum / count;
  return {mean, count > 1.0 ? std::max(0.0, squares / count - mean * mean) / (count - 1.0) : 0.0};
}

class PredictionScores {
 public:
  PredictionScores(const DataSet& data, const FittedPosterior& fitted, const CorrectedRobot& robot)
      : data_(data), contacts_(contact_groups(data)), arm_scatter_m_(fitted.arm_scatter_m) {
    scored_ = scored(poses_of(data, PoseSet::validation), fitted, robot);
    interval_.fitted = scored_.empty();
    const std::vector<std::size_t> calibration = poses_of(data, PoseSet::calibration);
    if (scored_.empty()) scored_ = scored(calibration, fitted, robot);
    set_noise(fitted.scatter);
    if (!interval_.fitted && tell_the_noise(calibration))
      seen_ = scored(spread_poses(calibration, kMostSeen), fitted, robot);
  }

  PredictionInterval interval() {
    leave_out_gross_errors();
    if (!interval_.fitted) set_model_error();
    std::vector<double> scores;
    std::vector<std::size_t> groups;
    for (const ScoredPose& one : scored_) {
      scores.push_back(score(one));
      groups.push_back(one.group);
    }
    std::vector<std::size_t> distinct = groups;
    std::ranges::sort(distinct);
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    interval_.poses = distinct.size();
    interval_.quantile = conformal_quantile(scores, groups, kIntervalShare);
    if (!std::isfinite(interval_.quantile))
      interval_.quantile =
          scores.empty() ? normal_quantile() : normal_quantile_of_scores(scores, groups, fewest_axes(), kIntervalShare);
    count_scatter_of_arm();
    return interval_;
  }

 private:
  /// Of three axes, where no pose tells more.
  static double normal_quantile() { return normal_length_quantile(3, kIntervalShare) / std::sqrt(3.0); }

  int fewest_axes() const { return std::ranges::min(scored_, {}, &ScoredPose::axes).axes; }

  /// How much of a pose's squared error is left where its contact's place is taken from the poses themselves; of what
  /// was measured all of it.
  double share_left(const MeasuredPose& pose) const {
    if (pose.contact.empty()) return 1.0;
    return share_beyond_place(data_.contacts.form_of(pose.contact), contacts_.at(group_of(pose)).size());
  }

  std::vector<ScoredPose> scored(const std::vector<std::size_t>& poses, const FittedPosterior& fitted,
                                 const CorrectedRobot& robot) {
    const std::vector<double> errors_m = tool_errors_m(robot, data_, poses);
    std::vector<double> posterior_m2(poses.size());
    in_batches(poses.size(), [&](std::size_t i) {
      posterior_m2[i] = posterior_square_m2(fitted.posterior, robot, data_, data_.poses[poses[i]]);
    });
    std::vector<ScoredPose> all;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const MeasuredPose& pose = data_.poses[poses[i]];
      const double share = share_left(pose);
      if (!std::isfinite(errors_m[i]) || share == 0.0) continue;
      const std::string name = pose.pose_id.empty() ? "line " + std::to_string(pose.line) : pose.pose_id;
      const std::size_t group = groups_.try_emplace(name, groups_.size()).first->second;
      all.push_back({poses[i], group, point_axes(pose), errors_m[i] * errors_m[i] / share, posterior_m2[i]});
    }
    return all;
  }

  /// Whether what fitted poses leave is noise as unseen ones have it: points that nothing but the fit tells the noise
  /// of, and no path, whose neighbours share theirs.
  bool tell_the_noise(const std::vector<std::size_t>& poses) const {
    const auto is_point = [&](std::size_t pose) { return data_.poses[pose].position_m.has_value(); };
    const auto is_measured = [&](const ScoredPose& one) { return is_point(one.pose); };
    return poses.size() >= kFewestSeen && !by_repeats_ && std::ranges::all_of(poses, is_point) &&
           std::ranges::all_of(scored_, is_measured) && !follow_each_other(data_);
  }

  /// Noise is what repeats show, or else what the fit left; of calibration poses model error is the rest of that.
  void set_noise(const RowScales& scatter) {
    std::vector<std::size_t> all(data_.poses.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    interval_.noise_m = scatter[kPosition];
    interval_.distance_noise_m = scatter[kDistance];
    for (const auto& [station, factors] : scatter.stations)
      interval_.station_noise_m[station] = noise_of_station(station, scatter[kPosition] * factors[kPosition]);
    const std::optional<PureError> repeats = pure_error(data_, all);
    if (!repeats) return;
    by_repeats_ = true;
    interval_.noise_m = std::min(repeats->deviation_m, scatter[kPosition]);
    if (interval_.fitted)
      interval_.model_error_m = std::sqrt(std::pow(scatter[kPosition], 2) - std::pow(interval_.noise_m, 2));
  }

  double noise_of_station(const std::string& station, double scatter_m) const {
    std::vector<std::size_t> own;
    for (std::size_t pose = 0; pose < data_.poses.size(); ++pose)
      if (data_.poses[pose].station == station) own.push_back(pose);
    const std::optional<PureError> repeats = pure_error(data_, own);
    return repeats ? std::min(repeats->deviation_m, scatter_m) : scatter_m;
  }

  /// |error| over its deviation.
  double score(const ScoredPose& one) const {
    if (interval_.fitted) return seen_score(one);
    return std::sqrt(one.error_m2 / (noise_square_m2(interval_, data_.poses[one.pose]) + one.posterior_m2));
  }

  /// The same of a fitted pose. A fit hides of its own poses' errors what it learnt from them: as much as its posterior
  /// has, and never more than three quarters.
  double seen_score(const ScoredPose& one) const {
    constexpr double kMostHidden = 0.75;
    const double noise_m2 = noise_square_m2(interval_, data_.poses[one.pose]);
    return std::sqrt(one.error_m2 / (noise_m2 - std::min(one.posterior_m2, kMostHidden * noise_m2)));
  }

  /// An arm that scatters is off by it at a corrected position too: of the noise that measurements have with it, only
  /// the rest is no error of the model.
  void count_scatter_of_arm() {
    constexpr double kMost = 0.99;  // every instrument scatters
    double own_m = std::min(arm_scatter_m_, kMost * interval_.noise_m);
    for (const auto& [station, noise_m] : interval_.station_noise_m) own_m = std::min(own_m, kMost * noise_m);
    const auto without = [&](double noise_m) { return std::sqrt(noise_m * noise_m - own_m * own_m); };
    interval_.noise_m = without(interval_.noise_m);
    for (auto& [station, noise_m] : interval_.station_noise_m) noise_m = without(noise_m);
    interval_.model_error_m = std::hypot(interval_.model_error_m, own_m);
  }

  void leave_out_gross_errors() {
    constexpr double kGross = 10.0;
    if (scored_.empty()) return;
    std::vector<double> scores;
    for (const ScoredPose& one : scored_) scores.push_back(score(one));
    const double most = kGross * median(scores);
    interval_.gross_errors = static_cast<std::size_t>(
        std::erase_if(scored_, [&](const ScoredPose& one) { return most > 0.0 && score(one) > most; }));
  }

  /// What unseen poses show beyond noise and posterior, per axis, and one standard error of that: so few poses tell it
  /// badly, and an error that is small beside the noise would otherwise be taken for none every other time.
  void set_model_error() {
    const double most_m2 = seen_.empty() ? excess_over_noise_m2() : excess_over_seen_m2();
    if (most_m2 > 0.0) interval_.model_error_m = std::sqrt(most_m2);
  }

  double excess_over_noise_m2() const {
    double sum_m2 = 0.0, squares_m4 = 0.0, axes = 0.0;
    for (const ScoredPose& one : scored_) {
      const MeasuredPose& pose = data_.poses[one.pose];
      const double excess_m2 = one.error_m2 - one.posterior_m2 - noise_square_m2(interval_, pose);
      sum_m2 += excess_m2;
      squares_m4 += excess_m2 * excess_m2;
      axes += measures_point(pose) ? point_axes(pose) : 1.0;
    }
    const auto count = static_cast<double>(scored_.size());
    const double spread_m4 =
        count > 1.0 ? std::max(0.0, squares_m4 - sum_m2 * sum_m2 / count) * count / (count - 1.0) : 0.0;
    return (sum_m2 + std::sqrt(spread_m4)) / axes;
  }

  /// The same over what poses show that were fitted, whose noise is as unkind: of either the squares count up to twice
  /// the median, so that long tails of noise are not taken for errors of the model (Huber, 1964). With 0.8 standard
  /// errors: radii then hold what they should (docs/EVALUATION.md, radii at new poses).
  double excess_over_seen_m2() const {
    constexpr double kMost = 2.0, kErrors = 0.8;
    std::vector<double> unseen, seen;
    for (const ScoredPose& one : scored_) unseen.push_back(std::pow(score(one), 2));
    for (const ScoredPose& one : seen_) seen.push_back(std::pow(seen_score(one), 2));
    const double middle = median(seen), most = kMost * middle;
    double rising = 0.0;  // what the capped mean rises by where all squares do by one of themselves
    for (const double square : seen) rising += square < most ? square / static_cast<double>(seen.size()) : 0.0;
    const CappedMean of_unseen = capped_mean(unseen, most), of_seen = capped_mean(seen, most);
    const double error = std::sqrt(of_unseen.variance + of_seen.variance);
    const double usual = std::pow(normal_length_quantile(3, 0.5), 2) / 3.0;
    return (of_unseen.mean - of_seen.mean + kErrors * error) / rising * middle / usual * unit_of_scores_m2();
  }

  /// What one of a score's square is worth, per axis; where stations differ the harmonic mean of their poses.
  double unit_of_scores_m2() const {
    if (interval_.station_noise_m.empty()) return std::pow(interval_.noise_m, 2);
    double inverse = 0.0;
    for (const ScoredPose& one : scored_)
      inverse += 3.0 / noise_square_m2(interval_, data_.poses[one.pose]) / static_cast<double>(scored_.size());
    return 1.0 / inverse;
  }

  const DataSet& data_;
  const std::map<ContactGroup, std::vector<std::size_t>> contacts_;
  const double arm_scatter_m_;
  PredictionInterval interval_;
  std::map<std::string, std::size_t> groups_;
  std::vector<ScoredPose> scored_, seen_;  ///< seen_: calibration poses, where they tell the noise
  bool by_repeats_ = false;
};

}  // namespace

bool follow_each_other(const DataSet& data) {
  constexpr double kNear = 0.25, kStandsStill = 1e-6;
  constexpr std::size_t kFewest = 10;
  if (data.poses.size() < kFewest) return false;
  JointVector lower = data.poses.front().joints, upper = lower;
  for (const MeasuredPose& pose : data.poses) {
    lower = lower.cwiseMin(pose.joints);
    upper = upper.cwiseMax(pose.joints);
  }
  const JointVector range = (upper - lower).cwiseMax(kStandsStill);
  std::vector<double> steps;
  for (std::size_t i = 1; i < data.poses.size(); ++i) {
    const JointVector step = (data.poses[i].joints - data.poses[i - 1].joints).cwiseAbs();
    if (step.maxCoeff() > kStandsStill) steps.push_back(step.cwiseQuotient(range).maxCoeff());
  }
  if (steps.empty()) return false;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  return *middle < kNear;
}

PredictionInterval prediction_interval(const DataSet& data, const FittedPosterior& fitted,
                                       const CorrectedRobot& robot) {
  return PredictionScores(data, fitted, robot).interval();
}

}  // namespace demecal::inline closed_calibration
