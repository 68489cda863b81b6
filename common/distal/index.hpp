// The performance index of a whole model (thesis eq. 4.6): exact, and linearized in the joints' corrections, whose
// amplitudes beside each other are then a linear least-squares problem.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "data/data_set.hpp"
#include "fitting/fit.hpp"
#include "kinematics/chain.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline distal {

/// What a pose says near the present corrections: rows that the index squares, and how they fall as joints are
/// corrected further.
struct LinearizedPose {
  JointVector correction;       ///< present g, rad or m
  Eigen::VectorXd residual_mm;  ///< measured less predicted
  Eigen::MatrixXd jacobian_mm;  ///< rows x joints: change of the prediction, mm per rad or m of a joint's correction
};

/// The sum over `poses` of squared rows of what was measured, mm^2: positions and distances (those of one pose together
/// count as one length, and only where there is no position) by their errors, orientations by the turn that is left,
/// weighed as the declared fit found both to scatter. Where no orientation is used it is performance_index_mm2().
class DistalIndex {
 public:
  /// `declared` says how rows scatter; robots that are asked about have the effects of its robot.
  DistalIndex(const DataSet& data, std::span<const std::size_t> poses, const Fit& declared);

  /// Exact, through the robot's whole forward model.
  double operator()(const CorrectedRobot& robot) const;
  /// One per pose, in their order.
  std::vector<LinearizedPose> linearized(const CorrectedRobot& robot) const;

 private:
  Eigen::VectorXd weigh(const MeasuredPose& pose, const Eigen::VectorXd& rows) const;
  Eigen::Isometry3d predicted(const CorrectedRobot& robot, std::size_t i) const;

  const DataSet& data_;
  std::vector<std::size_t> poses_;
  std::vector<std::vector<EffectMotion>> motions_;
  double mm_per_rad_;
};

/// Each joint's potential to compensate what is left: the sum over poses of |J_j' residual| (thesis eq. 4.11), mm^2 per
/// rad or m.
Eigen::VectorXd compensation_potentials(std::span<const LinearizedPose> poses);

/// A joint's correction at every pose, rad.
struct CorrectionShape {
  std::size_t joint = 0;
  std::vector<double> value_rad;
};

/// What a joint has about which the poses are linearized.
CorrectionShape present_shape(std::span<const LinearizedPose> poses, std::size_t joint);

/// What choosing some shapes comes to.
struct ChosenShapes {
  std::vector<double> factor;  ///< by which each is multiplied, in the order of choice
  double index_mm2 = 0.0;      ///< linearized, with these shapes times factors for their joints' corrections
};

/// The linearized index of the model that has, instead of the joints' present corrections, shapes times factors.
/// Factors are held near 1 by a thousandth of what the data weigh: where these cannot tell two joints apart, neither
/// grows.
class AmplitudeFit {
 public:
  /// `poses` are linearized about the present corrections; shapes have a value for each of them, all finite. The
  /// present corrections of `joints` make way for what is chosen; those of others stay.
  AmplitudeFit(std::span<const LinearizedPose> poses, std::span<const std::size_t> joints,
               std::span<const CorrectionShape> shapes);

  /// With the factors of least index; those of `held` shapes are 1 within a millionth. At most one shape a joint is
  /// chosen.
  ChosenShapes fitted(std::span<const std::size_t> chosen, std::span<const std::size_t> held = {}) const;
  /// With the factor 1 for each.
  ChosenShapes unscaled(std::span<const std::size_t> chosen) const;

 private:
  double index_mm2(std::span<const std::size_t> chosen, const Eigen::VectorXd& factors) const;

  Eigen::MatrixXd products_;  ///< of the shapes' effects in mm, each with each
  Eigen::VectorXd moments_;   ///< of the shapes' effects with what all of them together should make up for
  double bare_index_mm2_;     ///< without corrections of `joints`
};

}  // namespace demecal::inline distal
