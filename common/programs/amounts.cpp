#include "programs/amounts.hpp"

#include <array>
#include <charconv>

#include "kinematics/units.hpp"

namespace demecal {

std::string fixed_text(double value, int decimals) {
  std::array<char, 400> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
  return {buffer.data(), end.ptr};
}

std::string joint_amount(const Joint& joint, double value) {
  if (!is_revolute(joint)) return fixed_text(millimetres(value), 3) + " mm";
  return fixed_text(degrees(value), 4) + " deg";
}

std::string joint_label(int joint) {
  return "joint " + std::to_string(joint + 1);
}

}  // namespace demecal
