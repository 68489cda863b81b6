#include "prediction/corrected_robot.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <utility>

#include "errors/check.hpp"
#include "expression/evaluate.hpp"
#include "expression/simplify.hpp"
#include "kinematics/inverse.hpp"

namespace demecal::inline prediction {
namespace {

Eigen::Isometry3d tool_at(const Eigen::Vector3d& point_m) {
  return Eigen::Isometry3d(Eigen::Translation3d(point_m));
}

struct StandingArm {
  Kinematics kinematics;
  Eigen::Isometry3d base;  ///< in the measurements' frame, as the instrument's own effects show it
};

StandingArm kinematics_at(const CorrectedRobot& robot, const Stop& stop, const std::string& target) {
  const JointVector corrected = robot.corrected_joints(stop.joints);
  const Eigen::Vector3d point_m = robot.tool(target).translation();
  if (robot.effects.empty()) return {differential_kinematics(robot.chain, corrected, point_m), robot.sensor_from_base};
  const Displacement displaced = displacement(robot.chain, robot.effects, robot.motions(stop, target));
  return {differential_kinematics(robot.chain, corrected + displaced.joints, point_m, displaced.places).kinematics,
          kinematics::moved(Eigen::Isometry3d::Identity(), displaced.sensor) * robot.sensor_from_base};
}

/// rad or m. Errors are thousandths; commands that need more would turn the wrist over to mend an angle of that size.
constexpr double kLargestCorrection = 0.5;

}  // namespace

JointCorrection::JointCorrection(Tree formula, AngleBranch branch, Interval range_rad)
    : formula_(std::move(formula)),
      derivative_(derivative(formula_, 0)),
      branch_(branch),
      range_rad_(range_rad),
      neutral_(formula_ == neutral_tree()) {}

double JointCorrection::operator()(double theta_rad) const {
  if (neutral_) return 0.0;
  const double inside = std::clamp(branch_(theta_rad), range_rad_.lower, range_rad_.upper);
  return evaluate(formula_, {&inside, 1});
}

double JointCorrection::slope(double theta_rad) const {
  const double theta = branch_(theta_rad);
  if (neutral_ || theta < range_rad_.lower || theta > range_rad_.upper) return 0.0;
  return evaluate(derivative_, {&theta, 1});
}

std::vector<EffectMotion> effect_motions(const std::vector<Effect>& effects, const Robot& described,
                                         const ArmState& state) {
  std::vector<EffectMotion> all;
  all.reserve(2 * effects.size());  // waves have two coefficients
  std::vector<UnitMotion> motions;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    motions.clear();
    append_unit_motions(effects[i], described, state, motions);
    for (const UnitMotion& motion : motions) all.push_back({static_cast<int>(i), motion});
  }
  return all;
}

bool is_joint_motion(const Chain& chain, const UnitMotion& motion) {
  if (motion.place < 0 || motion.place >= chain.size()) return false;
  const bool revolute = is_revolute(chain, motion.place);
  return motion.axis == (revolute ? 5 : 2);
}

Displacement displacement(const Chain& chain, const std::vector<Effect>& effects,
                          const std::vector<EffectMotion>& motions) {
  Displacement sum{JointVector::Zero(chain.size()), PlaceMotions::Zero(6, chain.size() + 1), SmallMotion::Zero()};
  for (const auto& [effect, unit] : motions) {
    const double size =
        unit.size * effects[static_cast<std::size_t>(effect)].value(static_cast<std::size_t>(unit.coefficient));
    if (unit.place == kSensorPlace) {
      sum.sensor[unit.axis] += size;
    } else if (is_joint_motion(chain, unit)) {
      sum.joints[unit.place] += size;
    } else {
      sum.places(unit.axis, unit.place) += size;
    }
  }
  sum.joints = commanded_joints(chain, sum.joints);
  return sum;
}

Needs CorrectedRobot::needs(const Effect& effect) const {
  Needs needs = law_of(effect).needs(effect, described);
  if (payloads_kg && payloads_kg->upper > 0.0) needs.payload |= law_of(effect).bears_payload(effect, described);
  return needs;
}

const Eigen::Isometry3d& CorrectedRobot::tool(const std::string& target) const {
  const auto found = tools.find(target);
  DEMECAL_CHECK(found != tools.end(), "no tool for target '" << target << "'");
  return found->second;
}

JointVector CorrectedRobot::corrected_joints(const JointVector& commanded) const {
  DEMECAL_CHECK(commanded.size() == static_cast<Eigen::Index>(corrections.size()),
                commanded.size() << " joint values for " << corrections.size() << " corrections");
  JointVector corrected = driven_joints(chain, commanded);
  for (Eigen::Index i = 0; i < corrected.size(); ++i) {
    corrected[i] += corrections[static_cast<std::size_t>(i)](commanded[i]);
  }
  return commanded_joints(chain, corrected);
}

