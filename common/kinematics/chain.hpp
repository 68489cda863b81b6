// A serial arm: its joints and links by Denavit-Hartenberg parameters, and its tool.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace demecal {

/// The most joints an arm may have; joint vectors live on the stack.
inline constexpr int kMaxJoints = 9;

/// One value per joint: rad for revolute, m for prismatic joints. Joint 1 is element 0.
using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxJoints, 1>;

/// Order of a link's elementary transforms: Rz Tz Tx Rx (standard) or Rx Tx Rz Tz (modified).
enum class Convention { standard_dh, modified_dh };

enum class JointType { revolute, prismatic };

/// The parameters of one link. `beta` is Hayati's rotation about y, zero unless neighbouring axes are near-parallel:
/// Rz Tz Tx Rx Ry (standard), Rx Tx Ry Rz Tz (modified) (Hayati and Mirmirani, 1985).
enum class LinkParameter { theta, d, a, alpha, beta };
inline constexpr int kLinkParameters = 5;

/// One joint and its link. The joint's variable adds to `theta_rad` (revolute) or to `d_m` (prismatic).
struct Joint {
  JointType type = JointType::revolute;
  double theta_rad = 0.0;  ///< offset of a revolute joint, fixed angle of a prismatic one
  double d_m = 0.0;
  double a_m = 0.0;
  double alpha_rad = 0.0;
  double beta_rad = 0.0;
  double lower = 0.0;  ///< limit, rad or m
  double upper = 0.0;  ///< limit, rad or m

  double& parameter(LinkParameter which);
  double parameter(LinkParameter which) const;
};

/// A serial arm from base to flange, with the tool point in the flange frame.
struct Chain {
  Convention convention = Convention::standard_dh;
  std::vector<Joint> joints;
  Eigen::Vector3d tool_m = Eigen::Vector3d::Zero();

  int size() const { return static_cast<int>(joints.size()); }
};

/// Joints stated in deg, mm where one slides: one value per joint.
JointVector joints_from_deg_or_mm(const Chain& chain, std::span<const double> values);

/// Whether the axis of joint `joint` and that of its successor are parallel within `tolerance_rad` at nominal geometry,
/// so that d of one is not separable from d of the other and Hayati's beta is needed. `joint` counts from 0; the last
/// joint has no successor: false.
bool near_parallel_to_next(const Chain& chain, int joint, double tolerance_rad);

}  // namespace demecal
