#include "closed_calibration/calibrated_model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "decompositions/decompositions.hpp"
#include "diagnosis/loop.hpp"
#include "fitting/least_squares.hpp"
#include "pieces/pieces.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"
#include "residuals/structure.hpp"

namespace demecal::inline closed_calibration {
namespace {

/// The poses that the model's numbers come from.
std::vector<std::size_t> fitted_poses(const DataSet& data, const Calibration& calibration) {
  return calibration.unseen ? poses_of_last_fit(data) : poses_of(data, PoseSet::calibration);
}

/// How the residuals scatter; orientations of a target that is mounted otherwise than its tool do not count.
RowScales scatter_of(const DataSet& data, const CorrectedRobot& robot, const std::vector<Observation>& observations) {
  constexpr double kSmallest = 1e-9;
  RowScales scales = median_deviations(data, robot, observations);
  for (double& scale : scales) scale = scale > 0.0 ? std::max(scale, kSmallest) : scale;
  if (mounted_otherwise(data, robot, observations)) scales[kOrientation] = 0.0;
  return scales;
}

/// The variance of rows of unit scale, by what they leave; larger where few are left to estimate it from (Student).
double row_variance(const Projection& projection) {
  constexpr double kFewest = 3.0;
  const double freedom = std::max(projection.freedom(), kFewest);
  return std::max(1.0, projection.squares() / freedom) * freedom / std::max(1.0, freedom - 2.0);
}

/// Adds what base and tool could share out between them unseen: nothing is believed of either, so that least squares
/// holds one of them fast.
void widen(const Linearization& linearization, Eigen::MatrixXd& covariance) {
  constexpr double kUnseen = 1e-9, kTool_m = 1e-2, kTool_rad = 0.1, kBase = 10.0;
  std::vector<Eigen::Index> places;
  std::vector<double> usual;
  for (std::size_t i = 0; i < linearization.ids.size(); ++i) {
    const ParameterId& id = linearization.ids[i];
    if (!id.is_of_base() && !id.is_of_tool()) continue;
    places.push_back(static_cast<Eigen::Index>(i));
    usual.push_back(id.is_of_base() ? kBase : id.is_angle() ? kTool_rad : kTool_m);
  }
  if (places.empty()) return;
  const Eigen::VectorXd unit = Eigen::Map<const Eigen::VectorXd>(usual.data(), std::ssize(usual));
  const Eigen::MatrixXd columns = linearization.fitted.declared(Eigen::all, places) * unit.asDiagonal();
  const auto eigen = eigen_system(columns.transpose() * columns);
  const double largest = eigen.values.maxCoeff();
  for (Eigen::Index k = 0; k < unit.size(); ++k) {
    if (eigen.values[k] > kUnseen * largest) continue;
    const Eigen::VectorXd unseen = unit.asDiagonal() * eigen.vectors.col(k);
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < places.size(); ++j) {
        covariance(places[i], places[j]) += unseen[static_cast<Eigen::Index>(i)] * unseen[static_cast<Eigen::Index>(j)];
      }
    }
  }
}

/// The rows `kept` of a triangular matrix whose product with its transpose is the covariance.
Eigen::MatrixXd triangular_root(const Eigen::MatrixXd& covariance) {
  if (covariance.rows() == 0) return covariance;
  const Eigen::VectorXd deviations = covariance.diagonal().cwiseMax(1e-40).cwiseSqrt();
  const Eigen::MatrixXd correlation =
      deviations.cwiseInverse().asDiagonal() * covariance * deviations.cwiseInverse().asDiagonal();
  const auto eigen = eigen_system(correlation);
  const Eigen::MatrixXd root = eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
  return deviations.asDiagonal() * upper_factor(root.transpose()).transpose();
}

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

