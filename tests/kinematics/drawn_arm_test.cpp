// Drawn arms and their chains: both move in the same way, whatever the drawing, and no number is larger than the arm.
#include "kinematics/drawn_arm.hpp"

#include <gtest/gtest.h>

#include "kinematics/angles.hpp"
#include "kinematics/forward.hpp"
#include "random_arm.hpp"

namespace demecal {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

Origin random_origin(RandomStream& stream) {
  Origin origin;
  for (double& length : origin.xyz_m) length = stream.real(-0.4, 0.4);
  for (double& angle : origin.rpy_rad) angle = stream.real(-kHalfTurn, kHalfTurn);
  return origin;
}

/// A right angle as files write it, exact or rounded, or none.
double file_angle(RandomStream& stream) {
  constexpr std::array kAngles{0.0, 0.0, 1.5707963, -1.570796327, kHalfTurn / 2, kHalfTurn, 3.14159, 1e-5};
  return kAngles[stream.index(kAngles.size())];
}

/// Some joints are as makers draw them, with axes along x, y or z and rounded right angles, others anyhow.
DrawnArm random_drawing(RandomStream& stream, int joints) {
  DrawnArm arm;
  arm.by_axes = true;
  arm.base = random_origin(stream);
  arm.flange = random_origin(stream);
  for (int i = 0; i < joints; ++i) {
    DrawnJoint joint;
    joint.row.type = stream.chance(0.2) ? JointType::prismatic : JointType::revolute;
    joint.origin = random_origin(stream);
    joint.axis = Eigen::Vector3d(stream.normal(), stream.normal(), stream.normal());
    if (stream.chance(0.7)) {
      for (double& angle : joint.origin.rpy_rad) angle = file_angle(stream);
      joint.axis = (stream.chance(0.5) ? 1.0 : -2.0) * Eigen::Vector3d::Unit(static_cast<int>(stream.index(3)));
      if (stream.chance(0.3)) joint.origin.xyz_m.setZero();
    }
    joint.direction = stream.chance(0.3) ? -1 : 1;
    joint.offset = stream.chance(0.3) ? stream.real(-1, 1) : 0.0;
    arm.joints.push_back(joint);
  }
  if (joints > 2 && arm.joints[1].row.type == arm.joints[2].row.type) arm.couplings.push_back({2, 1, -0.7});
  return arm;
}

double own_value(const DrawnArm& arm, std::size_t joint, const JointVector& q) {
  double command = q[static_cast<Eigen::Index>(joint)];
  for (const CommandCoupling& coupling : arm.couplings) {
    if (coupling.joint == static_cast<int>(joint)) command += coupling.factor * q[coupling.from];
  }
  return arm.joints[joint].direction * command + arm.joints[joint].offset;
}

Eigen::Matrix4d about(const Eigen::Vector3d& axis, double angle) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)).toRotationMatrix();
  return matrix;
}

Eigen::Matrix4d shifted(const Eigen::Vector3d& by) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topRightCorner<3, 1>() = by;
  return matrix;
}

Eigen::Matrix4d matrix_of(const Origin& origin) {
  return shifted(origin.xyz_m) * about(Eigen::Vector3d::UnitZ(), origin.rpy_rad.z()) *
         about(Eigen::Vector3d::UnitY(), origin.rpy_rad.y()) * about(Eigen::Vector3d::UnitX(), origin.rpy_rad.x());
}

/// The product of origins and motions, as URDF defines it.
Eigen::Matrix4d flange_of(const DrawnArm& arm, const JointVector& q) {
  Eigen::Matrix4d pose = matrix_of(arm.base);
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    const DrawnJoint& joint = arm.joints[i];
    const Eigen::Vector3d axis = joint.axis.normalized();
    const double value = own_value(arm, i, q);
    pose = pose * matrix_of(joint.origin) * (is_revolute(joint.row) ? about(axis, value) : shifted(value * axis));
  }
  return pose * matrix_of(arm.flange);
}

JointVector random_commands(RandomStream& stream, std::size_t joints) {
  return random_change(stream, static_cast<int>(joints), 3.0);
}

