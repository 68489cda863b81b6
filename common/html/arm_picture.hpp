// A picture of an arm as it stands at given joints: from four sides, to scale, as SVG that stands on its own.
#pragma once

#include <string>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline html {

/// From the side (x, z), the front (y, z), above (x, y) and obliquely, in the base frame: links, every joint at its
/// axis (a bar along it) with its number, flange and tool point, the base's axes, and a grid of round millimetres.
/// `joints` in rad or m.
std::string arm_picture(const Robot& robot, const JointVector& joints);

}  // namespace demecal::inline html
