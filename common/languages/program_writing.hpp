// What writers of programs are made of: stops given by joints, and their numbers as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinematics/chain.hpp"

namespace demecal::inline languages {

/// One stop of a program that is written.
struct ProgrammedStop {
  std::string name;    ///< a letter, then letters and digits
  JointVector joints;  ///< rad or m
  bool waits = false;  ///< until an operator lets the program go on, for something is measured here
};

/// The joints in degrees and mm (to 0.0001), each with its name before it where there are names, separated so.
std::string joints_text(const Chain& arm, const JointVector& joints, std::string_view separator,
                        const std::vector<std::string>& names = {});
/// The same in rad and m, to 1e-8.
std::string joints_text_si(const JointVector& joints, std::string_view separator);

/// "A1", "A2", ... as many as the arm has joints.
std::vector<std::string> numbered_names(std::string_view stem, int count);

/// Whether targets of six joints can be of this arm, all of them revolute.
bool has_six_revolute_joints(const Chain& arm);

}  // namespace demecal::inline languages
