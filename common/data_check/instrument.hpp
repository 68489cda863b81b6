// Whether the instrument stood still: moves between two rows, and sets measured in another frame or with another tool.
#pragma once

#include <optional>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/trial_fit.hpp"

namespace demecal {

/// A move of the instrument (or of the base) between two rows.
struct InstrumentMove {
  std::size_t first_row = 0;  ///< of the trial, from which it stood elsewhere
  double shift_m = 0.0;       ///< how far measured points jump, root mean square over the rows behind
  double as_given_m = 0.0;    ///< median error of the rows on the shorter side with one place of the instrument
  double if_changed_m = 0.0;  ///< with two
};

/// Splits the rows, in the order of measuring, where two places of the instrument explain them far better than one, and
/// looks again on either side; `trial` comes back with a station for every place, `fit` fitted to it.
std::vector<InstrumentMove> find_moves(Trial& trial, TrialFit& fit);

/// How a set of poses differs from the others by its frame or by its tool.
struct OtherSet {
  bool by_tool = false;       ///< another tool point explains it as well as another frame
  double shift_m = 0.0;       ///< how far the points, or the tool point, are off
  double as_given_m = 0.0;    ///< median error of the set
  double if_changed_m = 0.0;  ///< the same in its own frame, or with its own tool
};

/// Whether `rows`, of one set, fit `fit` only in another frame or with another tool. A set that does is brought into
/// the fit's frame (or its predicted points are): its rows come back with their points moved.
std::optional<OtherSet> find_other_set(const TrialFit& fit, std::vector<TrialRow>& rows);

/// Whether measured points fit predicted ones only after a rigid motion, as after the instrument was set up anew.
std::optional<OtherSet> find_other_frame(const std::vector<Eigen::Vector3d>& predicted,
                                         const std::vector<Eigen::Vector3d>& measured);

}  // namespace demecal
