// What an engineer counts as one cause among the effects of a model: all lines of one gear, all that gives way under
// load, one joint's lost motion; and what to do about it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "effects/catalogue.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline explanations {

struct ErrorCause {
  CauseGroup group = CauseGroup::formula;
  int joint = -1;                      ///< from 0; -1: of the whole arm, or of the instrument
  std::vector<std::size_t> effects{};  ///< places among the robot's, ascending

  bool is_same_as(const ErrorCause& other) const { return group == other.group && joint == other.joint; }
};

/// The cause that effects of this kind, which must be of the catalogue, and joint have; without effects.
ErrorCause cause_at(std::string_view kind, int joint);

/// The causes of the robot's effects, in the order of their first effects; every effect belongs to one. What the
/// catalogue does not name is a cause of its own for every joint.
std::vector<ErrorCause> causes_of(const CorrectedRobot& robot);

/// The word of files: "transmission", "lost_motion", "elasticity", "balance_spring", "bearing", "link_geometry",
/// "zero", "tool_point", "heat", "instrument", "formula".
std::string_view to_string(CauseGroup group);
/// "gears of joint 2", for people.
std::string to_string(const ErrorCause& cause);
/// What to do about it: a sentence or two. Of a cause without effects what is usual of its group.
std::string advice_on(const ErrorCause& cause, const CorrectedRobot& robot);

}  // namespace demecal::inline explanations
