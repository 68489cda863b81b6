#include "baselines/baseline.hpp"

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>
#include <utility>

#include "baselines/regression.hpp"
#include "effects/arm_state.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "kinematics/chain.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline baselines {
namespace {

constexpr int kHighestPolynomial = 3;
constexpr std::size_t kMostCoefficients = 1000;  // of polynomials: beyond, a lower degree has to do

/// The parameter that the joint's variable adds to.
LinkParameter variable_of(const Chain& chain, int joint) {
  const bool revolute = is_revolute(chain, joint);
  return revolute ? LinkParameter::theta : LinkParameter::d;
}

std::string ridge_text(double ridge) {
  std::ostringstream text;
  text << "ridge " << ridge;
  return text.str();
}

BaselineFit registration_alone(const RegisteredArm& arm) {
  return {[robot = arm.robot](const MeasuredPose& pose) { return robot.predict(Stop(pose), pose.target); },
          arm.parameters, ""};
}

/// Gain and offset of every joint.
BaselineFit linear_joints(const RegisteredArm& arm) {
  std::vector<LinkFunction> functions;
  for (int joint = 0; joint < arm.robot.chain.size(); ++joint) {
    const LinkParameter variable = variable_of(arm.robot.chain, joint);
    functions.push_back({joint, variable, [](const JointVector&) { return 1.0; }});
    functions.push_back({joint, variable, [joint](const JointVector& q) { return q[joint]; }});
  }
  VaryingFit fit = fit_varying_links(arm, functions);
  fit.fit.chosen = ridge_text(fit.ridge);
  return fit.fit;
}

/// The powers of the joints in each term of a complete polynomial, lower degrees first.
std::vector<std::vector<int>> powers_of(int joints, int degree) {
  std::vector<std::vector<int>> all{std::vector<int>(static_cast<std::size_t>(joints), 0)};
  for (std::size_t i = 0; i < all.size(); ++i) {
    int sum = 0, last = 0;
    for (int joint = 0; joint < joints; ++joint) {
      const int power = all[i][static_cast<std::size_t>(joint)];
      sum += power;
      if (power > 0) last = joint;
    }
    if (sum == degree) continue;
    for (int joint = last; joint < joints; ++joint) {  // each term once: multiplied by its last joint or a later one
      all.push_back(all[i]);
      ++all.back()[static_cast<std::size_t>(joint)];
    }
  }
  return all;
}

std::vector<LinkFunction> polynomials(const RegisteredArm& arm, int degree) {
  const ScaledJoints scaled(arm.data, arm.poses);
  std::vector<LinkFunction> functions;
  for (int joint = 0; joint < arm.robot.chain.size(); ++joint) {
    for (const std::vector<int>& powers : powers_of(arm.robot.chain.size(), degree)) {
      functions.push_back({joint, variable_of(arm.robot.chain, joint), [scaled, powers](const JointVector& q) {
                             double value = 1.0;
                             for (std::size_t i = 0; i < powers.size(); ++i) {
                               for (int k = 0; k < powers[i]; ++k) value *= scaled.one(q, static_cast<int>(i));
                             }
                             return value;
                           }});
    }
  }
  return functions;
}

/// Every joint's error a complete polynomial of all joints (Shamma and Whitney, 1987), its degree by cross-validation.
BaselineFit joint_polynomials(const RegisteredArm& arm) {
  BaselineFit best;
  double least = std::numeric_limits<double>::infinity();
  for (int degree = 1; degree <= kHighestPolynomial; ++degree) {
    const std::vector<LinkFunction> functions = polynomials(arm, degree);
    if (functions.size() > kMostCoefficients) break;
    VaryingFit fit = fit_varying_links(arm, functions);
    if (fit.cost >= least) continue;
    least = fit.cost;
    best = std::move(fit.fit);
    best.chosen = "degree " + std::to_string(degree) + ", " + ridge_text(fit.ridge);
  }
  return best;
}

/// Offset and Fourier series of the joint on each geometric parameter of its link (Everett; Vincze; thesis 2.2).
/// A prismatic joint has no period: the widest measured half wave of it stands for one.
BaselineFit fourier(const RegisteredArm& arm, int order) {
  constexpr double kPi = 3.14159265358979323846;
  const ScaledJoints scaled(arm.data, arm.poses);
  std::vector<LinkFunction> functions;
  for (const ParameterId& id : free_parameters(arm.data, {.joint_offset = true, .geometry = true})) {
    const int joint = id.index;
    const bool revolute = variable_of(arm.robot.chain, joint) == LinkParameter::theta;
    const auto angle = [=](const JointVector& q) { return revolute ? q[joint] : kPi / 2 * scaled.one(q, joint); };
    functions.push_back({joint, id.link, [](const JointVector&) { return 1.0; }});
    for (int k = 1; k <= order; ++k) {
      functions.push_back({joint, id.link, [=](const JointVector& q) { return std::sin(k * angle(q)); }});
      functions.push_back({joint, id.link, [=](const JointVector& q) { return std::cos(k * angle(q)); }});
    }
  }
  VaryingFit fit = fit_varying_links(arm, functions);
  fit.fit.chosen = ridge_text(fit.ridge);
  return fit.fit;
}

/// Offsets and geometry, by least squares alone.
BaselineFit geometry(const RegisteredArm& arm) {
  DeclaredModel declared = arm.base_and_tool;
  declared.joint_offset = declared.geometry = true;
  const Fit fit = fit_declared(arm.data, arm.poses, declared, arm.robot, {.robust = false});
  if (fit.status == FitStatus::too_few_poses) return {nullptr, 0, fit.sentence};
  return {[robot = fit.robot](const MeasuredPose& pose) { return robot.predict(Stop(pose), pose.target); },
          static_cast<int>(fit.estimates.size()), fit.status == FitStatus::converged ? "" : "the fit did not converge"};
}

}  // namespace

