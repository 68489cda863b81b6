// Identifies base, tool, joint offsets and geometry from measured poses by least squares.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline fitting {

struct ParameterEstimate {
  ParameterId id;
  double nominal = 0.0;         ///< rad or m; rotations by the components of their rotation vector
  double value = 0.0;           ///< rad or m
  double standard_error = 0.0;  ///< rad or m; 0 for a parameter in no identifiable direction
};

struct FitOptions {
  int starts = 24;       ///< base orientations tried when the frame is the instrument's; 0: the start's base is trusted
  int start_poses = 60;  ///< poses used to rank the starts
  int max_iterations = 100;
  /// Relative singular value below which a direction is held: what shows by so little is determined to metres at best.
  double rank_tolerance = 1e-6;
  bool robust = true;         ///< down-weights poses far out (Huber); costs 1 % of precision on clean data
  bool refit_effects = true;  ///< frees the coefficients of the start's effects; otherwise they are kept
  /// Standard deviations of a maker's link figures about the truth, m and rad; 0: nothing is assumed of them. They keep
  /// parameters that the poses hardly show from running away, and vanish beside those that the poses do show.
  double prior_m = kMakersDeviation_m;
  double prior_rad = kMakersDeviation_rad;
};

enum class FitStatus { converged, too_few_poses, not_converged };

struct Fit {
  CorrectedRobot robot;  ///< the start where the poses were too few
  FitStatus status = FitStatus::not_converged;
  std::string sentence;  ///< what happened, for people
  std::vector<ParameterEstimate> estimates;
  std::vector<UnidentifiedDirection> unidentified;
  int rank = 0;                   ///< identifiable directions: free parameters less unidentified directions
  double sigma_position_m = 0.0;  ///< residual standard deviation per axis, sqrt(2 cost / dof); 0 where not measured
  double sigma_orientation_rad = 0.0;  ///< the same; 0 where no orientation was measured or used
  double sigma_distance_m = 0.0;       ///< the same of distances
  std::vector<std::size_t> outliers;   ///< poses farther out than the robust scale allows, ascending
};

/// Least squares over the poses `poses` of what they measured, from `start`: the declared parameters and the
/// coefficients of the start's effects together (its corrections are kept as they are). The effects of the result have
/// standard errors.
/// Position, orientation and distance rows are weighed against each other by their own residual scales, re-estimated
/// until they settle. Without the tool declared, orientations more than 0.1 rad off the start's tool are taken to be a
/// target mounted otherwise, and not used. With the frame the instrument's and registration declared, the base is first
/// found from far off: closed-form registration (Horn) from the start's predicted positions, and `starts` deterministic
/// orientations otherwise. Directions below rank_tolerance are held where the start has them, and what a base or a tool
/// can explain is not laid at a joint's door. Covariance is sigma^2 (J^T J + sigma^2 / prior^2)^+ with
/// sigma^2 = 2 cost / dof. Throws InputError where distances were measured from unknown anchors:
/// take_wires_for_contacts() comes first. Places that the poses touch start at their poses' mean and are free beside
/// the rest (with what is known between them), so that estimates, scales and standard errors are those of least squares
/// with the places eliminated.
Fit fit_declared(const DataSet& data, std::span<const std::size_t> poses, const DeclaredModel& declared,
                 const CorrectedRobot& start, const FitOptions& options = {});

/// Only registration, and tool where declared: the "registered" robot of the report. Effects are kept as they are.
Fit fit_registration(const DataSet& data, std::span<const std::size_t> poses, const DeclaredModel& declared,
                     const CorrectedRobot& start, const FitOptions& options = {});

}  // namespace demecal::inline fitting
