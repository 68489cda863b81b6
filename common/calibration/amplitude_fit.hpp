// How large corrections of several joints should be beside each other: their amplitudes by linear least squares.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "calibration/distal_index.hpp"

namespace demecal {

/// A joint's correction at every pose, rad.
struct CorrectionShape {
  std::size_t joint = 0;
  std::vector<double> value_rad;
};

/// What a joint has about which the poses are linearised.
CorrectionShape present_shape(std::span<const LinearisedPose> poses, std::size_t joint);

/// What choosing some shapes comes to.
struct ChosenShapes {
  std::vector<double> factor;  ///< by which each is multiplied, in the order of choice
  double index_mm2 = 0.0;      ///< linearised, with these shapes times factors for their joints' corrections
};

/// The linearised index of the model that has, instead of the joints' present corrections, shapes times factors.
/// Factors are held near 1 by a thousandth of what the data weigh: where these cannot tell two joints apart, neither
/// grows.
class AmplitudeFit {
 public:
  /// `poses` are linearised about the present corrections; shapes have a value for each of them, all finite. The
  /// present corrections of `joints` make way for what is chosen; those of others stay.
  AmplitudeFit(std::span<const LinearisedPose> poses, std::span<const std::size_t> joints,
               std::span<const CorrectionShape> shapes);

  /// With the factors of least index; those of `held` shapes are 1 within a millionth. At most one shape a joint is
  /// chosen.
  ChosenShapes fitted(std::span<const std::size_t> chosen, std::span<const std::size_t> held = {}) const;
  /// With the factor 1 for each.
  ChosenShapes as_they_are(std::span<const std::size_t> chosen) const;

 private:
  double index_mm2(std::span<const std::size_t> chosen, const Eigen::VectorXd& factors) const;

  Eigen::MatrixXd products_;  ///< of the shapes' effects in mm, each with each
  Eigen::VectorXd demanded_;  ///< of the shapes' effects with what all of them together should make up for
  double bare_index_mm2_;     ///< without corrections of `joints`
};

}  // namespace demecal