RegisteredArm registered_arm(const DataSet& data, const DeclaredModel& declared) {
  RegisteredArm arm{data, {.registration = declared.registration, .tool = declared.tool}, {}, nominal_robot(data), 0};
  arm.poses = poses_of(data, PoseSet::calibration);
  if (arm.poses.empty()) throw InputError({data.file, 0}, "", "has no calibration poses");
  if (!declared.registration && !declared.tool) return arm;
  const Fit fit = fit_registration(data, arm.poses, arm.base_and_tool, arm.robot);
  if (fit.status == FitStatus::too_few_poses) throw InputError({data.file, 0}, "", fit.sentence);
  arm.robot = fit.robot;
  arm.parameters = static_cast<int>(fit.estimates.size());
  return arm;
}

const std::vector<Baseline>& all_baselines() {
  static const std::vector<Baseline> all{
      {"registration", "base and tool alone", registration_alone},
      {"linear_joints", "gain and offset per joint", linear_joints},
      {"polynomials", "polynomials of the joints (Shamma)", joint_polynomials},
      {"fourier_1", "Fourier series, order 1 (Everett, Vincze)",
       [](const RegisteredArm& arm) { return fourier(arm, 1); }},
      {"fourier_2", "Fourier series, order 2", [](const RegisteredArm& arm) { return fourier(arm, 2); }},
      {"fourier_3", "Fourier series, order 3", [](const RegisteredArm& arm) { return fourier(arm, 3); }},
      {"radial_basis", "radial-basis network on the position", fit_radial_basis},
      {"geometry", "Levenberg-Marquardt geometry", geometry}};
  return all;
}

std::array<ErrorFigures, 3> figures_by_set(const BaselineFit& fit, const DataSet& data) {
  std::array<ErrorFigures, 3> figures;
  for (std::size_t set = 0; set < figures.size(); ++set) {
    std::vector<double> errors_mm;
    std::vector<Eigen::Isometry3d> predicted;
    const std::vector<std::size_t> poses = poses_of(data, static_cast<PoseSet>(set));
    if (fit.predict)
      for (const std::size_t i : poses) predicted.push_back(fit.predict(data.poses[i]));
    if (!predicted.empty())
      for (const double error_m : tool_errors_m({}, predicted, data, poses))
        if (!std::isnan(error_m)) errors_mm.push_back(1e3 * error_m);
    figures[set] = error_figures(std::move(errors_mm));
  }
  return figures;
}

}  // namespace demecal::inline baselines
