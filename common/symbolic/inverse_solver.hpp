// How the exported inverse finds joints: C of Newton's steps on `forward`, bounded near singular joints as programs are
// corrected.
#pragma once

#include <cstddef>
#include <string>

namespace demecal::inline symbolic {

/// The numbers that its functions are written with; those that nearby_command() has are the same.
std::string inverse_constants_in_c();

/// The steps to where the tool is at a goal, behind `forward` and `nominal_forward` and with N defined.
std::string reach_in_c();

/// Behind these the functions `inverse` and `corrected` of an arm of so many joints.
std::string bounded_inverse_in_c(std::size_t joints);

}  // namespace demecal::inline symbolic