TEST(DrawnArm, ByAxesMovesAsOriginsAndAxesSay) {
  RandomStream stream{1801};
  for (int which = 0; which < 500; ++which) {
    const DrawnArm arm = random_drawing(stream, 1 + static_cast<int>(stream.index(kMaxJoints)));
    const EquivalentChain equivalent = equivalent_chain(arm);
    for (int i = 0; i < 5; ++i) {
      const JointVector q = random_commands(stream, arm.joints.size());
      EXPECT_LT((forward(equivalent.chain, q).matrix() - flange_of(arm, q)).cwiseAbs().maxCoeff(), 1e-11) << which;
    }
  }
}

TEST(DrawnArm, HasNoNumberFarLargerThanTheArmBetweenNearlyParallelAxes) {
  RandomStream stream{1802};
  for (int which = 0; which < 300; ++which) {
    DrawnArm arm = random_drawing(stream, 6);
    double size_m = 0.0;
    for (DrawnJoint& joint : arm.joints) {
      joint.axis = Eigen::Vector3d::UnitZ();
      for (double& angle : joint.origin.rpy_rad)
        angle = stream.chance(0.5) ? file_angle(stream) : stream.real(-1e-3, 1e-3);
      size_m += joint.origin.xyz_m.norm();
    }
    for (const Joint& row : equivalent_chain(arm).chain.joints) {
      EXPECT_LT(std::abs(row.d_m), 2 * size_m);
      EXPECT_LT(std::abs(row.a_m), 2 * size_m);
    }
  }
}

TEST(DrawnArm, RowsWhoseJointsCountTheOtherWayMoveAsTheRowsSay) {
  RandomStream stream{1803};
  for (int which = 0; which < 200; ++which) {
    const Convention convention = kConventions[which % 2];
    const Chain rows = random_arm(stream, 1 + static_cast<int>(stream.index(7)), convention, 0.3);
    DrawnArm arm{.convention = convention, .joints = {}};
    arm.base = random_origin(stream);
    arm.flange = random_origin(stream);
    for (const Joint& row : rows.joints)
      arm.joints.push_back({.row = row, .direction = stream.chance(0.5) ? -1 : 1, .offset = stream.real(-1, 1)});
    const EquivalentChain equivalent = equivalent_chain(arm);
    const JointVector q = random_commands(stream, arm.joints.size());
    JointVector own = q;
    for (std::size_t i = 0; i < arm.joints.size(); ++i) own[static_cast<Eigen::Index>(i)] = own_value(arm, i, q);
    const Eigen::Matrix4d expected = matrix_of(arm.base) * forward(rows, own).matrix() * matrix_of(arm.flange);
    EXPECT_LT((forward(equivalent.chain, q).matrix() - expected).cwiseAbs().maxCoeff(), 1e-12);
  }
}

/// The links' own frames, base frame: where the chain's rows end.
std::vector<Eigen::Isometry3d> links_of(const Chain& chain, const JointVector& q) {
  std::vector<Eigen::Isometry3d> links;
  Chain part = chain;
  part.flange.setIdentity();
  const JointVector driven = driven_joints(chain, q);
  part.couplings.clear();
  part.joints.clear();
  for (const Joint& joint : chain.joints) {
    part.joints.push_back(joint);
    links.push_back(forward(part, driven.head(part.size())));
  }
  return links;
}

TEST(DrawnArm, SaysWhereItsLinksStandInThoseOfTheChain) {
  RandomStream stream{1804};
  for (int which = 0; which < 50; ++which) {
    DrawnArm arm = random_drawing(stream, 6);
    const EquivalentChain equivalent = equivalent_chain(arm);
    const JointVector q = random_commands(stream, arm.joints.size());
    const std::vector<Eigen::Isometry3d> links = links_of(equivalent.chain, q);
    arm.flange = {};
    for (std::size_t i = arm.joints.size(); i-- > 0;) {
      const Eigen::Matrix4d drawn = (links[i] * equivalent.drawn_links[i]).matrix();
      EXPECT_LT((drawn - flange_of(arm, q)).cwiseAbs().maxCoeff(), 1e-11) << i;
      arm.joints.pop_back();
    }
  }
}

