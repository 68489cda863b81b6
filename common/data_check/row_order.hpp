// Whether measured points stand beside the wrong joints: rows shifted by a few, or in no order that is known.
#pragma once

#include <optional>
#include <string>

#include "data_check/trial_fit.hpp"

namespace demecal {

/// Rows that fit the arm otherwise than in the order given.
struct Reordered {
  std::string clause;  ///< what fits: "each measured point is taken from the row before"
  double median_m = 0.0;
  std::vector<std::size_t> poses{};  ///< those it concerns; empty: all
};

/// The shift of measured points against joints, by up to 30 rows either way, at which an arm fits best; `whole` has all
/// rows in the file's order. Where only the rows behind or before a certain one are shifted it says so.
std::optional<Reordered> best_shift(const Trial& whole);

/// The shift, by up to 3 rows, of only the rows behind a certain one, or only of those before it.
std::optional<Reordered> shift_of_rest(const Trial& whole);

/// Whether the measured points are those of the arm in another order: the two clouds of points, brought together from
/// many turns by nearest neighbours (iterative closest point, Besl and McKay 1992), lie within `near_m` of each other
/// and closer by far than points of a cloud do.
std::optional<Reordered> as_shuffled(const Trial& whole, double near_m);

}  // namespace demecal
