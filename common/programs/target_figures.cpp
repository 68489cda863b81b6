#include "programs/target_figures.hpp"

#include "data/number.hpp"
#include "kinematics/inverse.hpp"
#include "kinematics/units.hpp"

namespace demecal {

TargetFigures figures_of(const Target& target, const CorrectedTarget& corrected, const Chain& arm) {
  TargetFigures figures;
  const auto add = [&](const std::string& name, const std::string& unit, double nominal, double command) {
    figures.names.push_back(name);
    figures.units.push_back(unit);
    figures.nominal.push_back(nominal);
    figures.corrected.push_back(command);
    figures.difference.push_back(command - nominal);
  };
  for (int joint = 0; joint < arm.size() && !target.is_pose(); ++joint) {
    const bool revolute = is_revolute(arm, joint);
    const UnitConversion to_border = revolute ? degrees : millimetres;
    add("q" + std::to_string(joint + 1), revolute ? "deg" : "mm", to_border(corrected.nominal[joint]),
        to_border(corrected.command[joint]));
  }
  const Eigen::Isometry3d frame_from_base = target.frames.base_from_frame.inverse();
  const Eigen::Vector3d nominal_m = frame_from_base * corrected.nominal_tool.translation();
  const Eigen::Vector3d command_m = frame_from_base * corrected.command_tool.translation();
  for (int axis = 0; axis < 3 && target.is_pose(); ++axis) {
    add(std::string(1, static_cast<char>('x' + axis)), "mm", millimetres(nominal_m[axis]),
        millimetres(command_m[axis]));
  }
  const PoseError moved = pose_error(corrected.nominal_tool, corrected.command_tool);
  figures.moved_mm = millimetres(moved.head<3>().norm());
  figures.turned_deg = degrees(moved.tail<3>().norm());
  return figures;
}

}  // namespace demecal
