// Identifies base, tool, joint offsets and geometry from measured poses by least squares.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "fitting/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline fitting {

struct ParameterEstimate {
  ParameterId id;
  double nominal = 0.0;         ///< rad or m; rotations by the components of their rotation vector
  double value = 0.0;           ///< rad or m
  double standard_error = 0.0;  ///< rad or m; 0 for a parameter in no identifiable direction
};

/// A combination of parameters these poses cannot see: held where the start has it.
struct UnidentifiedDirection {
  double relative_singular = 0.0;  ///< its effect on the measurements over the largest effect
  bool weak = false;               ///< seen, but less surely than a maker's figures are known: kept near nominal
  /// Those with a share of the effect above 0.1, largest first, the whole of unit norm. The largest is positive.
  std::vector<std::pair<ParameterId, double>> parts;

  std::string sentence()
      const;  ///< "joint 1 d_mm and base_z_mm cannot be told apart by these poses (1 : -1 by effect)"
};

struct FitOptions {
  int starts = 24;       ///< base orientations tried when the frame is the instrument's; 0: the start's base is trusted
  int start_poses = 60;  ///< poses used to rank the starts
  int max_iterations = 100;
  double rank_tolerance = 1e-9;  ///< relative singular value below which a direction is held
  bool robust = true;            ///< down-weights poses far out (Huber); costs 1 % of precision on clean data
  bool refit_effects = true;     ///< frees the coefficients of the start's effects; otherwise they are kept
  double near_parallel_rad = 0.02;
  /// Standard deviations of a maker's link figures about the truth, m and rad; 0: nothing is assumed of them. They keep
  /// parameters that the poses hardly show from running away, and vanish beside those that the poses do show.
  double prior_m = 5e-3;
  double prior_rad = 17.5e-3;
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

/// The parameters `declared` frees on this data: base, then links by joint, then tools by target. Where all is touched
/// and nothing measured by an instrument, no base, and of the first joint nothing that only says where the arm stands.
/// Geometry is, for a revolute joint, d, a, alpha, and beta in place of d on a link between near-parallel axes; for a
/// prismatic one, whose axis has a direction but no place, the two angles theta and alpha (beta and alpha on such a
/// link).
std::vector<ParameterId> free_parameters(const DataSet& data, const DeclaredModel& declared, const FitOptions& options);

/// The numbers of the places that these poses touch: nobody knows them beforehand and no model keeps them, but they are
/// free wherever the poses are fitted, so that what they take is not believed of the arm.
std::vector<ParameterId> contact_parameters(const DataSet& data, std::span<const std::size_t> poses);

/// `robot` with a place for every contact among `ids`: its own, or else that of its poses on average.
CorrectedRobot with_contacts_of(CorrectedRobot robot, const std::vector<ParameterId>& ids, const DataSet& data);

/// Every coefficient of the robot's effects, by effect.
std::vector<ParameterId> effect_parameters(const CorrectedRobot& robot);

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
