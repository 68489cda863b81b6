#include "updating/implausible_change.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"

namespace demecal::inline updating {
namespace {

bool is_zero(const ChangeCause& cause) {
  return declared_flag(cause.effect.kind) == &DeclaredModel::joint_offset;
}

bool is_of_places(const ChangeCause& cause) {
  return cause.is_registration || is_zero(cause) || declared_flag(cause.effect.kind) == &DeclaredModel::tool;
}

}  // namespace

bool explains_implausible(const ChangeReport& change, double implausible_m) {
  constexpr double kMost = 0.5;
  return !change.found.empty() && !change.more && !change.unnamed && std::ranges::all_of(change.found, is_of_places) &&
         change.left_m < kMost * implausible_m;
}

bool is_far_beyond_usual(const ChangeReport& change) {
  constexpr double kFar_deg = 3.0, kFar_m = 15e-3;
  return change.implausible || std::ranges::any_of(change.found, [](const ChangeCause& cause) {
           return is_zero(cause) && std::abs(cause.size) > (cause.unit == "m" ? kFar_m : radians(kFar_deg));
         });
}

}  // namespace demecal::inline updating