TEST(DrawnArm, OriginsOfAChangedChainMoveAsItDoesAndStayNearTheDrawnOnes) {
  RandomStream stream{1805};
  for (int which = 0; which < 200; ++which) {
    DrawnArm arm = random_drawing(stream, 6);
    EquivalentChain changed = equivalent_chain(arm);
    const double size = which % 4 == 0 ? 0.0 : 1e-4;
    for (Joint& row : changed.chain.joints) {
      for (int i = 0; i < kLinkParameters; ++i)
        row.parameter(static_cast<LinkParameter>(i)) += stream.real(-size, size);
    }
    const std::vector<Origin> origins = origins_of(arm, changed.chain);
    for (std::size_t i = 0; i < origins.size(); ++i) {
      const Eigen::Matrix4d by = matrix_of(arm.joints[i].origin).inverse() * matrix_of(origins[i]);
      EXPECT_LT((by - Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff(), 20 * size + 1e-12);
      if (size == 0.0 && std::abs(std::cos(origins[i].rpy_rad.y())) > 1e-3) {
        EXPECT_LT((origins[i].rpy_rad - arm.joints[i].origin.rpy_rad).norm(), 1e-9);
      }
      arm.joints[i].origin = origins[i];
    }
    const JointVector q = random_commands(stream, arm.joints.size());
    EXPECT_LT((forward(changed.chain, q).matrix() - flange_of(arm, q)).cwiseAbs().maxCoeff(), 1e-11) << which;
  }
}

TEST(Origin, OfAPoseMakesItAgainAlsoUpright) {
  RandomStream stream{1806};
  for (int which = 0; which < 1000; ++which) {
    Origin origin = random_origin(stream);
    if (which % 3 == 0) origin.rpy_rad.y() = file_angle(stream);
    const Eigen::Isometry3d pose = pose_of(origin);
    EXPECT_LT((pose.matrix() - matrix_of(origin)).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((pose_of(origin_of(pose)).matrix() - pose.matrix()).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((pose_of(origin_of(pose, origin)).matrix() - pose.matrix()).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(CoupledJoints, AreDrivenByBothCommandsAndComeBack) {
  RandomStream stream{1807};
  const Chain chain = mounted_arm(stream, 6, Convention::standard_dh);
  ASSERT_EQ(chain.couplings.size(), 3u);
  const JointVector q = random_joints(stream, chain);
  const JointVector driven = driven_joints(chain, q);
  EXPECT_NEAR(driven[2], q[2] + chain.couplings[1].factor * q[0] + chain.couplings[2].factor * q[1], 1e-15);
  EXPECT_LT((commanded_joints(chain, driven) - q).norm(), 1e-14);
  const Kinematics at = differential_kinematics(chain, q, chain.tool_m);
  EXPECT_LT((by_drives(chain, at.joints) - at.drives).norm(), 1e-14);
}

TEST(ControllerAngles, TurnBackIntoTheRotationThatEachControllerMeans) {
  RandomStream stream{1808};
  const auto turned = [](const Eigen::Vector3d& axis, double deg) { return about(axis, deg * kHalfTurn / 180.0); };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  for (int which = 0; which < 200; ++which) {
    Origin origin = random_origin(stream);
    if (which % 5 == 0) origin.rpy_rad.y() = file_angle(stream);
    const Eigen::Matrix3d rotation = pose_of(origin).linear();
    for (const ControllerAngles& angles : controller_angles(rotation)) {
      const std::vector<double>& v = angles.values;
      const bool about_three = angles.names.ends_with("deg") && angles.controller != "Kawasaki";
      EXPECT_TRUE(!about_three || std::abs(v[1]) <= 90.0) << angles.controller;
      Eigen::Matrix4d made = Eigen::Matrix4d::Identity();
      if (angles.controller == "KUKA") made = turned(z, v[0]) * turned(y, v[1]) * turned(x, v[2]);
      if (angles.controller == "FANUC" || angles.controller == "Yaskawa")
        made = turned(z, v[2]) * turned(y, v[1]) * turned(x, v[0]);
      if (angles.controller == "Staubli") made = turned(x, v[0]) * turned(y, v[1]) * turned(z, v[2]);
      if (angles.controller == "Kawasaki") made = turned(z, v[0]) * turned(y, v[1]) * turned(z, v[2]);
      if (angles.controller == "ABB")
        made.topLeftCorner<3, 3>() = Eigen::Quaterniond(v[0], v[1], v[2], v[3]).toRotationMatrix();
      if (angles.controller == "Universal Robots") {
        const Eigen::Vector3d vector(v[0], v[1], v[2]);
        made = about(vector.normalized(), vector.norm());
      }
      const Eigen::Matrix3d error = made.topLeftCorner<3, 3>() - rotation;
      EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-9) << angles.controller;
    }
  }
}

}  // namespace
}  // namespace demecal
