#include "planning/arm_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kinematics/forward.hpp"

namespace demecal::inline planning {
namespace {

constexpr double kNoLength_m = 1e-3;

double held(double share) {
  return std::clamp(share, 0.0, 1.0);
}

}  // namespace

double segment_distance(const Eigen::Vector3d& from1, const Eigen::Vector3d& to1, const Eigen::Vector3d& from2,
                        const Eigen::Vector3d& to2) {
  constexpr double kTiny = 1e-18;
  const Eigen::Vector3d along1 = to1 - from1, along2 = to2 - from2, between = from1 - from2;
  const double square1 = along1.squaredNorm(), square2 = along2.squaredNorm();
  const double dot = along1.dot(along2), ahead1 = along1.dot(between), ahead2 = along2.dot(between);
  const double spread = square1 * square2 - dot * dot;  // 0 where the lines are parallel, or one is a point
  double share1 = 0.0, share2 = 0.0;
  if (square1 > kTiny) {
    if (spread > kTiny * square1 * std::max(square2, 1.0))
      share1 = held((dot * ahead2 - ahead1 * square2) / spread);
    else if (square2 <= kTiny)
      share1 = held(-ahead1 / square1);
  }
  if (square2 > kTiny) share2 = (dot * share1 + ahead2) / square2;
  if (share2 < 0.0 || share2 > 1.0) {
    share2 = held(share2);
    if (square1 > kTiny) share1 = held((dot * share2 - ahead1) / square1);
  }
  return (between + share1 * along1 - share2 * along2).norm();
}

double clearance(const Capsule& one, const Capsule& other) {
  return segment_distance(one.from_m, one.to_m, other.from_m, other.to_m) - one.radius_m - other.radius_m;
}

std::vector<ArmPart> arm_parts(const Chain& chain, const JointVector& q, const std::vector<double>& radii_m) {
  std::vector<ArmPart> parts;
  Eigen::Vector3d here = Eigen::Vector3d::Zero();
  double along = 0.0;
  const auto reach = [&](const Eigen::Vector3d& point, int link) {
    const double length = (point - here).norm();
    if (length < kNoLength_m) return;
    parts.push_back({link, along, along + length, {here, point, radii_m[static_cast<std::size_t>(link)]}});
    along += length;
    here = point;
  };
  int link = 0;
  const Eigen::Isometry3d flange = walk(
      chain, q,
      [&](int joint, LinkParameter, const Screw& screw) {
        reach(screw.origin, link);
        link = joint;
      },
      [](int, Eigen::Isometry3d&) {});
  reach(flange.translation(), link);
  reach(flange * chain.tool_m, chain.size());
  return parts;
}

bool parts_meet(const ArmPart& one, const ArmPart& other) {
  constexpr double kFolded = 1.25;  // two bodies this close along the arm touch by construction
  const double between = std::max(one.begin_m, other.begin_m) - std::min(one.end_m, other.end_m);
  if (between < kFolded * 2.0 * (one.body.radius_m + other.body.radius_m)) return false;
  return clearance(one.body, other.body) < 0.0;
}

double reach_m(const Chain& chain) {
  double reach = chain.tool_m.norm();
  for (const Joint& joint : chain.joints) {
    reach += std::abs(joint.a_m) + std::abs(joint.d_m);
    if (!is_revolute(joint)) reach += std::max(std::abs(joint.lower), std::abs(joint.upper));
  }
  return reach;
}

std::vector<double> assumed_radii(const Chain& chain) {
  constexpr double kLink = 0.04, kTool = 0.015;  // of the reach: of usual industrial arms
  std::vector<double> radii(chain.joints.size() + 1, kLink * reach_m(chain));
  radii.back() = kTool * reach_m(chain);
  return radii;
}

}  // namespace demecal::inline planning
