// A serial arm: its joints and links by Denavit-Hartenberg parameters, the elementary transforms they stand for, and in
// what two arms differ as their makers describe them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace demecal::inline kinematics {

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

/// What drives a joint, as its maker states it.
enum class GearKind { strain_wave, cycloidal, planetary, spur };
struct Gear {
  GearKind kind = GearKind::strain_wave;
  double ratio = 1.0;  ///< turns of its input for a turn of the joint, above 1

  bool operator==(const Gear&) const = default;
};

/// One joint and its link. The joint's variable adds to `theta_rad` (revolute) or to `d_m` (prismatic).
struct Joint {
  JointType type = JointType::revolute;
  double theta_rad = 0.0;  ///< offset of a revolute joint, fixed angle of a prismatic one
  double d_m = 0.0;
  double a_m = 0.0;
  double alpha_rad = 0.0;
  double beta_rad = 0.0;
  double lower = 0.0;    ///< limit, rad or m
  double upper = 0.0;    ///< limit, rad or m
  bool endless = false;  ///< turns on and on: its limits are a whole turn either way and nobody is held to them
  std::optional<Gear> gear{};

  double& parameter(LinkParameter which);
  double parameter(LinkParameter which) const;
};

/// A joint whose drive its controller also turns by `factor` times the command of another, nearer to the base: `from`
/// < `joint`.
struct CommandCoupling {
  int joint;
  int from;
  double factor;

  bool operator==(const CommandCoupling&) const = default;
};

/// A serial arm from base to flange, with the tool point in the flange frame. Behind a positioner it begins in the
/// workpiece, whose frame is then the base frame of all that follows.
struct Chain {
  Convention convention = Convention::standard_dh;
  std::vector<Joint> joints;
  Eigen::Vector3d tool_m = Eigen::Vector3d::Zero();
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();    ///< where the first link's transforms begin, base frame
  Eigen::Isometry3d flange = Eigen::Isometry3d::Identity();  ///< the flange in the last link's frame
  std::vector<CommandCoupling> couplings{};                  ///< by joint
  int positioner = 0;  ///< so many joints, the first, lead from a workpiece that they carry to what the arm stands on

  int size() const { return static_cast<int>(joints.size()); }
};

inline bool is_revolute(const Joint& joint) {
  return joint.type == JointType::revolute;
}
inline bool is_revolute(const Chain& chain, int joint) {
  return is_revolute(chain.joints[static_cast<std::size_t>(joint)]);
}
/// The parameter that the joint's variable adds to: theta of a revolute joint, d of a prismatic one.
inline LinkParameter moving_parameter(const Joint& joint) {
  return is_revolute(joint) ? LinkParameter::theta : LinkParameter::d;
}

/// Where the drives turn the joints, about their own axes, when the controller is commanded to `commanded`: the same
/// but for couplings. Linear, so that it also takes changes to changes.
JointVector driven_joints(const Chain& chain, JointVector commanded);
/// Its inverse. Errors of drives do not pass through couplings: a command that is off by `commanded_joints(errors)`
/// comes to the same.
JointVector commanded_joints(const Chain& chain, JointVector driven);

/// Joints stated in deg, mm where one slides: one value per joint.
JointVector joints_from_deg_or_mm(const Chain& chain, std::span<const double> values);

/// The share of its range, in (0, 1), at which joint `joint` (from 0) stands at the `index`-th (from 1) of a sequence
/// of poses that fills the joints' ranges evenly (Halton, 1960).
double spread_share(int index, std::size_t joint);

/// Share of a joint's range, at either end, in which nothing is measured unless it is asked for.
inline constexpr double kLimitMargin = 0.02;

/// Below this angle axes are near-parallel: d cannot be distinguished from that of the next joint.
inline constexpr double kNearParallel_rad = 0.02;

/// Whether the axis of joint `joint` and that of its successor are parallel within `tolerance_rad` at nominal geometry,
/// so that d of one is not separable from d of the other and Hayati's beta is needed. `joint` counts from 0; the last
/// joint has no successor: false.
bool near_parallel_to_next(const Chain& chain, int joint, double tolerance_rad);
/// Whether link `link` leads between near-parallel axes: its common normal has no certain place along them, and
/// Hayati's beta stands for its d.
bool leads_between_parallels(const Chain& chain, int link, double tolerance_rad);

struct Elementary {
  LinkParameter parameter;
  bool rotates;  ///< about the axis; otherwise it translates along it
  int axis;      ///< 0 x, 1 y, 2 z, of the frame it stands in
};

/// The order of a link's transforms: standard Rz Tz Tx Rx Ry, modified Rx Tx Ry Rz Tz (the y rotation is Hayati's).
const std::array<Elementary, kLinkParameters>& elementary_transforms(Convention convention);

/// The value of an elementary transform of a joint whose variable is `q`, rad or m.
double elementary_value(const Joint& joint, LinkParameter parameter, double q);

/// Cosine and sine of an angle.
struct Turn {
  double cosine = 1.0, sine = 0.0;
};
Turn turn_by(double angle_rad);
/// `frame` turned about its own axis of this number.
void rotate(Eigen::Isometry3d& frame, int axis, const Turn& turn);

/// `frame` moved by an elementary transform of the given value.
void advance(Eigen::Isometry3d& frame, const Elementary& transform, double value);

/// The first difference of `other` from `one`, said of `other`: "its joint 3 has d 120 mm, not 100 mm"; empty where
/// there is none. Tools and limits may differ, and numbers by what rounding leaves (1e-9 m or rad).
std::string first_difference(const Chain& one, const Chain& other);

}  // namespace demecal::inline kinematics
