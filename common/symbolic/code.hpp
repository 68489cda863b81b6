// A corrected arm as a file of formulas or code that stands by itself.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/algebra.hpp"
#include "symbolic/parse_expression.hpp"
#include "symbolic/printing.hpp"

namespace demecal::inline symbolic {

/// The axis of a joint as it stands, from which the Jacobian follows; directions and lengths in the frame of the pose.
struct MovingAxis {
  bool turns = true;  ///< else it slides
  std::array<Expression, 3> direction;
  std::array<Expression, 3> to_next;  ///< from a point on it to one on the next joint's axis, of the last to the tool
  Expression rate;                    ///< of the joint to its command; may refer to actual_rate()
  /// Other commands that also move it, from 0, and at which rate.
  std::vector<std::pair<std::size_t, double>> coupled{};
};

/// What is written. Joint i (from 1) is commanded to the symbol qi; `actual[i - 1]` says in terms of it where the joint
/// then is, and `pose` may refer to that as the symbol actual_joint(i), and of all q.
struct Listing {
  std::vector<std::string> remarks;  ///< lines of comment at the head
  std::vector<Expression> actual;
  SymbolicMatrix pose;
  /// Where it is set, pose may refer also to kPayload, kWarming (above so many degC) and the approach of every joint,
  /// which are then arguments of `forward`; 0 where they are left out.
  std::optional<double> reference_celsius{};
  std::vector<Expression> also{};  ///< of code that follows: its formulas are written with the listing's
  std::vector<MovingAxis> axes{};  ///< what inverse_in_c() differentiates by: of every joint, or nothing
  bool with_radius = false;        ///< radius_code() follows: in MATLAB a further output of `forward` calls it
};

/// "q1" and "actual1" of the joint that counts from 1.
std::string commanded_joint(int joint);
std::string actual_joint(int joint);
/// "rate1": the derivative of actual_joint(joint) by the command.
inline std::string actual_rate(int joint) {
  return "rate" + std::to_string(joint);
}

/// What is carried at the tool point as described (kg); how much warmer than the listing's reference the arm is (K).
inline constexpr const char *kPayload = "payload_kg", *kWarming = "warming_kelvin";
/// "approach1" of the joint that counts from 1: the sign of its last motion, 0 where it is not known.
std::string approach_symbol(int joint);

/// The listing whose pose is the derivative of this one's by a joint's command; joints count from 1.
Listing derivative(const Listing& listing, int joint);

/// The text of the file: functions h1 .. hn of a joint's command and forward of all of them, which gives the pose row
/// by row (C: 16 numbers, Python: four lists, MATLAB: a matrix, and h beside it); as text, equations. What expressions
/// share is computed once, in t1, t2 ... In C what the pose depends on beside joints is the argument of forward_at.
std::string code_of(const Listing& listing, CodeLanguage language);

/// What follows the listing of an arm, with its axes, in C: functions `inverse` (a pose of the tool to the joints to
/// command) and `corrected` (joints as the maker's description has them to the joints to command), by Newton's steps.
/// `nominal` is the arm as its maker describes it with the same base and tool.
std::string inverse_in_c(const Listing& arm, const Listing& nominal);

}  // namespace demecal::inline symbolic
