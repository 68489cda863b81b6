// An arm as its file describes it, and its pose at given joints: what `robot show` prints.
#pragma once

#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "data_files/link_inertias.hpp"
#include "kinematics/chain.hpp"

namespace demecal {

struct ShownRobot {
  const Robot& robot;
  const LinkInertias& inertias;
  JointVector joints;                 ///< where it stands
  std::vector<std::string> warnings;  ///< of these joints, and of units in the file
};

/// "joint 2 at 170 deg is beyond its limits, ...": of every joint that is.
std::vector<std::string> beyond_limits_sentences(const Chain& chain, const JointVector& joints);

/// Joints, table, links and the pose, in lines.
void print_shown(const ShownRobot& shown);

/// The same on one line of JSON, without the table.
std::string shown_json(const ShownRobot& shown);

}  // namespace demecal
