// Yaskawa jobs: where base axes stand, on which the robot travels.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "kinematics/chain.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

/// "C3" of C00003 and of C0003; empty where the word names no position of the robot.
std::string robot_position_name(std::string_view word);

class JobBaseAxes {
 public:
  /// Throws InputError unless the arm has six joints that turn, on rails or on none.
  explicit JobBaseAxes(const ReaderInput& input);

  std::size_t rails() const { return rails_; }
  /// Takes the position "NAME=NUMBERS" whose numbers are in [begin, end), in pulses or in mm; not where it is none of
  /// base axes.
  void read(const ProgramText& text, const std::string& name, std::size_t begin, std::size_t end, bool pulses);
  /// The position of base axes that an instruction names; empty: none.
  static std::string named(const ProgramText& text, std::size_t begin, std::size_t end);
  /// Tells the target where the rails stand at motions to it that name these positions of base axes (none: as `key`,
  /// the robot's position); or returns why that is not told.
  std::string take(const std::string& key, const std::set<std::string>& named, Target& target) const;
  /// The robot's own frame, which moves along with the rails, in the base frame.
  Eigen::Isometry3d robot_frame(const Target& target) const;

 private:
  const Chain& arm_;
  const ControllerData& controller_;
  std::size_t rails_;
  std::map<std::string, std::vector<Cell>> positions_;  ///< empty where it is not told where the rails stand
};

}  // namespace demecal::inline languages
