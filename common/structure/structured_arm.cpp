#include "structure/structured_arm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include "errors/check.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/forward.hpp"

namespace demecal::inline structure {
namespace {

Gene random_gene(RandomStream& random) {
  const bool rotates = random.chance(0.5);
  return {rotates, static_cast<int>(random.index(3))};
}

auto at(GeneSection& section, std::size_t place) {
  return section.begin() + static_cast<std::ptrdiff_t>(place);
}

}  // namespace

Genome random_genome(int links, RandomStream& random) {
  Genome genome(static_cast<std::size_t>(links));
  for (GeneSection& section : genome) {
    const std::size_t length = random.index(kLongestSection + 1);
    for (std::size_t i = 0; i < length; ++i) section.push_back(random_gene(random));
  }
  return genome;
}

Genome crossed(const Genome& a, const Genome& b, RandomStream& random) {
  DEMECAL_CHECK(a.size() == b.size(), a.size() << " and " << b.size() << " sections");
  Genome child(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool a_first = random.chance(0.5);
    const GeneSection &first = a_first ? a[i] : b[i], &last = a_first ? b[i] : a[i];
    const auto head = static_cast<std::ptrdiff_t>(random.index(first.size() + 1));
    const auto tail = static_cast<std::ptrdiff_t>(random.index(last.size() + 1));
    child[i].assign(first.begin(), first.begin() + head);
    child[i].insert(child[i].end(), last.begin() + tail, last.end());
    if (child[i].size() > kLongestSection) child[i].resize(kLongestSection);
  }
  return child;
}

Genome mutated(Genome genome, RandomStream& random) {
  GeneSection& section = genome[random.index(genome.size())];
  const std::size_t kind = random.index(3);
  const bool grows = section.empty() || (kind == 0 && section.size() < kLongestSection);
  if (grows) {
    section.insert(at(section, random.index(section.size() + 1)), random_gene(random));
  } else if (kind == 1) {
    section.erase(at(section, random.index(section.size())));
  } else {
    section[random.index(section.size())] = random_gene(random);
  }
  return genome;
}

Genome expressed(const Genome& genome) {
  Genome result = genome;
  for (GeneSection& section : result) section.erase(std::unique(section.begin(), section.end()), section.end());
  return result;
}

std::size_t gene_count(const Genome& genome) {
  std::size_t count = 0;
  for (const GeneSection& section : genome) count += section.size();
  return count;
}

namespace {

/// The flange in the base's frame; every gene's screw, in their order, goes to `visit`.
template <typename Visit>
Eigen::Isometry3d walk_genes(const StructuredArm& arm, const JointVector& commanded, const Visit& visit) {
  std::size_t next = 0;
  const auto insert = [&](int place, Eigen::Isometry3d& frame) {
    if (place == 0) return;
    for (const Gene& gene : arm.genome[static_cast<std::size_t>(place - 1)]) {
      visit(Screw{gene.rotates, frame.linear().col(gene.axis), frame.translation()});
      advance(frame, Elementary{LinkParameter::theta, gene.rotates, gene.axis}, arm.values[next++]);
    }
  };
  return walk(
      arm.robot.chain, arm.robot.corrected_joints(commanded), [](int, LinkParameter, const Screw&) {}, insert);
}

void move_frame(Eigen::Isometry3d& frame, const Eigen::Vector3d& shift, const Eigen::Vector3d& by) {
  frame.translation() += shift;
  frame.linear() = rotation_of(by) * frame.linear();
}

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

Eigen::Isometry3d StructuredArm::predict(const JointVector& commanded, const std::string& target) const {
  return robot.sensor_from_base * walk_genes(*this, commanded, [](const Screw&) {}) * robot.tool(target);
}

StructureMotion motion_of(const StructuredArm& arm, const StructureFreedom& freedom, const JointVector& commanded,
                          const std::string& target) {
  std::vector<Screw> screws;
  const Eigen::Isometry3d flange = walk_genes(arm, commanded, [&](const Screw& screw) { screws.push_back(screw); });
  const Eigen::Isometry3d point = flange * arm.robot.tool(target);
  const Eigen::Isometry3d& base = arm.robot.sensor_from_base;
  StructureMotion motion{base * point, {}};
  const int before = freedom.before_genes();
  motion.twists.setZero(6, before + static_cast<Eigen::Index>(screws.size()));
  if (freedom.base) {
    motion.twists.topLeftCorner<3, 3>().setIdentity();
    motion.twists.block<3, 3>(3, 3).setIdentity();
    const Eigen::Vector3d arm_m = motion.predicted.translation() - base.translation();
    for (int i = 0; i < 3; ++i) motion.twists.col(3 + i).head<3>() = Eigen::Vector3d::Unit(i).cross(arm_m);
  }
  const auto own = std::ranges::find(freedom.tools, target);
  if (own != freedom.tools.end()) {
    const Eigen::Matrix3d axes = (base * flange).linear();
    const Eigen::Index at = (freedom.base ? 6 : 0) + freedom.tool_size() * (own - freedom.tools.begin());
    motion.twists.block<3, 3>(0, at) = axes;
    if (freedom.tool_turns) motion.twists.block<3, 3>(3, at + 3) = axes;
  }
  for (std::size_t i = 0; i < screws.size(); ++i) {
    const Eigen::Matrix<double, 6, 1> twist = twist_at(screws[i], point.translation());
    const auto column = before + static_cast<Eigen::Index>(i);
    motion.twists.col(column).head<3>() = base.linear() * twist.head<3>();
    motion.twists.col(column).tail<3>() = base.linear() * twist.tail<3>();
  }
  return motion;
}

StructuredArm changed(const StructuredArm& arm, const StructureFreedom& freedom, const Eigen::VectorXd& change) {
  StructuredArm result = arm;
  Eigen::Index next = 0;
  if (freedom.base) {
    move_frame(result.robot.sensor_from_base, change.head<3>(), change.segment<3>(3));
    next = 6;
  }
  for (const std::string& target : freedom.tools) {
    const Eigen::Vector3d by = freedom.tool_turns ? change.segment<3>(next + 3) : Eigen::Vector3d::Zero().eval();
    move_frame(result.robot.tools.at(target), change.segment<3>(next), by);
    next += freedom.tool_size();
  }
  for (double& value : result.values) value += change[next++];
  return result;
}

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
    const bool parallel = near_parallel_to_next(arm.robot.chain, static_cast<int>(i), kNearParallel_rad);
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

}  // namespace demecal::inline structure
