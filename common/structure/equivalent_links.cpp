#include "structure/equivalent_links.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/chain.hpp"

namespace demecal {
namespace {

constexpr double kParallel_rad = 0.02;  // where d is not told from that of the next joint

/// The numbers that lead from one axis to the next: Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta), whichever convention
/// keeps them in one joint or in two.
struct Passage {
  double theta_rad, d_m, a_m, alpha_rad, beta_rad;

  Eigen::Isometry3d pose() const {
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    frame.rotate(Eigen::AngleAxisd(theta_rad, Eigen::Vector3d::UnitZ()));
    frame.translate(Eigen::Vector3d(a_m, 0.0, d_m));
    frame.rotate(Eigen::AngleAxisd(alpha_rad, Eigen::Vector3d::UnitX()));
    frame.rotate(Eigen::AngleAxisd(beta_rad, Eigen::Vector3d::UnitY()));
    return frame;
  }
};

/// The angle by whole turns near another.
double near(double angle_rad, double other_rad) {
  return other_rad + std::remainder(angle_rad - other_rad, 2.0 * EIGEN_PI);
}

/// By the common normal of z and the line through `point` along `axis`.
Passage by_normal(const Eigen::Vector3d& point, const Eigen::Vector3d& axis, const Passage& nominal) {
  const double side = std::sin(nominal.alpha_rad) < 0.0 ? -1.0 : 1.0;
  const double sine = side * std::hypot(axis.x(), axis.y());
  const double theta = std::atan2(axis.x() / sine, -axis.y() / sine);
  const Eigen::Vector3d x(std::cos(theta), std::sin(theta), 0.0), y(-x.y(), x.x(), 0.0);
  const double along = point.dot(y) / sine;
  return {near(theta, nominal.theta_rad), point.z() + along * axis.z(), point.dot(x),
          near(std::atan2(sine, axis.z()), nominal.alpha_rad), 0.0};
}

/// By where the line meets the plane z = d.
Passage by_plane(const Eigen::Vector3d& point, const Eigen::Vector3d& axis, const Passage& nominal) {
  const Eigen::Vector3d meets = point + (nominal.d_m - point.z()) / axis.z() * axis;
  const double side = nominal.a_m < 0.0 ? -1.0 : 1.0;
  const double a = side * std::hypot(meets.x(), meets.y());
  const double theta = a == 0.0 ? nominal.theta_rad : std::atan2(meets.y() / a, meets.x() / a);
  const Eigen::Vector3d turned = Eigen::AngleAxisd(-theta, Eigen::Vector3d::UnitZ()) * axis;
  const double beta = std::asin(std::clamp(turned.x(), -1.0, 1.0));
  return {near(theta, nominal.theta_rad), nominal.d_m, a, near(std::atan2(-turned.y(), turned.z()), nominal.alpha_rad),
          beta};
}

Eigen::Isometry3d section_pose(const StructuredArm& arm, std::size_t section, std::size_t& next) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  for (const Gene& gene : arm.genome[section]) {
    advance(frame, Elementary{LinkParameter::theta, gene.rotates, gene.axis}, arm.values[next++]);
  }
  return frame;
}

}  // namespace

CorrectedRobot equivalent_robot(const StructuredArm& arm) {
  CorrectedRobot robot = arm.robot;
  const bool standard = robot.chain.convention == Convention::standard_dh;
  std::size_t next = 0;
  for (std::size_t i = 0; i + 1 < robot.chain.joints.size(); ++i) {
    Joint& joint = robot.chain.joints[i];  // its theta and d hold what the axis before has turned and shifted
    Joint& link = standard ? joint : robot.chain.joints[i + 1];
    const Eigen::Isometry3d inserted = section_pose(arm, i, next);
    if (arm.genome[i].empty()) continue;
    const Passage nominal{joint.theta_rad, joint.d_m, link.a_m, link.alpha_rad, link.beta_rad};
    const Eigen::Isometry3d all = nominal.pose() * inserted;
    const Eigen::Vector3d point = all.translation(), axis = all.linear().col(2);
    const bool parallel = near_parallel_to_next(arm.robot.chain, static_cast<int>(i), kParallel_rad);
    const Passage passage = parallel ? by_plane(point, axis, nominal) : by_normal(point, axis, nominal);
    joint.theta_rad = passage.theta_rad;
    joint.d_m = passage.d_m;
    link.a_m = passage.a_m;
    link.alpha_rad = passage.alpha_rad;
    link.beta_rad = passage.beta_rad;
    const Eigen::Isometry3d left = passage.pose().inverse() * all;  // about and along the next axis
    Joint& after = robot.chain.joints[i + 1];
    after.theta_rad += std::atan2(left.linear()(1, 0), left.linear()(0, 0));
    after.d_m += left.translation().z();
  }
  const Eigen::Isometry3d at_flange = section_pose(arm, robot.chain.joints.size() - 1, next);
  for (auto& [target, tool] : robot.tools) tool = at_flange * tool;
  return robot;
}

}  // namespace demecal
