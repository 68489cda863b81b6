#include "calibration/prediction_scores.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "diagnosis/structure.hpp"
#include "effects/measurement.hpp"
#include "fitting/distributions.hpp"
#include "fitting/median.hpp"

namespace demecal {
namespace {

/// Of one pose: the square of its tool error, what the posterior adds to it, and in how many axes noise does. m^2.
struct JudgedPose {
  std::size_t pose = 0;
  std::size_t group = 0;
  int axes = 0;
  double error_m2 = 0.0, posterior_m2 = 0.0;
};

class Judgements {
 public:
  Judgements(const DataSet& data, const FittedPosterior& fitted, const CorrectedRobot& robot) : data_(data) {
    const std::vector<std::size_t> validation = poses_of(data, PoseSet::validation);
    for (const std::size_t pose : validation) judge(pose, fitted, robot);
    interval_.fitted = judged_.empty();
    if (judged_.empty()) {
      for (const std::size_t pose : poses_of(data, PoseSet::calibration)) judge(pose, fitted, robot);
    }
    set_noise(fitted.scatter);
  }

  PredictionInterval interval() {
    leave_out_gross_errors();
    if (!interval_.fitted) set_model_error();
    std::vector<double> scores;
    std::vector<std::size_t> groups;
    for (const JudgedPose& one : judged_) {
      scores.push_back(score(one));
      groups.push_back(one.group);
    }
    std::vector<std::size_t> distinct = groups;
    std::ranges::sort(distinct);
    distinct.erase(std::ranges::unique(distinct).begin(), distinct.end());
    interval_.poses = distinct.size();
    interval_.quantile = conformal_quantile(scores, groups, kIntervalShare);
    if (!std::isfinite(interval_.quantile))
      interval_.quantile =
          scores.empty() ? normal_quantile() : normal_quantile_of_scores(scores, groups, fewest_axes(), kIntervalShare);
    return interval_;
  }

 private:
  /// Of three axes, where no pose tells more.
  static double normal_quantile() { return normal_length_quantile(3, kIntervalShare) / std::sqrt(3.0); }

  int fewest_axes() const { return std::ranges::min(judged_, {}, &JudgedPose::axes).axes; }

  void judge(std::size_t index, const FittedPosterior& fitted, const CorrectedRobot& robot) {
    const MeasuredPose& pose = data_.poses[index];
    const double error_m = tool_error_m(robot, data_, pose);
    if (!std::isfinite(error_m)) return;
    const std::string name = pose.pose_id.empty() ? "line " + std::to_string(pose.line) : pose.pose_id;
    const std::size_t group = groups_.try_emplace(name, groups_.size()).first->second;
    const int axes = pose.position_m ? 3 : std::min(3, static_cast<int>(pose.distances_m.size()));
    judged_.push_back(
        {index, group, axes, error_m * error_m, posterior_square_m2(fitted.posterior, robot, data_, pose)});
  }

  /// Noise is what repeats show, or else what the fit left; of calibration poses model error is the rest of that.
  void set_noise(const RowScales& scatter) {
    std::vector<std::size_t> all(data_.poses.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    interval_.noise_m = scatter[kPosition];
    interval_.distance_noise_m = scatter[kDistance];
    const std::optional<PureError> repeats = pure_error(data_, all);
    if (!repeats) return;
    interval_.noise_m = std::min(repeats->deviation_m, scatter[kPosition]);
    if (interval_.fitted)
      interval_.model_error_m = std::sqrt(std::pow(scatter[kPosition], 2) - std::pow(interval_.noise_m, 2));
  }

  /// |error| over its deviation. A fit hides of its own poses' errors what it learnt from them: as much as its
  /// posterior has, and never more than three quarters.
  double score(const JudgedPose& one) const {
    constexpr double kMostHidden = 0.75;
    const double noise_m2 = noise_square_m2(interval_, data_.poses[one.pose]);
    const double posterior_m2 =
        interval_.fitted ? -std::min(one.posterior_m2, kMostHidden * noise_m2) : one.posterior_m2;
    return std::sqrt(one.error_m2 / (noise_m2 + posterior_m2));
  }

  void leave_out_gross_errors() {
    constexpr double kGross = 10.0;
    if (judged_.empty()) return;
    std::vector<double> scores;
    for (const JudgedPose& one : judged_) scores.push_back(score(one));
    const double most = kGross * median(scores);
    interval_.gross_errors = static_cast<std::size_t>(
        std::erase_if(judged_, [&](const JudgedPose& one) { return most > 0.0 && score(one) > most; }));
  }

  /// What unseen poses show beyond noise and posterior, per axis.
  void set_model_error() {
    double excess_m2 = 0.0, axes = 0.0;
    for (const JudgedPose& one : judged_) {
      const MeasuredPose& pose = data_.poses[one.pose];
      excess_m2 += one.error_m2 - one.posterior_m2 - noise_square_m2(interval_, pose);
      axes += pose.position_m ? 3.0 : 1.0;
    }
    if (excess_m2 > 0.0) interval_.model_error_m = std::sqrt(excess_m2 / axes);
  }

  const DataSet& data_;
  PredictionInterval interval_;
  std::map<std::string, std::size_t> groups_;
  std::vector<JudgedPose> judged_;
};

}  // namespace

PredictionInterval prediction_interval(const DataSet& data, const FittedPosterior& fitted,
                                       const CorrectedRobot& robot) {
  return Judgements(data, fitted, robot).interval();
}

PredictionInterval interval_of(const DataSet& data, const DeclaredModel& declared, const Calibration& calibration) {
  if (calibration.unseen) return calibration.unseen->interval;
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  return prediction_interval(data, fitted_posterior(data, declared, calibration.robot, poses), calibration.robot);
}

}  // namespace demecal
