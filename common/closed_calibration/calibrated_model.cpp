#include "closed_calibration/calibrated_model.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "diagnosis/loop.hpp"
#include "fitting/least_squares.hpp"
#include "fitting/station_scales.hpp"
#include "kinematics/chain.hpp"
#include "prediction/measurement.hpp"
#include "products/tall_products.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/noise_estimation.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"
#include "residuals/smooth_corrections.hpp"

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
  return scales_of_stations(data, robot, observations, scales);
}

/// The variance of rows of unit scale, by what they leave; larger where few are left to estimate it from (Student).
/// What is believed of errors that poses share counts as so many rows more.
double row_variance(const Projection& projection) {
  constexpr double kFewest = 3.0;
  const Eigen::Index shared = projection.shared();
  const double believed = static_cast<double>(shared) - projection.prior_basis().bottomRows(shared).squaredNorm();
  const double freedom = std::max(projection.freedom() + believed, kFewest);
  return std::max(1.0, projection.squares() / freedom) * freedom / std::max(1.0, freedom - 2.0);
}

/// What the residuals show. Of contacts nothing, whose places move with the arm.
NoiseEstimate noise_of(const DiagnosisProblem& problem, const Linearization& linearization,
                       const DiagnosedModel& model) {
  if (has_contacts(problem.data)) return {};
  return noise_shown(problem, linearization, model).value_or(NoiseEstimate{});
}

/// What joints have in the scatter of positions, per axis, where that is more than half of it: less may be the noise of
/// an instrument, which grows with the distance as theirs does.
double arm_scatter_m(const DataSet& data, const ResidualField& field, const NoiseModel& noise, double independent_m,
                     double position_scale_m) {
  double squares = 0.0, poses = 0.0;
  for (std::size_t i = 0; i < field.poses.size(); ++i) {
    if (!data.poses[field.poses[i]].position_m || field.root_weight[i] <= 0.0) continue;
    poses += 1.0;
    for (std::size_t joint = 0; joint < field.scattering.size(); ++joint) {
      const Eigen::Vector3d moved = field.motions.block<3, 1>(field.first_row[i], field.scattering[joint]);
      squares += noise.joint_variance_rad2(joint) * moved.squaredNorm() / std::pow(field.root_weight[i], 2);
    }
  }
  const double scatter_m = poses > 0.0 ? position_scale_m * std::sqrt(squares / (3.0 * poses)) : 0.0;
  return scatter_m > independent_m ? scatter_m : 0.0;
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

/// FNV-1a of the joints and of what was measured, to 1e-7 rad or m: units and ways of writing them aside.
std::uint64_t mark_of(const MeasuredPose& pose) {
  constexpr std::uint64_t kBasis = 0xcbf29ce484222325, kPrime = 0x100000001b3;
  constexpr double kPerUnit = 1e7;
  std::uint64_t mark = kBasis;
  const auto take = [&](double value) {
    const auto steps = static_cast<std::uint64_t>(std::llround(value * kPerUnit));
    for (int byte = 0; byte < 8; ++byte) mark = (mark ^ ((steps >> (8 * byte)) & 0xff)) * kPrime;
  };
  for (const double joint : pose.joints) take(joint);
  if (pose.position_m)
    for (const double along : *pose.position_m) take(along);
  for (const double distance_m : pose.distances_m) take(distance_m);
  return mark;
}

std::vector<std::uint64_t> smallest(const std::set<std::uint64_t>& marks) {
  std::vector<std::uint64_t> least(marks.begin(), marks.end());
  if (least.size() > kPoseMarks) least.resize(kPoseMarks);
  return least;
}

}  // namespace

FittedPosterior fitted_posterior(const DataSet& data, const DeclaredModel& declared, const CorrectedRobot& robot,
                                 const std::vector<std::size_t>& poses, const std::optional<NoiseEstimate>& known) {
  constexpr double kLeastTerm = 1e-7;  ///< rad
  DiagnosedModel model;
  model.robot = with_own_contacts(robot, data, poses);
  model.smooth = smooth_corrections(data, poses, robot, declared.joint_corrections, declared.joint_offset);
  model.scales = scatter_of(data, model.robot, observe(data, poses, robot));
  const DiagnosisProblem problem{data, declared, poses, {}};
  Linearization linearization = linearize(problem, model);
  FittedPosterior fitted{{{}, {}, {}}, model.scales};
  for (double& scale : fitted.scatter) scale *= std::sqrt(row_variance(linearization.projection));
  fitted.noise = known ? *known : noise_of(problem, linearization, model);
  const double scale_m = model.scales[kPosition];
  model = with_noise(std::move(model), linearization, fitted.noise);
  fitted.arm_scatter_m = arm_scatter_m(data, linearization.fitted, model.noise, model.scales[kPosition], scale_m);
  if (model.noise.repeats > 0.0 || model.noise.order > 0.0) linearization = linearize(problem, model);
  Eigen::MatrixXd covariance = row_variance(linearization.projection) * linearization.covariance;
  widen(linearization, covariance);
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
  // The interval is in deviations of a posterior with that noise.
  const auto noise = calibration.unseen ? std::optional(calibration.unseen->noise) : std::nullopt;
  return fitted_posterior(data, declared, calibration.robot, fitted_poses(data, calibration), noise).posterior;
}

