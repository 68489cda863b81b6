// The amounts of a structure's transforms, by least squares, and how well they do on poses that had no part in it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "structure/structured_arm.hpp"

namespace demecal::inline structure {

/// What structures are fitted to and selected by.
struct StructureProblem {
  const DataSet& data;
  StructureFreedom freedom;
  CorrectedRobot start;                      ///< base and tools near where they are
  std::vector<std::size_t> fitted;           ///< poses that amounts come from
  std::vector<std::size_t> selection_poses;  ///< poses that decide between structures
  double position_scale_m = 1.0;             ///< by which rows are divided; positions and distances
  double orientation_scale_rad = 0.0;        ///< 0: orientations are not used
};

/// Scales are the residuals of `start`; orientations far from its tool's, where no tool is free to turn, are not used.
StructureProblem structure_problem(const DataSet& data, const StructureFreedom& freedom, const CorrectedRobot& start,
                                   std::vector<std::size_t> fitted, std::vector<std::size_t> selection_poses);

struct StructureFit {
  StructuredArm arm;
  bool solved = false;          ///< the numbers are finite and fewer than the rows
  double cost = 0.0;            ///< sum of squared scaled residuals of the fitted poses
  double selection_cost = 0.0;  ///< the same of the selection poses; infinite where not solved
  int rank = 0;                 ///< of the Jacobian
  int numbers = 0;              ///< free
};

/// From amounts of zero, which are believed to be within 5 mm and 17.5 mrad (a standard deviation; what the poses show
/// outweighs it by far) lest they trade metres with base and tool: Gauss and Newton's steps by Householder's QR
/// decomposition, and those of Levenberg and Marquardt where the Jacobian has no full rank or a step does not lower the
/// cost (thesis, appendix B 2.3). The same bits on every run.
StructureFit fit_structure(const StructureProblem& problem, const Genome& genome);

/// Of small changes of all free numbers, in the order of StructureFreedom: sigma^2 (J^T J)^+, J with the rows of that
/// belief, sigma^2 = cost / (rows - rank).
Eigen::MatrixXd covariance(const StructureProblem& problem, const StructureFit& fit);

/// How many rows the poses have that are in use.
int rows_in_use(const StructureProblem& problem, std::span<const std::size_t> poses);

struct FoundTransform {
  int link = 0;  ///< it stands after this one, from 0
  Gene gene;
  double value = 0.0;           ///< rad or m
  double standard_error = 0.0;  ///< rad or m

  /// "after link 2 Ry_deg", "after link 3 Tx_mm".
  std::string name() const;
  /// rad or m to the unit of the name.
  double at_border(double amount) const;
};

/// In the order in which they stand along the arm.
std::vector<FoundTransform> found_transforms(const StructureProblem& problem, const StructureFit& fit);

}  // namespace demecal::inline structure
