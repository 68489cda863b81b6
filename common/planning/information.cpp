#include "planning/information.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "fitting/fit.hpp"
#include "fitting/row_sums.hpp"
#include "kinematics/forward.hpp"
#include "parameters/observation.hpp"
#include "parameters/posterior.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {
namespace {

constexpr double kPlace = 1.0;          ///< of base and tool, m and rad: anywhere, once found roughly
constexpr double kUsualMotion = 2e-3;   ///< of an effect, rad or m, as the closed loop believes
constexpr double kUsualTool_m = 20e-3;  ///< what a drawing leaves open of a tool point

CorrectedRobot robot_of(const PlannedModel& model) {
  CorrectedRobot robot = nominal_robot(model.nominal);
  robot.described = model.nominal.robot;
  robot.effects = model.effects;
  for (const PlannedSocket& socket : model.sockets)
    robot.contacts[{socket.name, PoseSet::calibration}].frame.translation() = socket.place_m;
  for (Effect& effect : robot.effects)
    effect.values.assign(law_of(effect).coefficients(effect, model.nominal.robot).size(), 0.0);
  return robot;
}

/// A pose as a data set would have it, measured by all targets; where it stands does not matter.
std::vector<MeasuredPose> as_measured(const PlannedModel& model, const PlannedPose& pose) {
  std::vector<std::string> targets{""};
  if (!model.nominal.tools_m.empty()) {
    targets.clear();
    for (const auto& [target, tool_m] : model.nominal.tools_m) targets.push_back(target);
  }
  std::vector<MeasuredPose> rows;
  for (const std::string& target : targets) {
    MeasuredPose row;
    row.joints = pose.joints;
    row.approach = pose.approach;
    if (pose.socket) {
      row.contact = model.sockets[*pose.socket].name;
    } else {
      row.position_m = Eigen::Vector3d::Zero();
    }
    if (model.orientation) row.orientation = Eigen::Quaterniond::Identity();
    row.target = target;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<ParameterId> planned_parameters(const PlannedModel& model, const CorrectedRobot& robot) {
  const JointVector anywhere = JointVector::Zero(model.nominal.robot.chain.size());
  DataSet one = model.nominal;
  one.poses = as_measured(model, {anywhere, {}});
  if (model.by_touch) {
    one.poses.front().position_m.reset();
    one.poses.front().contact = "any";
  }
  std::vector<ParameterId> ids = free_parameters(one, model.declared);
  one.poses.clear();
  for (std::size_t i = 0; i < model.sockets.size(); ++i)
    std::ranges::move(as_measured(model, {anywhere, {}, i}), std::back_inserter(one.poses));
  for (ParameterId& id : contact_parameters(one, poses_of(one, PoseSet::calibration))) ids.push_back(std::move(id));
  for (ParameterId& id : effect_parameters(robot)) ids.push_back(std::move(id));
  return ids;
}

double belief_of(const ParameterId& id, const FitOptions& options) {
  switch (id.kind) {
    case ParameterId::Kind::base_translation:
    case ParameterId::Kind::base_rotation:
    case ParameterId::Kind::tool_rotation:
    case ParameterId::Kind::contact:
    case ParameterId::Kind::station:
      return kPlace;
    case ParameterId::Kind::tool_translation:
      return kUsualTool_m;
    case ParameterId::Kind::link:
      return id.is_angle() ? options.prior_rad : options.prior_m;
    case ParameterId::Kind::effect:
      return kUsualMotion;
  }
  return kPlace;
}

/// How far a unit of every coefficient moves the arm, root mean square over its joints' limits.
std::vector<std::vector<double>> usual_motions(const PlannedModel& model) {
  constexpr int kDraws = 40;
  const Robot& robot = model.nominal.robot;
  RandomStream random{1, 2};  // the same whatever is asked
  std::vector<std::vector<double>> motions(model.effects.size());
  for (std::size_t i = 0; i < model.effects.size(); ++i)
    motions[i].assign(law_of(model.effects[i]).coefficients(model.effects[i], robot).size(), 0.0);
  for (int draw = 0; draw < kDraws; ++draw) {
    Stop stop(JointVector(robot.chain.size()));
    stop.approach = ApproachSigns::Ones(robot.chain.size());
    for (int k = 0; k < robot.chain.size(); ++k) {
      const Joint& joint = robot.chain.joints[static_cast<std::size_t>(k)];
      stop.joints[k] = random.real(joint.lower, joint.upper);
    }
    const ArmState state = arm_state(robot, stop);
    for (std::size_t i = 0; i < model.effects.size(); ++i) {
      std::vector<UnitMotion> units;
      append_unit_motions(model.effects[i], robot, state, units);
      for (const UnitMotion& unit : units)
        motions[i][static_cast<std::size_t>(unit.coefficient)] += unit.size * unit.size / kDraws;
    }
  }
  for (std::vector<double>& squares : motions)
    for (double& square : squares) square = std::sqrt(square);
  return motions;
}

}  // namespace

InformationModel::InformationModel(PlannedModel model)
    : model_(std::move(model)), space_(robot_of(model_), planned_parameters(model_, robot_of(model_))) {
  const FitOptions options;
  beliefs_.resize(space_.size());
  const std::vector<std::vector<double>> motions = usual_motions(model_);
  for (int i = 0; i < space_.size(); ++i) {
    const ParameterId& id = space_.ids()[static_cast<std::size_t>(i)];
    beliefs_[i] = belief_of(id, options);
    if (id.kind != ParameterId::Kind::effect) continue;
    const double motion = motions[static_cast<std::size_t>(id.index)][static_cast<std::size_t>(id.coefficient)];
    if (motion > 0.0) beliefs_[i] /= motion;
  }
  const std::size_t targets = std::max<std::size_t>(model_.nominal.tools_m.size(), 1);
  rows_per_pose_ = static_cast<int>(targets) * (model_.orientation ? 6 : 3);
}

DataSet InformationModel::data_of(const PlannedPose& pose) const {
  DataSet data = model_.nominal;
  data.poses = as_measured(model_, pose);
  return data;
}

ModelPoint InformationModel::nominal_point() const {
  return space_.at(Eigen::VectorXd::Zero(space_.size()));
}

Eigen::MatrixXd InformationModel::information_of_lengths() const {
  const Eigen::MatrixXd rows = relation_rows(model_.nominal, space_, nominal_point()).jacobian * beliefs_.asDiagonal();
  return rows.transpose() * rows;
}

Eigen::MatrixXd InformationModel::information_of(const DataSet& measured) const {
  std::vector<std::size_t> poses;
  for (std::size_t i = 0; i < measured.poses.size(); ++i)
    if (measured.poses[i].set == PoseSet::calibration) poses.push_back(i);
  const RowScales scales{model_.noise_m, model_.orientation ? model_.noise_rad : 0.0, model_.noise_m};
  const ModelPoint point = nominal_point();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(space_.size(), space_.size());
  ScaledRows rows;
  for (const Observation& observation : observe(measured, poses, space_.reference())) {
    scaled_rows(measured, space_, point, observation, scales, rows);
    const Eigen::MatrixXd in_beliefs = rows.jacobian * beliefs_.asDiagonal();
    sum += in_beliefs.transpose() * in_beliefs;
  }
  return sum;
}

Eigen::MatrixXd InformationModel::measured_rows(const PlannedPose& pose) const {
  const DataSet data = data_of(pose);
  std::vector<std::size_t> all(data.poses.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  const RowScales scales{model_.noise_m, model_.orientation ? model_.noise_rad : 0.0, 0.0};
  const ModelPoint point = nominal_point();
  Eigen::MatrixXd stacked(rows_per_pose_, space_.size());
  Eigen::Index first = 0;
  ScaledRows rows;
  for (const Observation& observation : observe(data, all, space_.reference())) {
    scaled_rows(data, space_, point, observation, scales, rows);
    stacked.middleRows(first, rows.jacobian.rows()) = rows.jacobian * beliefs_.asDiagonal();
    first += rows.jacobian.rows();
  }
  return stacked;
}

Eigen::MatrixXd InformationModel::tool_rows(const PlannedPose& pose) const {
  DataSet data = data_of({pose.joints, pose.approach});
  const std::size_t first = 0;
  data.poses.front().orientation.reset();
  const ModelPoint point = nominal_point();
  ScaledRows rows;
  const auto observations = observe(data, {&first, 1}, space_.reference());
  scaled_rows(data, space_, point, observations.front(), {1.0, 0.0, 0.0}, rows);
  return rows.jacobian * beliefs_.asDiagonal();
}

ScaledJacobian InformationModel::jacobian(const std::vector<PlannedPose>& poses) const {
  TriangularFactor factor(space_.size());
  for (const PlannedPose& pose : poses) factor.add(measured_rows(pose) * beliefs_.cwiseInverse().asDiagonal());
  return ScaledJacobian(factor.factor());
}

Eigen::MatrixXd stacked_rows(const InformationModel& model, std::span<const PlannedPose> poses) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(poses.size()) * model.rows_per_pose(),
                       static_cast<Eigen::Index>(model.ids().size()));
  for (std::size_t i = 0; i < poses.size(); ++i)
    rows.middleRows(static_cast<Eigen::Index>(i) * model.rows_per_pose(), model.rows_per_pose()) =
        model.measured_rows(poses[i]);
  return rows;
}

Workspace::Workspace(const InformationModel& model, const std::vector<PlannedPose>& places) {
  const auto n = static_cast<Eigen::Index>(model.ids().size());
  for (const PlannedPose& place : places) rows_.push_back(model.tool_rows(place));
  if (model.model().by_touch) {
    std::vector<Eigen::Vector3d> points_m;
    for (const PlannedPose& place : places)
      points_m.push_back(tool_position(model.model().nominal.robot.chain, place.joints));
    leave_out_motion_as_a_whole(points_m, rows_);
  }
  weight_ = Eigen::MatrixXd::Zero(n, n);
  for (const Eigen::MatrixXd& rows : rows_) weight_ += rows.transpose() * rows;
  weight_ /= static_cast<double>(places.size());
}

PredictedError Workspace::predicted(const Eigen::MatrixXd& covariance) const {
  constexpr int kDraws = 20;
  RandomStream random{1, 1};  // the same draws whatever is asked
  std::vector<double> errors;
  for (const Eigen::MatrixXd& rows : rows_) {
    const Eigen::Matrix3d of_tool = rows * covariance * rows.transpose();
    const auto eigen = eigen_system_of_three(of_tool);
    const Eigen::Vector3d deviations = eigen.values.cwiseMax(0.0).cwiseSqrt();
    for (int i = 0; i < kDraws; ++i) {
      const Eigen::Vector3d draw(random.normal(), random.normal(), random.normal());
      errors.push_back(deviations.cwiseProduct(draw).norm());
    }
  }
  std::sort(errors.begin(), errors.end());
  PredictedError error;
  for (const double one : errors) error.mean_m += one / static_cast<double>(errors.size());
  error.p95_m = errors[static_cast<std::size_t>(0.95 * static_cast<double>(errors.size() - 1))];
  error.rms_m = std::sqrt(std::max(0.0, square_m2(covariance)));
  return error;
}

}  // namespace demecal::inline planning
