// Signs of several joints at once, and zeros with them: how an arm reads where its controller counts otherwise.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/chain.hpp"
#include "trials/explanations.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline trials {

/// What is tried of a set of signs.
struct SignSetSearch {
  bool zeros = false;    ///< zeros of one or two joints 90 or 180 degrees off as well
  bool in_base = false;  ///< points are said to be in the base's frame: a set that leaves the base there is likelier
};

inline constexpr int kMostSigned = 8;  ///< joints of an arm of which all sets are tried

/// A set of signs, and others that fit alike.
struct SignSetChoice {
  Explanation best;
  struct Alike {
    std::string clause;       ///< empty: joints as they are
    double distance_m = 0.0;  ///< of tools and base from their description
  };
  double distance_m = 0.0;  ///< of the best
  std::vector<Alike> alike{};
};

/// "Fits alike: joint 2 is taken ...": of each of the others, and of the fewest changes first; those behind the fifth
/// are counted.
std::vector<std::string> alike_sentences(const SignSetChoice& choice);

/// The set of signs, of all of them, by which base and tools alone fit best; of those that fit alike the one that
/// leaves tools, and the base if so asked, nearest to their description, zeros of the first and the last joint by
/// quarter turns included; then that of the fewest changes. Nothing of arms with more than kMostSigned joints, whose
/// sets are too many, and where the best changes nothing.
std::optional<SignSetChoice> best_sign_set(const Trial& trial, SignSetSearch search);

/// How far tools, and the base if the points are in its frame, stand from their description by a fit, m: turns count
/// as they move a point half a metre away.
double distance_from_description_m(const Trial& trial, const TrialFit& fit, bool in_base);

}  // namespace demecal::inline trials
