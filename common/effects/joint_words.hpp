// How laws speak of a joint: its motion, its units, and amounts of them for people.
#pragma once

#include <string>
#include <vector>

#include "effects/effect.hpp"

namespace demecal {

bool is_revolute(const Robot& robot, int joint);

/// Appends a motion of the joint itself: about its axis, or along it where it is prismatic. Nothing where it is zero.
void append_joint_motion(const Robot& robot, int joint, int coefficient, double size, std::vector<UnitMotion>& motions);

/// "theta_rad": the stem with the unit of the joint's motion.
CoefficientLabel motion_label(const Robot& robot, int joint, const std::string& stem);
/// "rad_per_nm" ("m_per_n"), or "STEM_rad_per_nm": the joint's motion by its load.
CoefficientLabel compliance_label(const Robot& robot, int joint, const std::string& stem = "");

/// Three significant digits; whole numbers from 100 on.
std::string number_words(double value);
/// "0.5 mrad (103 arcsec)".
std::string angle_words(double angle_rad);
/// "0.12 mm".
std::string length_words(double length_m);
/// The size of a joint's motion: an angle or a length.
std::string motion_words(const Robot& robot, int joint, double motion);
/// "120 ppm".
std::string share_words(double share);
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

}  // namespace demecal
