#include "updating/unseen_zeros.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstddef>
#include <string>

#include "parameters/declared_model.hpp"

namespace demecal::inline updating {

std::vector<UnseenZero> unseen_zeros(const ScaledChangeRows& scaled, const ChangeRows& rows,
                                     const std::vector<Effect>& effects, bool set_up_anew) {
  constexpr double kNineInTen = 1.645 + 1.282, kLarge = 10e-3;
  constexpr double kFewest = kNineInTen / kLarge;  // norm of a column per rad or m
  std::vector<UnseenZero> unseen;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (declared_flag(effects[i].kind) != &DeclaredModel::joint_offset || rows.columns[i].norm() >= kFewest) continue;
    const int joint = effects[i].joint;
    std::string why;
    if (scaled.columns[i].norm() < kFewest)
      why =
          "the tool point lies on its axis, or close to it, and no orientations are compared. "
          "Measure a target beside that axis, or "
          "orientations with a model that was calibrated with them";
    else if (set_up_anew)
      why =
          "the base was found again, and a turn of the base does the same. "
          "Leave instrument and base where they were "
          "at the calibration";
    else
      why =
          "the model itself knows it no better. Measure more poses for the "
          "calibration";
    unseen.push_back({joint, fmt::format("The zero of joint {} cannot be seen "
                                         "by these poses, and may be off: {}.",
                                         joint + 1, why)});
  }
  std::ranges::sort(unseen, {}, &UnseenZero::joint);
  return unseen;
}

}  // namespace demecal::inline updating
