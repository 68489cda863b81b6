// A model as a controller can use it: what the arm does wrong in its own base frame, without the instrument.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "expression/bound.hpp"
#include "kinematics/chain.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline programs {

/// The tool that was measured, where the described one is taken in its place.
struct MeasuredTool {
  Eigen::Isometry3d pose;              ///< on the flange
  std::vector<Effect> effects;         ///< of the arm with it
  std::optional<Posterior> posterior;  ///< of the numbers of the arm with it
};

/// What belongs to the correction of a command, and what does not:
/// - Not the base's place in the instrument's frame, nor any effect of that frame (registration, drift, sensor_scale):
///   the robot that runs a program has no instrument. Poses are in the robot's own base frame. What a fit cannot tell
///   from the base's place stays with the base where a registration is declared: see without_base().
/// - Links, joint offsets, joint corrections and all effects of the arm do.
/// - The tool does: the command brings the tool as it was identified to where the nominal robot has its nominal tool.
/// But
///   a tool point more than 10 mm from its description is the target of an instrument rather than that tool in error,
///   and axes turned by more than 0.05 rad are how it is mounted: then the described ones are taken, and a note says
///   so.
struct CommandModel {
  Robot nominal;               ///< as its maker describes it; what the controller believes
  CorrectedRobot robot;        ///< predicts in the robot's own base frame
  std::vector<double> bounds;  ///< of each joint's correction (rad or m) over its range; infinite where none is stated
  std::vector<std::string> notes{};      ///< sentences about the model that a user should know
  std::string tool_note{};               ///< one about its tool, where that tool is taken; empty: none
  std::optional<Posterior> posterior{};  ///< of the numbers of `robot`; nothing: all of the correction is believed
  std::optional<PredictionInterval> interval{};  ///< beside `posterior`, what predictions err by
  std::vector<Interval> measured{};              ///< of every joint, rad or m; none where the model does not say
  std::map<int, std::vector<Interval>> gaps{};   ///< inside that, where joints, from 0, stood nowhere
  bool tool_identified = true;                   ///< the tool of `robot` is the described one as it was measured
  std::optional<MeasuredTool> measured_tool{};   ///< otherwise, what was measured in its place

  /// Where the nominal robot has its tool: base frame, axes of the flange.
  Eigen::Isometry3d nominal_tool(const JointVector& joints) const;
};

/// `bounds` as above.
CommandModel command_model(const Robot& nominal, const CorrectedRobot& identified, std::vector<double> bounds);

/// Where the described tool stands as the controller believes it, beside the identified one: what lies between them is
/// corrected, which by the rules above is nothing of another tool and no turn of how an instrument's target is mounted.
Eigen::Isometry3d believed_tool(const Eigen::Vector3d& described_m, const Eigen::Isometry3d& identified);

/// The model, with what its file states of how sure it is; numbers that are not part of it are left out.
/// `registration`: the model's base was fitted, and without_base() was applied.
CommandModel with_posterior(CommandModel model, const CorrectedRobot& identified,
                            const std::optional<Posterior>& posterior, std::vector<Interval> measured,
                            bool registration);

/// The model for a program whose tool point, as the program or its user states it, is `tool_m` (on the flange): within
/// 3 mm of the described one, where that was measured, or of the measured one it is that tool, and its measured error
/// counts; elsewhere it is another, taken as it stands.
CommandModel with_stated_tool(CommandModel model, const Eigen::Vector3d& tool_m);

/// `identified` with what no fit can tell from the base's place as `nominal` has it: theta and d of joint 1 (standard
/// Denavit-Hartenberg), or all of joint 1 (modified); behind leading prismatic joints also the next a and d. For models
/// whose registration was fitted: how such a fit shares out base and first joint says nothing of the arm.
CorrectedRobot without_base(CorrectedRobot identified, const Chain& nominal);

/// The range that the model was calibrated in, of one joint (rad or m): where its correction and the effects that
/// depend on it were measured. Nothing where the model states none.
std::optional<Interval> calibrated_range(const CorrectedRobot& robot, int joint);

/// Nothing, or the range that the joint stands outside of by more than 2 deg (20 mm), whole turns aside.
std::optional<Interval> outside_measured(const CommandModel& model, int joint, double value);

/// Nothing, or the stretch without any measurement that the joint stands inside of by more than 2 deg (20 mm).
std::optional<Interval> inside_gap(const CommandModel& model, int joint, double value);

/// How far the joint stands outside that range, whole turns of revolute joints aside; 0 within it.
double distance_outside_calibrated(const CorrectedRobot& robot, int joint, double value);

/// In the middle of what was calibrated or, where that is unknown, of the joint limits.
JointVector middle_joints(const CommandModel& model);

}  // namespace demecal::inline programs
