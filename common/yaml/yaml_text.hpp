// Values as YAML text, for the files that are written here.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>

#include "data/text.hpp"

namespace demecal::inline yaml {

/// A text as a YAML scalar that reads back the same: plain where it is a simple word, in double quotes otherwise.
std::string yaml_text(std::string_view text);

/// The text as a comment line, whatever it holds.
std::string yaml_comment(std::string_view text);

/// "[a, b, c]" of scalars that are YAML already.
std::string yaml_list(std::span<const std::string> scalars);

/// The same of numbers, as short as they can be written.
std::string yaml_numbers(std::span<const double> values);
/// The same of lengths, mm from m.
std::string yaml_mm(const Eigen::Vector3d& lengths_m);

/// An angle's shortest text in degrees, from rad; a length's in mm, from m.
std::string degrees_text(double angle_rad);
std::string millimetres_text(double length_m);

}  // namespace demecal::inline yaml
