// The joints in which the nominal arm reaches a target, which of its configurations the program and the user mean, and
// whether two joint positions have the same: shoulder, elbow and wrist on the same sides.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinematics/chain.hpp"
#include "parsed_programs/program.hpp"
#include "programs/nominal_joints.hpp"

namespace demecal::inline programs {

/// Joints at which the nominal arm's tool point (axes of the flange) stands at `tool`, no two alike but for whole
/// turns, each in the turn within its limits that is nearest to `reference`; those within the limits where there are
/// any. They are searched for from a fixed set of joints and from `reference`, so that a far one may be missed but the
/// answer never varies. Of arms with more than six joints, some of the many. `held` joints, from the base on, stay as
/// `reference` has them.
std::vector<JointVector> joints_reaching(const Chain& arm, const Eigen::Isometry3d& tool, const JointVector& reference,
                                         int held = 0);

/// Joints that the arm ends with when its tool moves from where it is at `from` straight to `tool`, turning evenly.
/// Nothing where it cannot follow, or passes so near to a singularity that joints would leap. `held` joints, from the
/// base on, stay as `from` has them.
std::optional<JointVector> joints_after_line(const Chain& arm, const JointVector& from, const Eigen::Isometry3d& tool,
                                             int held = 0);

/// Where a target's joints come from.
enum class JointsFrom {
  target,        ///< it states them
  stated,        ///< its configuration is stated (T, confdata, ...) or named (qnear)
  line,          ///< the arm follows a straight line from joints that are known
  before,        ///< one configuration is clearly nearer than others to known joints before
  given,         ///< the same of the joints that the user gives
  only,          ///< there is only one
  undetermined,  ///< several are possible
  nowhere        ///< none was found
};
std::string_view to_string(JointsFrom from);

struct Configurations {
  JointsFrom from = JointsFrom::nowhere;
  std::vector<JointVector> joints{};  ///< the likeliest first; several only where it is undetermined
  std::string contradicted_by{};      ///< words that state another configuration, and mean this one; empty: none do
};

/// Follows a program from target to target.
class ConfigurationFinder {
 public:
  /// `near`: joints (rad, m) that the user says the arm is near to; empty: none. `middle` decides between whole turns.
  ConfigurationFinder(JointVector near, JointVector middle) : near_(std::move(near)), middle_(std::move(middle)) {}

  /// For a target whose tool point (axes of the flange, base frame) is to stand at `tool`. What a target states comes
  /// first, then a straight line from known joints, then nearness to known joints, then to the user's. Words that state
  /// a configuration tell it where a target before had the same; otherwise only joints right before, or the user's, do
  /// that are so near that no other configuration can be meant. Where each part of the arm is stated by itself, those
  /// are left that have each on the side that is known to be meant; nearness decides on parts of which any side will
  /// do. Rails stand where the target has them; only the joints behind them tell what is near. A line is one as the arm
  /// on the rails sees it: with even motion of both, it is one.
  Configurations find(const Chain& arm, const Target& target, const Eigen::Isometry3d& tool) const;

  /// Tells where the arm is now, nothing: unknown; and in what words that configuration was stated, empty: in none.
  void arrive(std::optional<JointVector> joints, const std::string& configuration);

 private:
  Configurations find_carried(const Chain& arm, const Target& target, const Eigen::Isometry3d& tool) const;
  ConfigurationFinder carried_to(const std::vector<Cell>& rails) const;
  Configurations find_any(const Chain& arm, const Target& target, const Eigen::Isometry3d& tool) const;
  Configurations find_worded(const Chain& arm, const std::string& words, const Eigen::Isometry3d& tool) const;
  Configurations find_by_parts(const Chain& arm, const std::vector<PartHint>& parts,
                               const Eigen::Isometry3d& tool) const;
  std::optional<JointVector> joints_with(const std::string& word, std::size_t part) const;
  bool states_others(const ArmHint& hint) const;

  JointVector near_, middle_;
  std::optional<JointVector> present_;
  std::string present_words_{};
  std::map<std::string, JointVector> worded_{};  ///< joints last reached in a configuration of these words
  int held_ = 0;                                 ///< so many joints, from the base on, stand where the target has them
};

/// How many regular configurations an arm can have for one pose, told by its axes at any joints: 8 where the wrist's
/// three axes meet in a point (Pieper, 1968: four places of the other joints, two of the wrist), or axes 2, 3 and 4 are
/// parallel and 5 and 6 meet (two places of joint 1, of the wrist and of the elbow); 16 of other six revolute joints.
std::size_t most_configurations(const Chain& arm, const JointVector& joints);

/// Nothing where the arm is not of six revolute joints (behind rails or none) with parallel axes 2 and 3 and a wrist
/// whose axes meet, or where one of the positions is so near to a singular one that a side cannot be told.
std::optional<bool> same_posture(const Chain& arm, const JointVector& one, const JointVector& other);
/// The same of shoulder (0), elbow (1) or wrist (2) alone.
std::optional<bool> same_side(const Chain& arm, const JointVector& one, const JointVector& other, std::size_t part);
/// Whether the part is not on the same side at both, however near to singular they are: on the other, or on none at one
/// of them. False where the arm has no such sides; those of the wrist also arms have whose wrist's axes do not meet.
bool leaves_side(const Chain& arm, const JointVector& one, const JointVector& other, std::size_t part);

}  // namespace demecal::inline programs
