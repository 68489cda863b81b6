// Which of its configurations an arm reaches a target in, as far as the program and the user say it.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "programs/program.hpp"

namespace demecal {

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
std::string_view word_of(JointsFrom from);

struct Configurations {
  JointsFrom from = JointsFrom::nowhere;
  std::vector<JointVector> joints{};  ///< the likeliest first; several only where it is undetermined
};

/// Follows a program from target to target.
class ConfigurationFinder {
 public:
  /// `near`: joints (rad, m) that the user says the arm is near to; empty: none. `middle` decides between whole turns.
  ConfigurationFinder(JointVector near, JointVector middle) : near_(std::move(near)), middle_(std::move(middle)) {}

  /// For a target whose tool point (axes of the flange, base frame) is to stand at `tool`. What a target states comes
  /// first, then a straight line from known joints, then nearness to known joints, then to the user's.
  Configurations find(const Chain& arm, const Target& target, const Eigen::Isometry3d& tool) const;

  /// Tells where the arm is now; nothing: unknown.
  void arrive(std::optional<JointVector> joints) { present_ = std::move(joints); }

 private:
  JointVector near_, middle_;
  std::optional<JointVector> present_;
};

}  // namespace demecal
