#include "effects/law_terms.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

namespace demecal::inline effects {
namespace {

constexpr double kArcsecondsPerRadian = 3600.0 * 180.0 / std::numbers::pi;

/// "0.0003 rad cos(24 q2)", without its sign.
std::string size_of_term(const Term& term, double value, const std::string& unit) {
  std::string text = significant_text(std::abs(value), 4);
  if (unit != "1") text += ' ' + unit;
  if (!term.factor.empty()) text += ' ' + term.factor;
  return text;
}

constexpr std::array<const char*, 6> kMotionAxes{"x", "y", "z", "rx", "ry", "rz"};

/// The frame in which the link's transform `parameter` acts, from where the link begins.
Eigen::Isometry3d frame_before(const Chain& chain, const Joint& joint, double q, LinkParameter parameter) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  for (const Elementary& transform : elementary_transforms(chain.convention)) {
    if (transform.parameter == parameter) break;
    advance(frame, transform, elementary_value(joint, transform.parameter, q));
  }
  return frame;
}

const Elementary& transform_of(const Chain& chain, LinkParameter parameter) {
  const auto& all = elementary_transforms(chain.convention);
  std::size_t i = 0;
  while (all[i].parameter != parameter) ++i;
  return all[i];
}

}  // namespace

std::string significant_text(double value, int count) {
  std::ostringstream text;
  text.precision(count);
  text << value;
  return text.str();
}

void append_joint_motion(const Robot& robot, int joint, int coefficient, double size,
                         std::vector<UnitMotion>& motions) {
  if (size != 0.0) motions.push_back({coefficient, joint, is_revolute(robot.chain, joint) ? 5 : 2, size});
}

void append_link_motion(const Chain& chain, int joint, double q, LinkParameter parameter, int coefficient, double size,
                        std::vector<UnitMotion>& motions) {
  const Joint& link = chain.joints[static_cast<std::size_t>(joint)];
  const Eigen::Isometry3d place = frame_before(chain, link, q, LinkParameter::theta);
  const Eigen::Isometry3d seen = place.inverse() * frame_before(chain, link, q, parameter);
  const Elementary& transform = transform_of(chain, parameter);
  const Eigen::Vector3d direction = seen.linear().col(transform.axis);
  const Eigen::Vector3d moved = transform.rotates ? seen.translation().cross(direction) : direction;
  const auto append = [&](int axis, double share) {
    if (share * size != 0.0) motions.push_back({coefficient, joint, axis, share * size});
  };
  for (int axis = 0; axis < 3; ++axis) append(axis, moved[axis]);
  for (int axis = 0; transform.rotates && axis < 3; ++axis) append(3 + axis, direction[axis]);
}

CoefficientLabel motion_label(const Robot& robot, int joint, const std::string& stem) {
  const std::string unit = is_revolute(robot.chain, joint) ? "rad" : "m";
  return {stem + '_' + unit, unit};
}

CoefficientLabel compliance_label(const Robot& robot, int joint, const std::string& stem) {
  const std::string before = stem.empty() ? stem : stem + '_';
  return is_revolute(robot.chain, joint) ? CoefficientLabel{before + "rad_per_nm", "rad/Nm"}
                                         : CoefficientLabel{before + "m_per_n", "m/N"};
}

std::string rounded_text(double value) {
  return std::abs(value) < 100.0 ? significant_text(value, 3) : significant_text(std::round(value), 9);
}

std::string angle_text(double angle_rad) {
  return rounded_text(1e3 * angle_rad) + " mrad (" + rounded_text(kArcsecondsPerRadian * angle_rad) + " arcsec)";
}

std::string length_text(double length_m) {
  return rounded_text(1e3 * length_m) + " mm";
}

std::string motion_text(const Robot& robot, int joint, double motion) {
  return is_revolute(robot.chain, joint) ? angle_text(motion) : length_text(motion);
}

std::string share_text(double share) {
  return rounded_text(1e6 * share) + " ppm";
}

std::string load_unit(const Robot& robot, int joint) {
  return is_revolute(robot.chain, joint) ? "Nm" : "N";
}

std::string joint_name(int joint) {
  return "Joint " + std::to_string(joint + 1);
}

std::string joint_symbol(int joint) {
  return std::string("q") + std::to_string(joint + 1);
}

std::string times_per_turn(double order) {
  if (order == 1.0) return "once per turn";
  if (order == 2.0) return "twice per turn";
  return significant_text(order, 8) + " times per turn";
}

std::string write_equations(const Effect& effect, const Robot& robot, const std::vector<Equation>& equations) {
  const std::vector<CoefficientLabel> labels = law_of(effect).coefficients(effect, robot);
  std::string text;
  for (const Equation& equation : equations) {
    text += (text.empty() ? "" : ", ") + equation.left + " =";
    bool first = true;
    for (const Term& term : equation.terms) {
      const double value = term.scale * effect.value(term.coefficient);
      const bool negative = value < 0.0;
      text += first ? (negative ? " -" : " ") : (negative ? " - " : " + ");
      text += size_of_term(term, value, labels[term.coefficient].unit);
      first = false;
    }
  }
  return text;
}

std::string write_joint_equation(const Effect& effect, const Robot& robot, const std::vector<Term>& terms) {
  return write_equations(effect, robot, {{'d' + joint_symbol(effect.joint), terms}});
}

std::vector<Term> harmonic_terms(double ratio, int joint) {
  const std::string angle = (ratio == 1.0 ? "" : significant_text(ratio, 8) + ' ') + joint_symbol(joint);
  return {{0, "cos(" + angle + ')'}, {1, "sin(" + angle + ')'}};
}

std::vector<CoefficientLabel> rigid_labels(int count, const std::string& suffix, const std::string& per) {
  std::vector<CoefficientLabel> labels;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(count); ++axis) {
    const std::string unit = axis < 3 ? "m" : "rad";
    labels.push_back({std::string(kMotionAxes[axis]) + '_' + unit + suffix, unit + per});
  }
  return labels;
}

void append_rigid_motions(int place, int count, double size, std::vector<UnitMotion>& motions) {
  if (size == 0.0) return;
  for (int axis = 0; axis < count; ++axis) motions.push_back({axis, place, axis, size});
}

std::string write_rigid_equations(const Effect& effect, const Robot& robot, int count, const std::string& symbol,
                                  const std::string& factor) {
  std::vector<Equation> equations;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(count); ++axis) {
    equations.push_back({symbol + kMotionAxes[axis], {{axis, factor}}});
  }
  return write_equations(effect, robot, equations);
}

std::string triple_text(const Effect& effect, std::size_t first, double scale, const std::string& unit) {
  std::string text = "(";
  for (std::size_t i = 0; i < 3; ++i) text += (i == 0 ? "" : ", ") + rounded_text(scale * effect.value(first + i));
  return text + ") " + unit;
}

}  // namespace demecal::inline effects
