// What a fit of a trial works out of every row again and again: where the flange stands, and how its point moves by the
// fit's parameters.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "kinematics/chain.hpp"
#include "kinematics/point_motions.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline trials {

/// Where the parameters of a trial stand in its normal equations: stations' bases, tools, links.
struct ParameterPlaces {
  int stations, tools, joints;
  bool links;

  int tool(int target) const { return 6 * stations + 3 * target; }
  int link(int joint) const { return 6 * stations + 3 * tools + kLinkParameters * joint; }
  int size() const { return link(links ? joints : 0); }
};

/// Of one row: the tool point's derivative with respect to all parameters, 3 x places.size(), and how far off it is.
struct LinearRow {
  Eigen::Matrix<double, 3, Eigen::Dynamic> jacobian;
  Eigen::Vector3d error_m;
};

/// The rows of a trial at the links of one arm. Rows that follow each other at the same joints share their stop, and as
/// long as the links stay as they are nothing has to be worked out again.
class PlacedRows {
 public:
  /// `links`: whether derivatives by the links will be asked for.
  PlacedRows(const Chain& chain, const std::vector<TrialRow>& rows, bool links) : links_(links) { place(chain, rows); }

  /// The same rows at other links.
  void place(const Chain& chain, const std::vector<TrialRow>& rows);

  const Eigen::Isometry3d& flange(std::size_t row) const {
    return links_ ? screws_[stops_[row]].flange() : flanges_[stops_[row]];
  }
  /// As Trial::reach_m(), of a trial with these rows and links.
  double reach_m(const Trial& trial) const;
  /// The tool point by a fit with these links, instrument's frame; `of` is the row of that number.
  Eigen::Vector3d point(const TrialFit& fit, std::size_t row, const TrialRow& of) const;
  /// The row about a fit with these links; `linear` is set to it.
  void linearize(const TrialFit& fit, std::size_t row, const TrialRow& of, const ParameterPlaces& places,
                 LinearRow& linear) const;

 private:
  bool links_;
  std::vector<std::size_t> stops_;          ///< of each row
  std::vector<PlacedScrews> screws_;        ///< of each stop, where links are asked for
  std::vector<Eigen::Isometry3d> flanges_;  ///< of each stop otherwise
};

/// Base and tools as fit_base_and_tools() and refit_base_and_tools() have them, of rows placed at the trial's links, or
/// at those of `start`.
TrialFit fit_base_and_tools(const Trial& trial, const PlacedRows& placed);
TrialFit refit_base_and_tools(const Trial& trial, TrialFit start, const PlacedRows& placed);

}  // namespace demecal::inline trials
