#include "kinematics/difference.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "kinematics/units.hpp"

namespace demecal::inline kinematics {
namespace {

constexpr double kAlike = 1e-9;  ///< m, rad

std::string number(double value) {
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
    if (std::abs(here - there) < kAlike) continue;
    const bool length = which == LinkParameter::d || which == LinkParameter::a;
    const auto shown = [&](double value) { return number(length ? millimetres(value) : degrees(value)); };
    const char* const unit = length ? " mm" : " deg";
    return std::string("has ") + kNames[static_cast<std::size_t>(i)] + ' ' + shown(there) + unit + ", not " +
           shown(here) + unit;
  }
  return {};
}

bool same_place(const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) {
  return (one.matrix() - other.matrix()).cwiseAbs().maxCoeff() < kAlike;
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
