// What laws are written with: motions of joints, links and places, their labels and equations, and amounts for people.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline effects {

/// Appends a motion of the joint itself: about its axis, or along it where it is prismatic. Nothing where it is zero.
void append_joint_motion(const Robot& robot, int joint, int coefficient, double size, std::vector<UnitMotion>& motions);

/// Appends the motions, at place `joint`, that `size` (rad or m) of a link parameter per unit of `coefficient` makes
/// where the joint is commanded to `q`: its elementary transform's screw in that place's frame.
void append_link_motion(const Chain& chain, int joint, double q, LinkParameter parameter, int coefficient, double size,
                        std::vector<UnitMotion>& motions);

/// "theta_rad": the stem with the unit of the joint's motion.
CoefficientLabel motion_label(const Robot& robot, int joint, const std::string& stem);
/// "rad_per_nm" ("m_per_n"), or "STEM_rad_per_nm": the joint's motion by its load.
CoefficientLabel compliance_label(const Robot& robot, int joint, const std::string& stem = "");

/// So many significant digits, fewer where the last are 0.
std::string significant_text(double value, int count);
/// Three significant digits; whole numbers from 100 on.
std::string rounded_text(double value);
/// "0.5 mrad (103 arcsec)".
std::string angle_text(double angle_rad);
/// "0.12 mm".
std::string length_text(double length_m);
/// The size of a joint's motion: an angle or a length.
std::string motion_text(const Robot& robot, int joint, double motion);
/// "120 ppm".
std::string share_text(double share);
/// "Nm" or "N": what gravity does to the joint along its axis.
std::string load_unit(const Robot& robot, int joint);
/// "Joint 2"; joints count from 1.
std::string joint_name(int joint);
/// "q2".
std::string joint_symbol(int joint);
/// "once per turn", "twice per turn", "24 times per turn".
std::string times_per_turn(double order);

/// One term of an equation: scale * coefficient * factor.
struct Term {
  std::size_t coefficient;
  std::string factor;
  double scale = 1.0;
};
/// What moves, and the terms it is the sum of.
struct Equation {
  std::string left;
  std::vector<Term> terms;
};
/// "dq2 = 0.0003 rad cos(24 q2) - 0.0001 rad sin(24 q2)"; several equations are separated by commas. Coefficients are
/// written with four digits.
std::string write_equations(const Effect& effect, const Robot& robot, const std::vector<Equation>& equations);
/// The same of the joint's own motion: "dq2 = ...".
std::string write_joint_equation(const Effect& effect, const Robot& robot, const std::vector<Term>& terms);
/// The terms of coefficients 0 and 1: "cos(24 q2)" and "sin(24 q2)".
std::vector<Term> harmonic_terms(double ratio, int joint);

/// "x_m" .. "rz_rad", each with `suffix` ("_per_s") in the name and `per` ("/s") in the unit: the first `count` of
/// them.
std::vector<CoefficientLabel> rigid_labels(int count, const std::string& suffix = "", const std::string& per = "");
/// Appends the first `count` motions of `place`, coefficient by coefficient, each of `size`.
void append_rigid_motions(int place, int count, double size, std::vector<UnitMotion>& motions);
/// "dx = 0.001 m, ..., drz = 0.002 rad" with `symbol` before the axis and `factor` behind each value.
std::string write_rigid_equations(const Effect& effect, const Robot& robot, int count, const std::string& symbol,
                                  const std::string& factor = "");
/// "(0.1, 0.2, 0.3) mm": three coefficients from `first` on, times `scale`.
std::string triple_text(const Effect& effect, std::size_t first, double scale, const std::string& unit);

/// K above the setting reference_celsius; 0 where either is unknown.
inline double warming_kelvin(const Effect& effect, const Stop& stop) {
  const auto reference = effect.settings.find("reference_celsius");
  if (!stop.temperature_celsius || reference == effect.settings.end()) return 0.0;
  return *stop.temperature_celsius - reference->second;
}

/// "(T - 20 degC)".
inline std::string warming_symbol(const Effect& effect) {
  return "(T - " + rounded_text(effect.setting("reference_celsius")) + " degC)";
}

}  // namespace demecal::inline effects
