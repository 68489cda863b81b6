// The correction of one target whose joints are known, and how much of it is made: no more than is surely known, and no
// large joint motions near singular joints; amounts as sentences about targets write them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "effects/arm_state.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/inverse.hpp"
#include "parsed_programs/program.hpp"
#include "prediction/corrected_robot.hpp"
#include "programs/command_model.hpp"
#include "programs/configuration.hpp"

namespace demecal::inline programs {

/// With so many decimals.
std::string fixed_text(double value, int decimals);
/// A joint's value or a change of it, from rad or m: "12.3456 deg", "7.890 mm".
std::string joint_amount(const Joint& joint, double value);
/// "joint 3", from 0.
std::string joint_label(int joint);

enum class CorrectionOutcome {
  corrected,    ///< or in no need of it
  nearest,      ///< the model has no exact inverse here; what could be corrected is
  uncorrected,  ///< left as it is, since its frame, tool or configuration is not known; the remarks say why
  no_joints     ///< the nominal robot cannot reach the pose; it is left as it is
};

struct CorrectedTarget {
  CorrectionOutcome outcome = CorrectionOutcome::no_joints;
  JointsFrom from = JointsFrom::nowhere;
  Stop stop{JointVector()};      ///< the nominal joints and the circumstances they were corrected for
  int held = 0;                  ///< so many joints, from the base on, stay as they are: rails
  JointVector nominal, command;  ///< joints, rad or m: as the program means, and as it is to be sent
  JointVector inverse;           ///< the model's own, of the whole pose; `command` differs where an orientation is kept
  Eigen::Isometry3d nominal_tool, command_tool;  ///< of the nominal robot there, base frame
  Eigen::Isometry3d goal;  ///< of the model's tool: the nominal pose, as far as the correction to it is determined
  double left_m = 0.0;     ///< of the position's correction: what is not determined, and so not made
  double residual_m = 0.0, residual_rad = 0.0;  ///< of what was to be corrected, what the model predicts to be left
  /// Holds the real tool point about where the program sends it 95 % of the time: what is known to be left of its error
  /// is added, that of rounded numbers too where it is more than 0.005 mm.
  std::optional<double> error95_m{};
  std::vector<std::string> widened_by{};  ///< why that radius is larger than where the arm was measured
  /// How far apart the real tool point may stand by the sides of approach that are not known; half is in error95_m.
  double unknown_side_m = 0.0;
  std::vector<std::string> remarks{};  ///< what a user should know of how it was corrected
  std::vector<std::string> left{};     ///< directions that are left as programmed; of orientation no remarks
  std::vector<std::string> texts{};    ///< of the cells, joints or position and then orientation; empty: kept

  bool is_uncorrected() const {
    return outcome == CorrectionOutcome::uncorrected || outcome == CorrectionOutcome::no_joints;
  }
  /// Whether its joints and configuration are known, and it is sent to where it was.
  bool is_as_programmed() const { return !is_uncorrected() && command == nominal; }
};

/// The radius that holds the real tool point about where the model has it at that stop, 95 % of the time, m; larger
/// outside what was measured. Nothing where the model does not state it.
std::optional<double> error95_m(const CommandModel& model, const Stop& stop);

/// By how much that radius is larger than where the arm was measured, and why.
Widening widening_at(const CommandModel& model, const Stop& stop);

/// Sends the target, whose nominal joints and circumstances are `stop`, to where model(command) = nominal: as far as
/// the model's posterior determines the correction (see determined_part()), and without large joint motions near
/// singular joints (see nearby_command()). A direction of position that is left is a remark, one of orientation a note.
/// `texts` stay empty.
CorrectedTarget correct_target(const Target& target, const CommandModel& model, const Stop& stop);

/// The texts of a corrected target's cells.
std::vector<std::string> cell_texts(const Target& target, const CorrectedTarget& corrected);

/// How far the tool point is off where the cells hold these texts in place of the exact numbers, m.
double rounding_m(const Target& target, const CommandModel& model, const CorrectedTarget& corrected);

/// A correction of position (m) or of orientation (rad), as far as it should be made.
struct DeterminedPart {
  Eigen::Vector3d applied = Eigen::Vector3d::Zero();
  Eigen::Vector3d omitted =
      Eigen::Vector3d::Zero();  ///< direction (unit norm) left as programmed; 0: none worth saying
  double deviation = 0.0;       ///< standard deviation of the correction along `omitted`
};

/// Of `correction`, whose error has this covariance, along the covariance's principal axes. An axis may be corrected
/// where the correction's square is above twice its variance: below, leaving it is nearer to the truth on average. Of
/// all sets of such axes that one is corrected which lowers the squared error most, scaled down as far as needed for
/// the error to be no larger than before by four standard deviations, in the normal approximation. Directions in which
/// less than half is corrected, and whose deviation is above `worth_saying`, are said: the least known of them.
DeterminedPart determined_part(const Eigen::Vector3d& correction, const Eigen::Matrix3d& covariance,
                               double worth_saying);

/// As command_reaching(), but joints stay within a few times the correction itself (position over 0.3 m, and angle): in
/// directions that the arm has nearly lost the correction is left, of orientation rather than of position, and the
/// status is `damped` where that leaves more than 5 um or 0.05 mrad. `held` joints, from the base on, stay as they are.
InverseSolution nearby_command(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& start,
                               int held = 0);

}  // namespace demecal::inline programs