JointVector CorrectedRobot::actual_joints(const Stop& stop) const {
  if (effects.empty()) return corrected_joints(stop.joints);
  const auto unit_motions = effect_motions(effects, described, arm_state(described, stop));
  return corrected_joints(stop.joints) + displacement(chain, effects, unit_motions).joints;
}

std::vector<EffectMotion> CorrectedRobot::motions(const Stop& stop, const std::string& target) const {
  if (effects.empty()) return {};
  ArmState state = arm_state(described, stop);
  state.tool_in_sensor_m = predict(corrected_joints(stop.joints), {}, target).translation();
  return effect_motions(effects, described, state);
}

Eigen::Isometry3d CorrectedRobot::predict(const Stop& stop, const std::string& target) const {
  return predict(corrected_joints(stop.joints), motions(stop, target), target);
}

Eigen::Isometry3d CorrectedRobot::predict(const JointVector& corrected, const std::vector<EffectMotion>& motions,
                                          const std::string& target) const {
  if (motions.empty()) return sensor_from_base * forward(chain, corrected) * tool(target);
  const Displacement displaced = displacement(chain, effects, motions);
  const Eigen::Isometry3d base = kinematics::moved(Eigen::Isometry3d::Identity(), displaced.sensor) * sensor_from_base;
  return base * forward(chain, corrected + displaced.joints, displaced.places) * tool(target);
}

PoseAndJacobian CorrectedRobot::predict_with_jacobian(const Stop& stop, const std::string& target) const {
  const Eigen::Isometry3d& flange_from_tool = tool(target);
  const auto [kinematics, base] = kinematics_at(*this, stop, target);
  PoseAndJacobian result{base * kinematics.flange * flange_from_tool, kinematics.drives};
  const Eigen::Matrix3d rotation = base.linear();
  for (Eigen::Index i = 0; i < result.jacobian.cols(); ++i) {
    const double gain = 1.0 + corrections[static_cast<std::size_t>(i)].slope(stop.joints[i]);
    result.jacobian.col(i).head<3>() = gain * rotation * kinematics.drives.col(i).head<3>();
    result.jacobian.col(i).tail<3>() = gain * rotation * kinematics.drives.col(i).tail<3>();
  }
  for (const CommandCoupling& coupling : chain.couplings) {
    const auto driven = kinematics.drives.col(coupling.joint);
    result.jacobian.col(coupling.from).head<3>() += coupling.factor * (rotation * driven.head<3>());
    result.jacobian.col(coupling.from).tail<3>() += coupling.factor * (rotation * driven.tail<3>());
  }
  return result;
}

namespace {

void widen_to(const std::optional<double>& value, std::optional<Interval>& range) {
  if (!value) return;
  if (!range) range = Interval{*value, *value};
  range = Interval{std::min(range->lower, *value), std::max(range->upper, *value)};
}

}  // namespace

CorrectedRobot nominal_robot(const DataSet& data) {
  CorrectedRobot robot;
  robot.chain = data.robot.chain;
  robot.described = data.robot;
  robot.tools[""] = tool_at(robot.chain.tool_m);
  for (const auto& [target, point_m] : data.tools_m) robot.tools[target] = tool_at(point_m);
  for (const MeasuredPose& pose : data.poses) robot.tools.try_emplace(pose.target, tool_at(nominal_tool(data, pose)));
  robot.corrections.resize(robot.chain.joints.size());
  for (const MeasuredPose& pose : data.poses) {
    widen_to(pose.payload_kg, robot.payloads_kg);
    widen_to(pose.temperature_celsius, robot.temperatures_celsius);
  }
  return robot;
}

InverseSolution corrected_command(const CorrectedRobot& robot, const Chain& nominal, const Stop& desired,
                                  const InverseOptions& options) {
  const Eigen::Isometry3d goal = robot.sensor_from_base * forward(nominal, desired.joints) * robot.tool("");
  return command_reaching(robot, goal, desired, options);
}

InverseSolution command_reaching(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& start,
                                 const InverseOptions& options) {
  const std::string own_tool;
  const PoseFunction model = [&](const JointVector& commanded) {
    return robot.predict_with_jacobian(start.with_joints(commanded), own_tool);
  };
  const InverseSolution exact = inverse(model, goal, start.joints, options);
  const bool converged = exact.status == InverseStatus::converged;
  if (converged && (exact.q - start.joints).cwiseAbs().maxCoeff() <= kLargestCorrection) return exact;

  InverseSolution nearest = exact;
  nearest.q = damped_least_squares(model, goal, start.joints, {.held = options.held});
  const PoseError left = pose_error(robot.predict(start.with_joints(nearest.q), own_tool), goal);
  nearest.position_residual_m = left.head<3>().norm();
  nearest.orientation_residual_rad = left.tail<3>().norm();
  if (converged) nearest.status = InverseStatus::damped;
  return nearest;
}

}  // namespace demecal::inline prediction
