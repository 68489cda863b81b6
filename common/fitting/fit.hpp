// Identifies base, tool, joint offsets and geometry from measured poses by least squares.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "effects/corrected_robot.hpp"
#include "effects/measurement.hpp"
#include "fitting/declared_model.hpp"

namespace demecal {

struct ParameterEstimate {
  ParameterId id;
  double nominal = 0.0;         ///< rad or m
  double value = 0.0;           ///< rad or m
  double standard_error = 0.0;  ///< rad or m; 0 for a parameter in no identifiable direction
};

/// A combination of parameters these poses cannot see: held at its nominal value.
struct UnidentifiedDirection {
  double relative_singular = 0.0;          ///< its singular value over the largest
  std::vector<std::pair<ParameterId, double>> parts;  ///< those with a share above 0.1, largest first, unit norm in all
  std::string sentence() const;            ///< "joint 1 d_mm - 0.7 base_z_mm cannot be told apart"
};

struct FitOptions {
  int starts = 24;              ///< base orientations tried from scratch when the frame is the instrument's
  int start_poses = 60;         ///< poses used to rank the starts
  int max_iterations = 100;
  double rank_tolerance = 1e-9; ///< relative singular value below which a direction is held
  bool robust = false;          ///< down-weights poses far out (Huber), names them
  double near_parallel_rad = 0.02;
};

enum class FitStatus { converged, too_few_poses, not_converged };

struct Fit {
  CorrectedRobot robot;
  FitStatus status = FitStatus::not_converged;
  std::string sentence;                     ///< what happened, for people
  std::vector<ParameterEstimate> estimates;
  std::vector<UnidentifiedDirection> unidentified;
  int rank = 0;                             ///< identifiable directions
  double sigma_position_m = 0.0;            ///< residual standard deviation per axis, sqrt(2 cost / dof)
  double sigma_orientation_rad = 0.0;       ///< the same; 0 where no orientation was measured
  std::vector<std::size_t> outliers;        ///< poses farther out than the robust scale allows
};

/// The parameters `declared` frees on this data.
std::vector<ParameterId> free_parameters(const DataSet& data, const DeclaredModel& declared, const FitOptions& options);

/// Least squares over the poses `poses` of what they measured, from `start` (its corrections are kept as they are).
/// Position and orientation rows are weighed against each other by their own residual scales, re-estimated until they
/// settle. With the frame the instrument's and registration declared, the base is first found from far off: closed-form
/// registration (Horn) from the start's predicted positions, and `starts` deterministic orientations otherwise.
/// Directions below rank_tolerance are held; covariance is sigma^2 (J^T J)^+ with sigma^2 = 2 cost / dof.
Fit fit_declared(const DataSet& data, std::span<const std::size_t> poses, const DeclaredModel& declared,
                 const CorrectedRobot& start, const FitOptions& options = {});

/// Only registration, and tool where declared: the "registered" robot of the report.
Fit fit_registration(const DataSet& data, std::span<const std::size_t> poses, const DeclaredModel& declared,
                     const CorrectedRobot& start, const FitOptions& options = {});

}  // namespace demecal
