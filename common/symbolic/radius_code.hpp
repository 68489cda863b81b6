// The radius that holds a corrected tool point, as code beside an exported arm.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/algebra.hpp"
#include "symbolic/code.hpp"

namespace demecal::inline symbolic {

/// radius = root((quantile * widened)^2 * (|sum of spread[i] * factor[i]|^2 + square_m2) + held_square_m2), and what
/// the tool moves by where the temperature is not stated. Expressions are of the symbols of Listing.
struct RadiusListing {
  std::vector<std::array<Expression, 3>> spread;  ///< how the tool point moves with each number of the model, m
  std::vector<std::vector<double>> factor;        ///< of each number; trailing zeros left out
  double square_m2 = 0.0;                         ///< of the model's own error
  double quantile = 0.0;
  Expression widened;               ///< by joints and payload outside of what was measured
  Expression widened_by_warming;    ///< added to it where the temperature is stated
  Expression held_square_m2;        ///< of what corrections that are held outside may be off by
  std::array<Expression, 3> point;  ///< the tool's, m
  /// The ends of the measured temperatures above the listing's reference; nothing where they are not known, or the tool
  /// point does not depend on warmth.
  std::optional<std::array<double, 2>> warming{};

  /// All expressions, for Listing::also.
  std::vector<Expression> expressions() const;
};

/// What follows an arm's listing: in C functions radius95 of the joints and radius95_at of circumstances and joints, in
/// Python radius95(q, payload_kg, warming_kelvin, approach), in MATLAB what the third output of `forward` calls (see
/// Listing::with_radius). m; no memory is allocated in C. Empty as text.
std::string radius_code(const RadiusListing& radius, const Listing& listing, CodeLanguage language);

}  // namespace demecal::inline symbolic
