#include "kinematics/chain.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <sstream>

#include "errors/check.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline kinematics {
namespace {

constexpr std::array<Elementary, kLinkParameters> kStandard{{{LinkParameter::theta, true, 2},
                                                             {LinkParameter::d, false, 2},
                                                             {LinkParameter::a, false, 0},
                                                             {LinkParameter::alpha, true, 0},
                                                             {LinkParameter::beta, true, 1}}};
constexpr std::array<Elementary, kLinkParameters> kModified{{{LinkParameter::alpha, true, 0},
                                                             {LinkParameter::a, false, 0},
                                                             {LinkParameter::beta, true, 1},
                                                             {LinkParameter::theta, true, 2},
                                                             {LinkParameter::d, false, 2}}};

}  // namespace

double& Joint::parameter(LinkParameter which) {
  switch (which) {
    case LinkParameter::theta:
      return theta_rad;
    case LinkParameter::d:
      return d_m;
    case LinkParameter::a:
      return a_m;
    case LinkParameter::alpha:
      return alpha_rad;
    case LinkParameter::beta:
      return beta_rad;
  }
  DEMECAL_CHECK(false, "link parameter " << static_cast<int>(which));
}

double Joint::parameter(LinkParameter which) const {
  return const_cast<Joint*>(this)->parameter(which);
}

JointVector driven_joints(const Chain& chain, JointVector commanded) {
  if (chain.couplings.empty()) return commanded;
  JointVector driven = commanded;
  for (const CommandCoupling& coupling : chain.couplings)
    driven[coupling.joint] += coupling.factor * commanded[coupling.from];
  return driven;
}

JointVector commanded_joints(const Chain& chain, JointVector driven) {
  // By joint, so that those that a coupling comes from are commands already.
  for (const CommandCoupling& coupling : chain.couplings)
    driven[coupling.joint] -= coupling.factor * driven[coupling.from];
  return driven;
}

JointVector joints_from_deg_or_mm(const Chain& chain, std::span<const double> values) {
  DEMECAL_CHECK(std::ssize(values) == chain.size(), values.size() << " values, " << chain.size() << " joints");
  JointVector joints(chain.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    joints[static_cast<Eigen::Index>(i)] = is_revolute(chain.joints[i]) ? radians(values[i]) : metres(values[i]);
  }
  return joints;
}

double spread_share(int index, std::size_t joint) {
  constexpr std::array<int, kMaxJoints> kPrimes{2, 3, 5, 7, 11, 13, 17, 19, 23};
  const int base = kPrimes[joint];
  double value = 0.0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) value += digit * (index % base);
  return value;
}

bool near_parallel_to_next(const Chain& chain, int joint, double tolerance_rad) {
  if (joint < 0 || joint + 1 >= chain.size()) return false;
  // The twist between two joint axes is the standard link's own alpha, and the next modified link's.
  const bool standard = chain.convention == Convention::standard_dh;
  const double alpha = chain.joints[static_cast<std::size_t>(standard ? joint : joint + 1)].alpha_rad;
  return std::abs(std::sin(alpha)) < std::sin(tolerance_rad);
}

bool leads_between_parallels(const Chain& chain, int link, double tolerance_rad) {
  const int before = chain.convention == Convention::standard_dh ? link : link - 1;
  return near_parallel_to_next(chain, before, tolerance_rad);
}

const std::array<Elementary, kLinkParameters>& elementary_transforms(Convention convention) {
  return convention == Convention::standard_dh ? kStandard : kModified;
}

double elementary_value(const Joint& joint, LinkParameter parameter, double q) {
  const bool moves = parameter == moving_parameter(joint);
  return joint.parameter(parameter) + (moves ? q : 0.0);
}

Turn turn_by(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

void rotate(Eigen::Isometry3d& frame, int axis, const Turn& turn) {
  auto rotation = frame.linear();
  // A rotation about one own axis mixes the two columns that follow it cyclically.
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  const Eigen::Vector3d old_first = rotation.col(first), old_second = rotation.col(second);
  rotation.col(first) = turn.cosine * old_first + turn.sine * old_second;
  rotation.col(second) = turn.cosine * old_second - turn.sine * old_first;
}

void advance(Eigen::Isometry3d& frame, const Elementary& transform, double value) {
  if (value == 0.0) return;
  if (transform.rotates)
    rotate(frame, transform.axis, turn_by(value));
  else
    frame.translation() += value * frame.linear().col(transform.axis);
}

namespace {

constexpr double kSameGeometry = 1e-9;  ///< m, rad

std::string ten_digits(double value) {
  std::ostringstream text;
  text.precision(10);
  text << value;
  return text.str();
}

std::string of_joints(const Joint& one, const Joint& other) {
  constexpr std::array<const char*, kLinkParameters> kNames{"theta_offset", "d", "a", "alpha", "beta"};
  if (one.type != other.type) return is_revolute(other) ? "turns, and does not slide" : "slides, and does not turn";
  for (int i = 0; i < kLinkParameters; ++i) {
    const auto which = static_cast<LinkParameter>(i);
    const double here = one.parameter(which), there = other.parameter(which);
    if (std::abs(here - there) < kSameGeometry) continue;
    const bool length = which == LinkParameter::d || which == LinkParameter::a;
    const auto shown = [&](double value) { return ten_digits(length ? millimetres(value) : degrees(value)); };
    const char* const unit = length ? " mm" : " deg";
    return std::string("has ") + kNames[static_cast<std::size_t>(i)] + ' ' + shown(there) + unit + ", not " +
           shown(here) + unit;
  }
  return {};
}

bool same_place(const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) {
  return (one.matrix() - other.matrix()).cwiseAbs().maxCoeff() < kSameGeometry;
}

}  // namespace

std::string first_difference(const Chain& one, const Chain& other) {
  if (one.size() != other.size())
    return "it has " + std::to_string(other.size()) + " joints, not " + std::to_string(one.size());
  if (one.convention != other.convention) return "its convention is another";
  for (std::size_t i = 0; i < one.joints.size(); ++i) {
    const std::string difference = of_joints(one.joints[i], other.joints[i]);
    if (!difference.empty()) return "its joint " + std::to_string(i + 1) + ' ' + difference;
  }
  if (!same_place(one.base, other.base)) return "its base stands elsewhere";
  if (!same_place(one.flange, other.flange)) return "its flange is elsewhere";
  return one.couplings == other.couplings ? "" : "its couplings are others";
}

}  // namespace demecal::inline kinematics
