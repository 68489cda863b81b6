// The arm followed through a program: how it comes to every target, whatever way the program takes there.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "parsed_programs/program.hpp"
#include "programs/command_model.hpp"
#include "programs/configuration.hpp"
#include "programs/correct_program.hpp"

namespace demecal::inline programs {

/// A motion to a target, the first or another.
struct TargetVisit {
  std::size_t order = 0, target = 0;
  bool again = false;
  bool near = false;  ///< it goes near the target: the only ones that the target has
  /// The joints that the arm reaches the target with. Where paths differ in them, all of these joints, undetermined.
  Configurations found{};
  /// From which side each joint comes; 0 where that is not known, or paths differ.
  ApproachSigns approach{};
  bool differing_sides = false;  ///< paths differ in known sides
};

using TargetVisits = std::vector<std::vector<TargetVisit>>;  ///< to each target, the first first

/// What of the target's frames is not known; empty: they are known. A user's tool stands for one that the program does
/// not tell.
std::string unknown_frames(const Target& target, const Circumstances& circumstances);

/// The names of the tools that targets of the program have and it does not tell; not of targets with several. A user's
/// tool cannot stand for more than one of them.
std::set<std::string> untold_tools(const Program& program);

/// What the correction of a target adds to its joints, rad or m: between these.
struct AddedToJoints {
  JointVector least, most;

  /// Both grow as far as to hold it.
  void take_in(const JointVector& added);
  bool operator==(const AddedToJoints&) const = default;
};

/// Of each of these targets, nothing.
std::vector<AddedToJoints> nothing_added(const Program& program, const CommandModel& model);

/// The motions to targets, in the order of the text. A joint comes from the side of its last change of 2 mrad (2 mm) or
/// more; from none that is known where what the corrections add turns it against that side. What is known of the arm
/// ends where arrivals() tells so, and at targets whose joints are not known.
std::vector<TargetVisit> followed_motions(const Program& program, const CommandModel& model,
                                          const Circumstances& circumstances, const std::vector<AddedToJoints>& added);

}  // namespace demecal::inline programs
