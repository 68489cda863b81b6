#include "calibration/amplitude_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace demecal {
namespace {

constexpr double kHold = 1e-3, kFirmHold = 1e8;

/// Rows of all poses one after the other.
Eigen::VectorXd effect_mm(std::span<const LinearisedPose> poses, const CorrectionShape& shape) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (const double slope : poses[i].slope_mm.col(static_cast<Eigen::Index>(shape.joint)))
      rows.push_back(slope * shape.value_rad[i]);
  }
  return Eigen::Map<Eigen::VectorXd>(rows.data(), static_cast<Eigen::Index>(rows.size()));
}

Eigen::VectorXd all_left_mm(std::span<const LinearisedPose> poses) {
  std::vector<double> rows;
  for (const LinearisedPose& pose : poses) rows.insert(rows.end(), pose.left_mm.begin(), pose.left_mm.end());
  return Eigen::Map<Eigen::VectorXd>(rows.data(), static_cast<Eigen::Index>(rows.size()));
}

Eigen::VectorXd ones(std::span<const std::size_t> chosen) {
  return Eigen::VectorXd::Ones(static_cast<Eigen::Index>(chosen.size()));
}

ChosenShapes chosen_shapes(const Eigen::VectorXd& factors, double index_mm2) {
  return {{factors.begin(), factors.end()}, index_mm2};
}

}  // namespace

CorrectionShape present_shape(std::span<const LinearisedPose> poses, std::size_t joint) {
  CorrectionShape shape{joint, {}};
  for (const LinearisedPose& pose : poses) shape.value_rad.push_back(pose.correction[static_cast<Eigen::Index>(joint)]);
  return shape;
}

AmplitudeFit::AmplitudeFit(std::span<const LinearisedPose> poses, std::span<const std::size_t> joints,
                           std::span<const CorrectionShape> shapes) {
  Eigen::VectorXd wanted = all_left_mm(poses);
  for (const std::size_t joint : joints) wanted += effect_mm(poses, present_shape(poses, joint));
  Eigen::MatrixXd effects(wanted.size(), static_cast<Eigen::Index>(shapes.size()));
  for (std::size_t i = 0; i < shapes.size(); ++i)
    effects.col(static_cast<Eigen::Index>(i)) = effect_mm(poses, shapes[i]);
  products_ = effects.transpose() * effects;
  demanded_ = effects.transpose() * wanted;
  bare_index_mm2_ = wanted.squaredNorm();
}

double AmplitudeFit::index_mm2(std::span<const std::size_t> chosen, const Eigen::VectorXd& factors) const {
  const auto of_chosen = products_(chosen, chosen);
  return bare_index_mm2_ + factors.dot(of_chosen * factors - 2.0 * demanded_(chosen));
}

ChosenShapes AmplitudeFit::fitted(std::span<const std::size_t> chosen, std::span<const std::size_t> held) const {
  Eigen::MatrixXd products = products_(chosen, chosen);
  Eigen::VectorXd hold = kHold * products.diagonal();
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (std::ranges::count(held, chosen[i]) > 0) hold[static_cast<Eigen::Index>(i)] *= kFirmHold / kHold;
  products.diagonal() += hold;
  const Eigen::VectorXd factors = products.ldlt().solve(demanded_(chosen) + hold);
  return chosen_shapes(factors, index_mm2(chosen, factors));
}

ChosenShapes AmplitudeFit::as_they_are(std::span<const std::size_t> chosen) const {
  return chosen_shapes(ones(chosen), index_mm2(chosen, ones(chosen)));
}

}  // namespace demecal
