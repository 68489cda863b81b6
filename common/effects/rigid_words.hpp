// Six small motions of one place, and how laws speak of them.
#pragma once

#include <string>
#include <vector>

#include "effects/effect.hpp"

namespace demecal {

/// "x_m" .. "rz_rad", each with `suffix` ("_per_s") in the name and `per` ("/s") in the unit: the first `count` of
/// them.
std::vector<CoefficientLabel> rigid_labels(int count, const std::string& suffix = "", const std::string& per = "");
/// Appends the first `count` motions of `place`, coefficient by coefficient, each of `size`.
void append_rigid_motions(int place, int count, double size, std::vector<UnitMotion>& motions);
/// "dx = 0.001 m, ..., drz = 0.002 rad" with `symbol` before the axis and `factor` behind each value.
std::string write_rigid_equations(const Effect& effect, const Robot& robot, int count, const std::string& symbol,
                                  const std::string& factor = "");
/// "(0.1, 0.2, 0.3) mm": three coefficients from `first` on, times `scale`.
std::string triple_words(const Effect& effect, std::size_t first, double scale, const std::string& unit);

}  // namespace demecal
