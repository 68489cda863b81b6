// Joint corrections as a sum of smooth terms: what evolution could still give each joint, in a form that can be solved.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "data/data_set.hpp"
#include "expression/bound.hpp"
#include "expression/tree.hpp"
#include "kinematics/angles.hpp"
#include "prediction/corrected_robot.hpp"
#include "products/tall_products.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline residuals {

/// One term of one joint's correction: a formula in theta of size about 1.
struct SmoothTerm {
  int joint = 0;  ///< from 0
  Tree formula;
  int harmonic = 0;  ///< cycles a turn of a wave; 0: a polynomial
  int family = 0;    ///< the same for terms of one degree, or of one harmonic, of all joints
};

/// Corrections g_j(theta) = base_j(theta) + sum of coefficient * term over every revolute joint that moves. Terms are
/// Legendre polynomials over the joint's calibrated range and the first harmonics of a turn: smooth errors of gears and
/// encoders are sums of few of them. The tangent space of the joint corrections, whatever formula evolution finds.
struct SmoothCorrections {
  std::vector<SmoothTerm> terms;
  Eigen::VectorXd coefficients;       ///< rad, one per term
  std::vector<JointCorrection> base;  ///< one per joint: corrections that are already there
  std::vector<AngleBranch> branches;  ///< one per joint
  std::vector<Interval> ranges;       ///< one per joint, rad

  /// The corrections with their coefficients in place.
  std::vector<JointCorrection> corrections() const;
  std::vector<int> families() const;
  /// rows x terms: the field's change per unit of every coefficient.
  RowMatrix columns(const ResidualField& field) const;
};

/// Terms for the joints of `robot` over the commanded joints of `poses`, coefficients zero; its corrections are the
/// base. Joints that most poses find within 3 deg get no terms, others at most one for every third value, or four,
/// fewer than values. `declared` false: no terms at all; `offset_declared`: no constant ones.
SmoothCorrections smooth_corrections(const DataSet& data, std::span<const std::size_t> poses,
                                     const CorrectedRobot& robot, bool declared, bool offset_declared = false);

/// How precisely each term's coefficient should be believed to be zero before the poses are seen (one over its standard
/// deviation, 1/rad), chosen so that the poses are most likely: automatic relevance determination (MacKay, 1992), in
/// which the terms of a family are believed to be of like size, for the joints of one arm are made alike. Terms that
/// the poses do not call for end at a precision that removes them.
/// `products`: X^T X of the columns X = [model | terms | residual + terms * coefficients], the model's beliefs among
/// its rows; `families`: of each term, small numbers from 0; `rows`: of the poses.
Eigen::VectorXd relevance(const Eigen::MatrixXd& products, std::span<const int> families, double rows);

}  // namespace demecal::inline residuals
