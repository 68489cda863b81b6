#include "fitting/declared_model.hpp"

#include <array>

#include "errors/check.hpp"

namespace demecal {
namespace {

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

std::string link_name(LinkParameter parameter) {
  switch (parameter) {
    case LinkParameter::theta:
      return "theta_deg";
    case LinkParameter::d:
      return "d_mm";
    case LinkParameter::a:
      return "a_mm";
    case LinkParameter::alpha:
      return "alpha_deg";
    case LinkParameter::beta:
      return "beta_deg";
  }
  DEMECAL_CHECK(false, "link parameter " << static_cast<int>(parameter));
}

}  // namespace

std::string ParameterId::name() const {
  if (kind == Kind::link) return "joint " + std::to_string(index + 1) + " " + link_name(link);
  if (kind == Kind::effect) return effect;
  const std::string axis = kAxes.at(static_cast<std::size_t>(index));
  const std::string of_what = kind == Kind::base_translation || kind == Kind::base_rotation ? "base_" : "tool_";
  const std::string suffix = target.empty() ? "" : " of " + target;
  return of_what + (is_angle() ? "r" + axis + "_deg" : axis + "_mm") + suffix;
}

bool ParameterId::is_angle() const {
  if (kind == Kind::effect) return false;
  if (kind != Kind::link) return kind == Kind::base_rotation || kind == Kind::tool_rotation;
  return link == LinkParameter::theta || link == LinkParameter::alpha || link == LinkParameter::beta;
}

}  // namespace demecal
