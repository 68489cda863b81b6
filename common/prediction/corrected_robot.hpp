// The robot as it really is: identified geometry, base and tool, and what its joints do wrong; what to command so that
// it arrives.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "expression/bound.hpp"
#include "expression/tree.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/inverse.hpp"
#include "prediction/contact_place.hpp"

namespace demecal::inline prediction {

/// The correction g(theta) of one joint: h(theta) = theta + g(theta) is where it really goes (thesis eq. 4.1). Outside
/// its calibrated range it keeps the value it has at the nearer end, so that it never extrapolates. Of a prismatic
/// joint theta, g and the range are in m, and the branch does not wrap.
class JointCorrection {
 public:
  JointCorrection() = default;  ///< neutral: corrects nothing, anywhere
  /// `formula` of the one variable theta, taken on `branch` and then within `range_rad` (lower <= upper).
  JointCorrection(Tree formula, AngleBranch branch, Interval range_rad);

  /// g at a commanded angle, rad.
  double operator()(double theta_rad) const;
  /// dg / dtheta, rad per rad; 0 outside the range.
  double slope(double theta_rad) const;

  bool is_neutral() const { return neutral_; }
  const Tree& formula() const { return formula_; }
  const AngleBranch& branch() const { return branch_; }
  const Interval& range_rad() const { return range_rad_; }

 private:
  Tree formula_ = neutral_tree();
  Tree derivative_ = constant_tree(0.0);
  AngleBranch branch_;
  Interval range_rad_;
  bool neutral_ = true;
};

/// What a unit of a coefficient of one of a model's effects does.
struct EffectMotion {
  int effect = 0;  ///< of the model's, from 0
  UnitMotion unit;
};

/// The motions of all effects at a state of the nominal arm, by effect.
std::vector<EffectMotion> effect_motions(const std::vector<Effect>& effects, const Robot& described,
                                         const ArmState& state);

/// Motions of all kinds, added up over the effects.
struct Displacement {
  JointVector joints;   ///< what moves (m, rad) along or about the joints' own axes, as a change of the command
  PlaceMotions places;  ///< the rest, by place
  SmallMotion sensor;   ///< of the whole arm, in the measurements' frame about its origin; it comes last
};
Displacement displacement(const Chain& chain, const std::vector<Effect>& effects,
                          const std::vector<EffectMotion>& motions);

/// Whether the motion is that of a joint about or along its own axis.
bool is_joint_motion(const Chain& chain, const UnitMotion& motion);

/// Predicts where the real robot goes when it is commanded to given joints:
/// sensor_from_base * forward(chain, q + g(q)) * tool, with the small motions that the effects make put in at their
/// places, and those of the instrument before all.
struct CorrectedRobot {
  Chain chain;  ///< with identified parameters
  Eigen::Isometry3d sensor_from_base = Eigen::Isometry3d::Identity();
  std::map<std::string, Eigen::Isometry3d> tools;  ///< flange_from_tool of every target; "" is the robot's own
  std::vector<JointCorrection> corrections;        ///< one per joint
  std::vector<Effect> effects{};                   ///< what else the arm does, by how `described` stands
  Robot described{};  ///< the arm as its maker describes it; needed where there are effects
  /// Least and greatest payload that it was calibrated with; nothing where no pose stated one.
  std::optional<Interval> payloads_kg{};
  /// The same of temperatures.
  std::optional<Interval> temperatures_celsius{};
  /// Where contacts are taken to be, in the measurements' frame: estimates beside the arm, none of its numbers.
  std::map<ContactGroup, ContactPlace> contacts{};
  /// What takes points of a further station, as the data set gives them, to where the first station would measure them.
  std::map<std::string, Eigen::Isometry3d> stations{};

  /// flange_from_tool of a target; the robot must have it.
  const Eigen::Isometry3d& tool(const std::string& target) const;
  /// What it takes to apply one of the effects as it was calibrated: the payload also where known masses alone make it,
  /// and the arm was calibrated with something in its hand.
  Needs needs(const Effect& effect) const;
  /// q + g(q): the command that, without corrections, would turn the joints to where they are. g does not pass through
  /// couplings.
  JointVector corrected_joints(const JointVector& commanded) const;
  /// The same, and what the effects add about or along the joints' axes.
  JointVector actual_joints(const Stop& stop) const;
  /// Unit motions of the effects at a stop with the tool of `target`. They depend on the model's numbers only where an
  /// effect depends on where the tool is seen, and there on where it would be without effects.
  std::vector<EffectMotion> motions(const Stop& stop, const std::string& target) const;

  /// Pose of the tool in the frame of the measurements, at commanded joints and their circumstances.
  Eigen::Isometry3d predict(const Stop& stop, const std::string& target) const;
  /// The same from joints already corrected and motions already known.
  Eigen::Isometry3d predict(const JointVector& corrected, const std::vector<EffectMotion>& motions,
                            const std::string& target) const;
  /// The pose with its Jacobian by the commanded joints, rows in the measurements' frame: corrections' slopes included,
  /// but not those of the effects, which are taken to stay as they are at `stop` (their slopes are a hundredth of the
  /// joints' own at most, so that Newton's steps still converge).
  PoseAndJacobian predict_with_jacobian(const Stop& stop, const std::string& target) const;
};

/// The robot of the data set with nothing identified: nominal chain, the sensor's frame taken as the base, nominal
/// tools, neutral corrections. It has a tool for every target the set or any of its poses names.
CorrectedRobot nominal_robot(const DataSet& data);

/// The joints to command so that the real robot arrives where the nominal robot, in the same base and with the same
/// tool, would stand at `desired`: the exact inverse of the full model, for the robot's own tool, found from `desired`
/// so that the arm keeps its configuration. Approach, payload, temperature and time are taken as given. Where there is
/// no such inverse within half a radian (or metre) of `desired` in every joint (near a singularity, with fewer than 6
/// joints, out of reach) it is damped least squares, position first, orientation as far as small motions go: the status
/// then is not `converged`, and the residuals say what remains.
InverseSolution corrected_command(const CorrectedRobot& robot, const Chain& nominal, const Stop& desired,
                                  const InverseOptions& options = {});

/// The joints to command so that the model predicts its own tool at `goal` (in the model's measurements' frame), found
/// from `start`, whose approach, payload, temperature and time are taken as given. Where there is no such inverse
/// within half a radian (or metre) of `start` in every joint it is damped least squares: see corrected_command().
InverseSolution command_reaching(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& start,
                                 const InverseOptions& options = {});

}  // namespace demecal::inline prediction