std::size_t turn_step(double angle_rad) {
  const double turns = angle_rad / (2.0 * std::numbers::pi);
  const auto step = static_cast<int>((turns - std::floor(turns)) * kTurnSteps);
  return static_cast<std::size_t>(std::min(step, kTurnSteps - 1));
}

Widening widening_at(const CalibratedModel& model, const Stop& stop) {
  return widening(model.robot, {model.measured, model.measured_gaps}, stop);
}

bool is_outside_measured(const CalibratedModel& model, const Stop& stop, const Widening& there_by) {
  if (there_by.factor > kWorthFlagging) return true;
  if (there_by.held_radius_m() == 0.0 || !model.posterior || !model.interval) return false;
  return there_by.is_worth_flagging(real_radius95_m(*model.interval, *model.posterior, model.robot, stop));
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

std::map<int, std::vector<Interval>> measured_gaps(const DataSet& data, const Calibration& calibration) {
  constexpr double kLeast_rad = 0.35, kLeast_m = 0.1, kChance = 0.01;
  const std::vector<std::size_t> poses = fitted_poses(data, calibration);
  std::map<int, std::vector<Interval>> gaps;
  for (int joint = 0; joint < data.robot.chain.size(); ++joint) {
    const double least = is_revolute(data.robot.chain, joint) ? kLeast_rad : kLeast_m;
    std::vector<double> values;
    for (const std::size_t pose : poses) values.push_back(data.poses[pose].joints[joint]);
    std::ranges::sort(values);
    double different = 1.0;  // values that differ by a twentieth of what a gap is at least
    for (std::size_t i = 1; i < values.size(); ++i) different += values[i] - values[i - 1] > 0.05 * least ? 1.0 : 0.0;
    for (std::size_t i = 1; i < values.size(); ++i) {
      const double share = (values[i] - values[i - 1]) / (values.back() - values.front());
      if (values[i] - values[i - 1] >= least && different * std::pow(1.0 - share, different - 1.0) < kChance)
        gaps[joint].push_back({values[i - 1], values[i]});
    }
  }
  return gaps;
}

std::vector<std::uint64_t> pose_marks(const DataSet& data) {
  std::set<std::uint64_t> marks;  // repeats that agree in every digit count once
  for (const MeasuredPose& pose : data.poses)
    if (pose.set != PoseSet::accept) marks.insert(mark_of(pose));
  return smallest(marks);
}

std::vector<std::uint64_t> marks_of_both(const std::vector<std::uint64_t>& one,
                                         const std::vector<std::uint64_t>& other) {
  std::set<std::uint64_t> marks(one.begin(), one.end());
  marks.insert(other.begin(), other.end());
  return smallest(marks);
}

std::vector<std::size_t> marked_poses(const CalibratedModel& model, const DataSet& data) {
  std::vector<std::size_t> marked;
  for (std::size_t i = 0; i < data.poses.size() && !model.pose_marks.empty(); ++i)
    if (std::ranges::binary_search(model.pose_marks, mark_of(data.poses[i]))) marked.push_back(i);
  return marked;
}

std::map<int, std::vector<int>> pose_counts(const DataSet& data, const Calibration& calibration) {
  std::map<int, std::vector<int>> counts;
  for (int joint = 0; joint < data.robot.chain.size(); ++joint) {
    if (!is_revolute(data.robot.chain, joint)) continue;
    std::vector<int>& steps = counts[joint];
    steps.resize(kTurnSteps);
    for (const std::size_t pose : fitted_poses(data, calibration)) ++steps[turn_step(data.poses[pose].joints[joint])];
  }
  return counts;
}

PredictionInterval interval_of(const DataSet& data, const DeclaredModel& declared, const Calibration& calibration) {
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  PredictionInterval interval =
      calibration.unseen
          ? calibration.unseen->interval
          : prediction_interval(data, fitted_posterior(data, declared, calibration.robot, poses), calibration.robot);
  interval.along_path = follow_each_other(data);
  return interval;
}

}  // namespace demecal::inline closed_calibration