class PredictionScores {
 public:
  PredictionScores(const DataSet& data, const FittedPosterior& fitted, const CorrectedRobot& robot) : data_(data) {
    add_poses(poses_of(data, PoseSet::validation), fitted, robot);
    interval_.fitted = scored_.empty();
    if (scored_.empty()) add_poses(poses_of(data, PoseSet::calibration), fitted, robot);
    set_noise(fitted.scatter);
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

  int fewest_axes() const { return std::ranges::min(scored_, {}, &ScoredPose::axes).axes; }

  void add_poses(const std::vector<std::size_t>& poses, const FittedPosterior& fitted, const CorrectedRobot& robot) {
    const std::vector<double> errors_m = tool_errors_m(robot, data_, poses);
    std::vector<double> posterior_m2(poses.size());
    in_batches(poses.size(), [&](std::size_t i) {
      posterior_m2[i] = posterior_square_m2(fitted.posterior, robot, data_, data_.poses[poses[i]]);
    });
    for (std::size_t i = 0; i < poses.size(); ++i) add_pose(poses[i], errors_m[i], posterior_m2[i]);
  }

  void add_pose(std::size_t index, double error_m, double posterior_m2) {
    const MeasuredPose& pose = data_.poses[index];
    if (!std::isfinite(error_m)) return;
    const std::string name = pose.pose_id.empty() ? "line " + std::to_string(pose.line) : pose.pose_id;
    const std::size_t group = groups_.try_emplace(name, groups_.size()).first->second;
    const int axes = point_axes(pose);
    scored_.push_back({index, group, axes, error_m * error_m, posterior_m2});
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
  double score(const ScoredPose& one) const {
    constexpr double kMostHidden = 0.75;
    const double noise_m2 = noise_square_m2(interval_, data_.poses[one.pose]);
    const double posterior_m2 =
        interval_.fitted ? -std::min(one.posterior_m2, kMostHidden * noise_m2) : one.posterior_m2;
    return std::sqrt(one.error_m2 / (noise_m2 + posterior_m2));
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
    const double most_m2 = sum_m2 + std::sqrt(spread_m4);
    if (most_m2 > 0.0) interval_.model_error_m = std::sqrt(most_m2 / axes);
  }

  const DataSet& data_;
  PredictionInterval interval_;
  std::map<std::string, std::size_t> groups_;
  std::vector<ScoredPose> scored_;
};

}  // namespace

FittedPosterior fitted_posterior(const DataSet& data, const DeclaredModel& declared, const CorrectedRobot& robot,
                                 const std::vector<std::size_t>& poses) {
  constexpr double kLeastTerm = 1e-7;  ///< rad
  DiagnosedModel model;
  model.robot = with_own_contacts(robot, data, poses);
  model.smooth = smooth_corrections(data, poses, robot, declared.joint_corrections, declared.joint_offset);
  model.scales = scatter_of(data, model.robot, observe(data, poses, robot));
  const Linearization linearization = linearize({data, declared, poses, {}}, model);
  const double variance = row_variance(linearization.projection);
  Eigen::MatrixXd covariance = variance * linearization.covariance;
  widen(linearization, covariance);
  FittedPosterior fitted{{{}, {}, {}}, model.scales};
  for (double& scale : fitted.scatter) scale *= std::sqrt(variance);
  Posterior& posterior = fitted.posterior;
  std::vector<Eigen::Index> kept;  // all but contacts' and stations' places: what they take is in the rest's covariance
  for (std::size_t i = 0; i < linearization.ids.size(); ++i) {
    const ParameterId::Kind kind = linearization.ids[i].kind;
    if (kind == ParameterId::Kind::contact || kind == ParameterId::Kind::station) continue;
    posterior.ids.push_back(linearization.ids[i]);
    kept.push_back(static_cast<Eigen::Index>(i));
  }
  for (std::size_t i = 0; i < model.smooth.terms.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(linearization.ids.size() + i);
    if (!(covariance(row, row) > kLeastTerm * kLeastTerm)) continue;
    const SmoothTerm& term = model.smooth.terms[i];
    const auto joint = static_cast<std::size_t>(term.joint);
    posterior.terms.push_back({term.joint, {term.formula, model.smooth.branches[joint], model.smooth.ranges[joint]}});
    kept.push_back(row);
  }
  posterior.factor = triangular_root(covariance(kept, kept));
  return fitted;
}

Posterior posterior_of(const DataSet& data, const DeclaredModel& declared, const Calibration& calibration) {
  return fitted_posterior(data, declared, calibration.robot, fitted_poses(data, calibration)).posterior;
}

std::vector<Interval> measured_ranges(const DataSet& data, const Calibration& calibration) {
  std::vector<Interval> ranges;
  for (const std::size_t pose : fitted_poses(data, calibration)) {
    const JointVector& joints = data.poses[pose].joints;
    for (int joint = 0; joint < joints.size(); ++joint) {
      if (std::ssize(ranges) == joint) ranges.push_back({joints[joint], joints[joint]});
      Interval& range = ranges[static_cast<std::size_t>(joint)];
      range.lower = std::min(range.lower, joints[joint]);
      range.upper = std::max(range.upper, joints[joint]);
    }
  }
  return ranges;
}

PredictionInterval prediction_interval(const DataSet& data, const FittedPosterior& fitted,
                                       const CorrectedRobot& robot) {
  return PredictionScores(data, fitted, robot).interval();
}

PredictionInterval interval_of(const DataSet& data, const DeclaredModel& declared, const Calibration& calibration) {
  if (calibration.unseen) return calibration.unseen->interval;
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  return prediction_interval(data, fitted_posterior(data, declared, calibration.robot, poses), calibration.robot);
}

}  // namespace demecal::inline closed_calibration
